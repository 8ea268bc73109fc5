// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>

#include "solver/geometry/intrinsic_mesh.h"

namespace geotherm {

/// The quadrilateral of a flip in the plane: a at the origin, b on the positive x axis, c above,
/// d below. Names as in Edit.
struct FlipDiamond {
  Eigen::Vector2d a, b, c, d;
};

/// `l`: lengths ab, bc, ca, ad, db.
inline FlipDiamond unfold(const std::array<double, 5>& l) {
  const FaceLayout upper = lay_out({l[0], l[1], l[2]});
  const FaceLayout lower = lay_out({l[0], l[4], l[3]});
  return {Eigen::Vector2d(0, 0), Eigen::Vector2d(l[0], 0), Eigen::Vector2d(upper.x, upper.height),
          Eigen::Vector2d(lower.x, -lower.height)};
}

inline double cross(const Eigen::Vector2d& x, const Eigen::Vector2d& y) {
  return x.x() * y.y() - x.y() * y.x();
}

/// Barycentric weights of `p` in triangle (u, v, w), clipped to it.
inline std::array<double, 3> clipped_weights(const Eigen::Vector2d& u, const Eigen::Vector2d& v,
                                             const Eigen::Vector2d& w, const Eigen::Vector2d& p) {
  std::array<double, 3> weights = {std::max(cross(v - p, w - p), 0.0),
                                   std::max(cross(w - p, u - p), 0.0),
                                   std::max(cross(u - p, v - p), 0.0)};
  const double sum = weights[0] + weights[1] + weights[2];
  for (double& x : weights) x /= sum;
  return weights;
}

}  // namespace geotherm
