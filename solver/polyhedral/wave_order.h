// SPDX-License-Identifier: MIT
#pragma once

#include <tuple>

#include "solver/geometry/intrinsic_surface.h"

namespace geotherm {

/// By which what a wave meets at one distance is put in order: the coordinates of a vertex, so that
/// no numbering changes the distances, and its number where vertices lie on each other.
using WaveOrder = std::tuple<double, double, double, Index>;

inline WaveOrder order_of(const IntrinsicSurface& base, Index vertex) {
  const Vec3& p = base.position(vertex);
  return {p[0], p[1], p[2], vertex};
}

}  // namespace geotherm
