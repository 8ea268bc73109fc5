// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>
#include <vector>

#include "geotherm/mesh.h"
#include "geotherm/types.h"

namespace geotherm::app {

/// Where a source lies: at a vertex (both the same), along an edge, or in a face; kNoIndex: not
/// there.
struct OutwardPlace {
  std::array<Index, 2> vertices;
  Index face;
};

/// Which way the faces about a place look: a direction, and the sine of the angle that they are at
/// most away from it; above 1: all around, or there is none that has an area.
using Outward = std::array<float, 4>;
inline constexpr Outward kAllAround{0, 0, 0, 2};

/// That of each place. Cost: O(F).
std::vector<Outward> outward_at(const TriangleMesh& mesh, std::span<const OutwardPlace> places);

}  // namespace geotherm::app
