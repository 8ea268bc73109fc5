// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "solver/geometry/intrinsic_surface.h"

namespace geotherm {

/// Whether a vertex is a corner of some face.
inline bool is_used(const IntrinsicSurface& base, Index vertex) {
  const std::vector<char>& on_surface = base.kept->on_surface;
  return static_cast<std::size_t>(vertex) >= on_surface.size() || on_surface[vertex] != 0;
}

/// V and inserted: the numbers of vertices along a space-filling curve (Morton 1966) through the
/// box of those that are used; 0 for others.
std::vector<std::uint64_t> morton_numbers(const IntrinsicSurface& base, int threads);

}  // namespace geotherm
