// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <numbers>

#include "solver/geometry/intrinsic_mesh.h"

namespace geotherm {

/// Height over longest side below which a face has no usable area.
inline constexpr double kFlat = 1e-10;

/// A triangle by its sides over the longest of them, which is 0 where all corners are one point.
struct Shape {
  std::array<Vec3, 3> side;  ///< from corner k to the next
  double longest = 0;        ///< model units
  double squares = 0;        ///< sum of the squared sides
  double doubled = 0;        ///< area times two

  explicit Shape(const std::array<Vec3, 3>& corners) {
    for (int k = 0; k < 3; ++k) {
      side[k] = corners[next_corner(k)] - corners[k];
      longest = std::max(longest, safe_norm(side[k]));
    }
    if (!(longest > 0)) return;
    for (Vec3& s : side) squares += (s /= longest).squaredNorm();
    doubled = side[0].cross(side[1]).norm();
  }

  double area() const { return 0.5 * doubled * longest * longest; }  ///< model units squared
  bool is_flat() const { return doubled < kFlat; }
  double quality() const { return 2 * std::numbers::sqrt3 * doubled / squares; }
};

}  // namespace geotherm
