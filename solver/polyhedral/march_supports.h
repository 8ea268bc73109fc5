// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "solver/core/memory.h"
#include "solver/polyhedral/wave_surface.h"

namespace geotherm {

/// A triangle through which a plane wave may reach `target`: `left` at the origin, `right` at
/// (base, 0), the target at (x, y), y > 0.
struct MarchSupport {
  Index target, left, right;
  double base, x, y;
};

/// What fast marching updates from. A corner has one support, its face; an obtuse one, which a wave
/// may reach before both other corners, has two that are acute: the faces beyond the opposite side
/// are unfolded until a vertex splits the angle (Kimmel, Sethian 1998, section 4). Where a boundary
/// or an edge with three faces and more is in the way, the face stays its support.
struct MarchSupports {
  std::vector<MarchSupport> all;
  std::vector<std::uint32_t> start;  ///< V + 1
  RawVector<Index> at;               ///< supports whose left or right is the vertex

  std::span<const Index> of(Index vertex) const {
    return {at.data() + start[vertex], at.data() + start[vertex + 1]};
  }
  std::size_t bytes() const;
};

/// Vertices are those of the mesh. Cost: O(F).
MarchSupports build_march_supports(const WaveSurface& surface);

}  // namespace geotherm
