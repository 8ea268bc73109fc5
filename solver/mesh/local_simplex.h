// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include "geotherm/types.h"

namespace geotherm {

/// A triangle or a tet around a query, and its nearest point among those offered so far. Corners
/// are relative to the query, divided by their largest coordinate: no square over- or underflows,
/// and what is near keeps its digits.
template <std::size_t N>
struct LocalSimplex {
  using Weights = std::array<double, N>;

  LocalSimplex(const std::array<Vec3, N>& places, const Vec3& query) : corners(places) {
    for (Vec3& corner : corners) {
      corner -= query;
      unit = std::max(unit, corner.cwiseAbs().maxCoeff());
    }
    if (unit > 0) {
      for (Vec3& corner : corners) corner /= unit;
    }
  }

  /// The distance is measured at the point that the weights give, so that it is honest even where
  /// the weights of a needle or a sliver are not.
  void offer(const Weights& w) {
    Vec3 point = w[0] * corners[0];
    for (std::size_t k = 1; k < N; ++k) point += w[k] * corners[k];
    const double here = unit * point.norm();
    if (!(here < distance)) return;
    distance = here;
    weights = w;
  }

  /// The point below the query, where it lies in the triangle.
  void offer_triangle(std::size_t i, std::size_t j, std::size_t k) {
    const Vec3 &a = corners[i], &b = corners[j], &c = corners[k];
    const Vec3 normal = (b - a).cross(c - a);
    const std::array<double, 3> w = {b.cross(c).dot(normal), c.cross(a).dot(normal),
                                     a.cross(b).dot(normal)};
    const double sum = w[0] + w[1] + w[2];
    if (!(sum > 0) || std::min({w[0], w[1], w[2]}) < 0) return;
    Weights all{};
    all[i] = w[0] / sum;
    all[j] = w[1] / sum;
    all[k] = w[2] / sum;
    offer(all);
  }

  /// The nearest point of the edge.
  void offer_edge(std::size_t i, std::size_t j) {
    const Vec3 along = corners[j] - corners[i];
    const double length2 = along.squaredNorm();
    const double s = length2 > 0 ? std::clamp(-corners[i].dot(along) / length2, 0.0, 1.0) : 0.0;
    Weights w{};
    w[i] = 1 - s;
    w[j] = s;
    offer(w);
  }

  std::array<Vec3, N> corners;
  double unit = 0;
  Weights weights{};  ///< of the nearest point
  double distance = std::numeric_limits<double>::infinity();
};

}  // namespace geotherm
