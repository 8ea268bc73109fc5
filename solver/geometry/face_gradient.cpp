// SPDX-License-Identifier: MIT
#include "solver/geometry/face_gradient.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>

namespace geotherm {
namespace {

/// Twice the area over the longest side squared; below it the plane of a triangle is rounding.
constexpr double kFlat = 1e-14;

}  // namespace

Vec3 unit_normal(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 first = b - a, second = c - a;
  const double longest = std::max(first.cwiseAbs().maxCoeff(), second.cwiseAbs().maxCoeff());
  if (!(longest > 0)) return Vec3::Zero();
  // A power of two keeps all digits, and products within the range of doubles.
  const double scale = std::ldexp(1.0, std::clamp(-std::ilogb(longest), -1020, 1020));
  return (scale * first).cross(scale * second).stableNormalized();
}

Vec3 triangle_gradient(const std::array<Vec3, 3>& corners, const std::array<double, 3>& values) {
  // From the corner opposite the longest side, so that needles lose the fewest digits.
  std::array<double, 3> side{};
  for (std::size_t i = 0; i < 3; ++i) {
    side[i] = (corners[(i + 2) % 3] - corners[(i + 1) % 3]).stableNorm();
  }
  const auto base =
      static_cast<std::size_t>(std::max_element(side.begin(), side.end()) - side.begin());
  const double length = side[base];
  const std::size_t next = (base + 1) % 3;
  const std::size_t last = (base + 2) % 3;
  const double rise =
      std::max(std::abs(values[next] - values[base]), std::abs(values[last] - values[base]));
  if (!(length > 0) || !std::isfinite(length) || !(rise > 0) || !std::isfinite(rise)) {
    return Vec3::Zero();
  }
  // Both scales are taken out: products of what is left neither overflow nor underflow.
  const Vec3 a = (corners[next] - corners[base]) / length;
  const Vec3 b = (corners[last] - corners[base]) / length;
  const double rise_a = (values[next] - values[base]) / rise;
  const double rise_b = (values[last] - values[base]) / rise;
  const Vec3 normal = a.cross(b);
  const double size = normal.norm();
  if (!(size > kFlat)) return Vec3::Zero();
  const Vec3 unit = normal / size;
  const Vec3 gradient = (rise_a * b.cross(unit) + rise_b * unit.cross(a)) / size;
  const Vec3 scaled = gradient * (rise / length);
  return scaled.allFinite() ? scaled : Vec3::Zero();
}

std::vector<Vec3> face_gradients(const TriangleMesh& mesh, std::span<const double> values) {
  assert(values.size() == static_cast<std::size_t>(mesh.vertex_count()));
  const std::span<const Vec3> positions = mesh.positions();
  std::vector<Vec3> out;
  out.reserve(static_cast<std::size_t>(mesh.face_count()));
  for (const auto& [a, b, c] : mesh.faces()) {
    out.push_back(triangle_gradient({positions[a], positions[b], positions[c]},
                                    {values[a], values[b], values[c]}));
  }
  return out;
}

}  // namespace geotherm
