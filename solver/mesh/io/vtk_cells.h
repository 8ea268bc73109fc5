// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "solver/mesh/io/raw_elements.h"

namespace geotherm::io {

/// The cells of a grid in either format of VTK: corners of cell c are connectivity[offsets[c]] to
/// before connectivity[offsets[c + 1]].
struct VtkCells {
  std::vector<std::int64_t> offsets;  ///< one more than there are cells
  std::vector<std::int64_t> connectivity;
  std::vector<std::int64_t> types;
};

/// VTK's numbers of kinds of cells.
inline constexpr std::int64_t kVtkStrip = 6, kVtkPolygon = 7;

/// Adds the tets and faces among the cells, whose corners count from the vertex `first` on; of
/// strips each triangle. Throws ReadFailure with the cell's number, counted from 0, where offsets
/// do not rise, a cell has not the corners that its kind has, or a corner is no vertex.
void add_vtk_cells(const VtkCells& cells, std::int64_t first, RawElements& raw);

}  // namespace geotherm::io
