// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "geotherm/backend.h"

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
Components connected_components(const SymmetricPattern& pattern);

}  // namespace geotherm
