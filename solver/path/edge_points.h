// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include "solver/path/path_surface.h"

namespace geotherm {

/// The distance at a share of an edge of length `edge` > 0, whose vertices have a and b: that of a
/// circular wave through both.
inline double between(double a, double b, double edge, double share) {
  const double along = (a - b) * (a + b) / (2 * edge) + edge / 2;
  const double height2 = (a - along) * (a + along);
  const double over_vertices = std::min(a + share * edge, b + (1 - share) * edge);
  if (!(height2 >= 0)) return over_vertices;
  return std::min(std::hypot(along - share * edge, std::sqrt(height2)), over_vertices);
}

/// A point of an edge, in one of its faces.
inline SurfacePoint on_edge(const PathSurface& surface, Index edge, double share) {
  const Index face = face_of(surface.edges().sides(edge).front());
  SurfacePoint point = SurfacePoint::in_face(face, {});
  const int low = surface.corner_of_vertex(face, surface.edges().low(edge));
  const int high = surface.corner_of_vertex(face, surface.edges().high(edge));
  point.weights[static_cast<std::size_t>(low)] = 1 - share;
  point.weights[static_cast<std::size_t>(high)] = share;
  return point;
}

/// True for two points of one edge, between which there is nothing to gain.
inline bool on_same_edge(const PathSurface& surface, const SurfacePoint& a, const SurfacePoint& b,
                         Index face) {
  const auto p = surface.express(a, face), q = surface.express(b, face);
  if (p->is_vertex() && q->is_vertex()) return false;
  for (int k = 0; k < 3; ++k) {
    const auto away = [&](const SurfacePoint& x) {
      return x.is_vertex() ? surface.face(face)[k] != x.vertex
                           : x.weights[static_cast<std::size_t>(k)] == 0;
    };
    if (away(*p) && away(*q)) return true;
  }
  return false;
}

}  // namespace geotherm
