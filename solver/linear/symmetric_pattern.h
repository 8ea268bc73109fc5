// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "geotherm/backend.h"
#include "solver/core/sorting.h"

namespace geotherm {

/// The pattern of any operator on these faces: vertices that share a face. n = size >= every
/// corner + 1. Cost: O(F).
SymmetricPattern pattern_of_faces(Index size, std::span<const Face> faces);

/// The lower triangle of a pattern as it is numbered. Cost: O(n), by all threads.
LowerPattern lower_of(const SymmetricPattern& pattern, int threads);

/// Connected component of every vertex, numbered by first appearance.
struct Components {
  std::vector<Index> of;  ///< n
  Index count = 0;
};
/// neighbors(i): the vertices joined to i, ascending.
template <class NeighborsOf>
Components connected_components(Index size, const NeighborsOf& neighbors) {
  DisjointSets sets(static_cast<std::size_t>(size));
  for (Index i = 0; i < size; ++i) {
    for (const Index j : neighbors(i)) {
      if (j >= i) break;
      sets.join(i, j);
    }
  }
  Components out;
  out.of = std::move(sets).roots();
  for (Index i = 0; i < size; ++i) out.of[i] = out.of[i] == i ? out.count++ : out.of[out.of[i]];
  return out;
}
inline Components connected_components(const SymmetricPattern& pattern) {
  return connected_components(pattern.size(), [&](Index i) { return pattern.neighbors(i); });
}

/// The components of a pattern as an elimination order numbers them anew.
void name_components(const Components& parts, std::span<const Index> order, Components& out);

}  // namespace geotherm
