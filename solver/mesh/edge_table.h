// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/core/types.h"

namespace geotherm {

/// Side k of face f joins its corners k and (k + 1) % 3; it is numbered 3 f + k.
using Side = std::int32_t;
inline constexpr Side kNoSide = -1;

inline Index face_of(Side side) { return side / 3; }
inline int corner_of(Side side) { return side % 3; }
inline int next_corner(int k) { return k == 2 ? 0 : k + 1; }
inline int previous_corner(int k) { return k == 0 ? 2 : k - 1; }

/// The sides of a face list grouped by the pair of vertices they join. An edge with one side is
/// on the boundary, with two an inner one, with more it is non-manifold.
///
/// Edges are sorted by (low vertex, high vertex); the sides of an edge by number.
/// Precondition: no face repeats a corner. Cost: O(F), one counting sort.
class EdgeTable {
 public:
  EdgeTable() = default;
  EdgeTable(Index vertex_count, std::span<const Face> faces);

  Index edge_count() const { return static_cast<Index>(low_.size()); }
  Index low(Index edge) const { return low_[static_cast<std::size_t>(edge)]; }
  Index high(Index edge) const { return high_[static_cast<std::size_t>(edge)]; }
  std::span<const Side> sides(Index edge) const {
    const auto e = static_cast<std::size_t>(edge);
    return {sides_.data() + first_[e], sides_.data() + first_[e + 1]};
  }

 private:
  std::vector<Index> low_, high_;
  std::vector<std::size_t> first_ = {0};
  std::vector<Side> sides_;
};

}  // namespace geotherm
