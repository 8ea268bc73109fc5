// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "geotherm/types.h"
#include "solver/core/raw_vector.h"
#include "solver/mesh/corner_table.h"
#include "solver/mesh/side.h"

namespace geotherm {

/// The sides of a face list grouped by the pair of vertices they join. An edge with one side is
/// on the boundary, with two an inner one, with more it is non-manifold.
///
/// Edges are sorted by (low vertex, high vertex); the sides of an edge by number.
/// Precondition: no face repeats a corner. Cost: O(F), by all threads; a counting sort less where
/// the corners at the vertices are known.
class EdgeTable {
 public:
  EdgeTable() = default;
  EdgeTable(Index vertex_count, std::span<const Face> faces, int threads = 1)
      : EdgeTable(CornerTable(vertex_count, faces, threads), faces, threads) {}
  EdgeTable(const CornerTable& corners, std::span<const Face> faces, int threads);

  Index edge_count() const { return static_cast<Index>(low_.size()); }
  Index low(Index edge) const { return low_[static_cast<std::size_t>(edge)]; }
  Index high(Index edge) const { return high_[static_cast<std::size_t>(edge)]; }
  std::span<const Side> sides(Index edge) const {
    const auto e = static_cast<std::size_t>(edge);
    return {sides_.data() + first_[e], sides_.data() + first_[e + 1]};
  }

 private:
  RawVector<Index> low_, high_;
  RawVector<std::uint32_t> first_ = {0};  ///< one more than there are edges
  RawVector<Side> sides_;
};

}  // namespace geotherm
