// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geotherm/types.h"

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

/// Planes leave at least this share of the vertices on each side, the separator included; moves let
/// no half grow beyond the rest.
inline constexpr double kSmallestShare = 0.25;

/// The cost of unequal halves, as a factor of the separator's size. The formula was chosen by
/// measuring what the factor stores.
inline double imbalance(Index on_left, Index size) {
  const double off = static_cast<double>(on_left) / size - 0.5;
  return 1 + 4 * off * off;
}

/// Cuts a part in two: refines the separators of the best planes (plane_cuts()), or of half a
/// breadth-first search where many vertices are in one place, and takes the cheapest. One half may
/// come out empty (a clique). The result does not depend on `threads`.
Separator find_separator(const GraphPart& part, int threads = 1);

/// One pass of vertex moves into either half, best first, kept up to the smallest separator seen
/// (Fiduccia, Mattheyses 1982, for vertex separators: Ashcraft, Liu 1997).
void refine_separator(const GraphPart& part, Separator& separator);

/// Separators that planes leave: of each direction the plane of least cost, size times imbalance(),
/// that has a quarter of the vertices on each side at least, those of the separator included.
/// `most` directions at most, best first; none where no plane keeps the balance. The directions are
/// the axes and the diagonals between two of them, without those along which the part is thin, and
/// without the shortest diagonal where none is. The result does not depend on `threads`. Cost: one
/// pass over the edges, one over the vertices for each direction; 48 bytes a vertex.
std::vector<Separator> plane_cuts(const GraphPart& part, int most, int threads);

}  // namespace geotherm
