// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/core/types.h"

namespace geotherm {

/// A part of the graph during dissection, with its own numbering.
struct GraphPart {
  std::vector<Index> start = {0};  ///< n + 1
  std::vector<Index> neighbor;
  std::vector<std::array<float, 3>> position;
  std::vector<Index> vertex;  ///< number in the whole graph

  Index size() const { return static_cast<Index>(vertex.size()); }
};

/// Which side a vertex is on.
enum Half : std::int8_t { kLeft = 0, kRight = 1, kSeparator = 2 };

/// A vertex separator: no left vertex has a right neighbour.
struct Separator {
  std::vector<std::int8_t> half;  ///< n, a Half each
  std::array<Index, 3> count{};   ///< by Half
};

/// Cuts a part by the plane of smallest separator among the three axes, keeping a quarter of the
/// vertices on each side at least, and refines the cut. One half may come out empty (a clique).
/// The result does not depend on `threads`.
Separator find_separator(const GraphPart& part, int threads = 1);

/// One pass of vertex moves into either half, best first, kept up to the smallest separator seen
/// (Fiduccia, Mattheyses 1982, for vertex separators: Ashcraft, Liu 1997).
void refine_separator(const GraphPart& part, Separator& separator);

}  // namespace geotherm
