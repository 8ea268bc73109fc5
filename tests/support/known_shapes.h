// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <ostream>

#include "tests/support/shapes.h"

namespace geotherm::test {

/// A surface whose geodesics from one vertex are known, of `n` edges along a side.
struct KnownShape {
  const char* name;
  Draft (*draft)(Index n);
  Index (*source)(Index n);
  double (*exact)(const Draft&, Index n, Index v);
  double within = 1e9;  ///< errors count up to this distance: a border bends the heat beside it
};

inline void PrintTo(const KnownShape& shape, std::ostream* out) { *out << shape.name; }

inline double in_plane(const Draft& draft, Index n, Index v) {
  return (draft.positions[v] - draft.positions[grid_vertex(n, n / 2, n / 2)]).norm();
}
inline double on_sphere(const Draft& draft, Index /*n*/, Index v) {
  const Vec3 &a = draft.positions[0], &b = draft.positions[v];
  return std::atan2(a.cross(b).norm(), a.dot(b));
}
inline double on_prism(const Draft& draft, Index n, Index v) {
  const double along = static_cast<double>(v % n) / n;
  return std::hypot(std::min(along, 1 - along), draft.positions[v].z() - 0.5);
}
/// From the apex of a cone, and from the corner of a flat torus where both folds meet, which keep
/// distances to it.
inline double from_origin(const Draft& draft, Index /*n*/, Index v) {
  return draft.positions[v].norm();
}

inline Index first_vertex(Index /*n*/) { return 0; }
inline Index centre(Index n) { return grid_vertex(n, n / 2, n / 2); }
inline Index half_way_up(Index n) { return n / 2 * n; }
inline Draft sphere_of(Index n) { return sphere(static_cast<int>(std::lround(std::log2(n))) - 2); }

}  // namespace geotherm::test
