// SPDX-License-Identifier: MIT
// One reader per format. Each takes the bytes of FileBytes (with its padding) and throws
// ReadFailure or std::bad_alloc.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "solver/mesh/io/raw_mesh.h"

namespace geotherm::io {

/// What a reader of elements hands over: beside the faces the tets, and how many others there were.
/// Every corner is in range, every coordinate finite.
struct RawElements : RawMesh {
  std::vector<std::array<Index, 4>> tets;
  /// Elements that are no tets, by kind (plural): those of the faces among them.
  std::map<std::string, std::int64_t> others;
};

/// "triangles (12), edges (3)".
std::string text_of_others(const RawElements& raw);

/// What to do about a file with no others than these (text_of_others()): curved ones have corners
/// in the middle of edges, too. `needed`: what is said of all else.
Hint cure_of_others(const std::string& others, const char* needed);

/// The faces; what else there was is a note. Throws ReadFailure where there are none.
RawMesh faces_of(RawElements raw);

RawElements read_medit(std::string_view text);
RawElements read_meshb(std::string_view bytes);
RawElements read_gmsh(std::string_view bytes);
RawElements read_vtk(std::string_view bytes);
RawElements read_vtu(std::string_view bytes);
RawElements read_vtp(std::string_view bytes);

}  // namespace geotherm::io
