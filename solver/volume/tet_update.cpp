// SPDX-License-Identifier: MIT
#include "solver/volume/tet_update.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

namespace geotherm {
namespace {

/// Least of the value on the segment from a to b plus the way from there. With the value linear
/// along it the minimum is where the way meets the segment at the angle whose cosine is its slope.
double updated_by_edge(const KnownCorner& a, const KnownCorner& b) {
  const Vec3 along = b.offset - a.offset;
  const double length = along.norm();
  const double at_ends = std::min(a.value + a.offset.norm(), b.value + b.offset.norm());
  const double slope = (b.value - a.value) / length;
  if (!(length > 0) || !(std::abs(slope) < 1)) return at_ends;
  const double foot = -a.offset.dot(along) / length;  // from a, where the segment's line is nearest
  const double height = (a.offset + foot / length * along).norm();
  const double at = foot - height * slope / std::sqrt((1 - slope) * (1 + slope));
  if (!(at > 0 && at < length)) return at_ends;
  return a.value + slope * at + std::hypot(height, at - foot);
}

/// The minimum inside the face, where it is there: the front is a plane whose normal n, of length
/// 1, has the three differences of values as its products with the edges: n . offset_i = value_i -
/// u at the corner that is asked about, whose value is u. With g_i the gradients of the hat
/// functions, n = sum of (value_i - u) g_i, and |n| = 1 is a quadratic equation in u.
std::optional<double> updated_by_plane(const std::array<KnownCorner, 3>& known) {
  const Vec3 &a = known[0].offset, &b = known[1].offset, &c = known[2].offset;
  const std::array<Vec3, 3> normals = {b.cross(c), c.cross(a), a.cross(b)};
  const double det = a.dot(normals[0]);
  const double size = a.norm() * b.norm() * c.norm();
  // Below that the gradients are round-off; the edges of the face do instead.
  if (!(std::abs(det) > 1e-12 * size)) return {};
  const double least = std::min({known[0].value, known[1].value, known[2].value});
  Vec3 of_values = Vec3::Zero(), of_ones = Vec3::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    of_values += (known[k].value - least) / det * normals[k];
    of_ones += normals[k] / det;
  }
  const double square = of_ones.squaredNorm();
  const double half = of_values.dot(of_ones);
  const double rest = half * half - square * (of_values.squaredNorm() - 1);
  if (!(rest >= 0)) return {};
  const double u = (half + std::sqrt(rest)) / square;
  const Vec3 ray = u * of_ones - of_values;  // from here against the direction of the front
  // Where the ray leaves the tet: it must be the face, not one of the sides.
  for (const Vec3& normal : normals) {
    if (normal.dot(ray) / det < 0) return {};
  }
  return least + u;
}

}  // namespace

double updated_distance(const std::array<KnownCorner, 3>& known) {
  std::array<KnownCorner, 3> there;
  std::size_t count = 0;
  for (const KnownCorner& corner : known) {
    if (corner.value < kUnreached) there[count++] = corner;
  }
  if (count == 0) return kUnreached;
  if (count == 1) return there[0].value + there[0].offset.norm();
  if (count == 2) return updated_by_edge(there[0], there[1]);
  if (const auto inside = updated_by_plane(known)) return *inside;
  return std::min({updated_by_edge(known[0], known[1]), updated_by_edge(known[1], known[2]),
                   updated_by_edge(known[2], known[0])});
}

FaceCrossing cross_face(const std::array<Vec3, 3>& corners, const Vec3& target) {
  constexpr double kRoundOff = 1e-9;
  const auto& [a, b, c] = corners;
  const double det = a.dot(b.cross(c));
  FaceCrossing crossing;
  // The part of each corner in the target; their sum is 1 on the face and more beyond it.
  std::array<double, 3> parts = {target.dot(b.cross(c)) / det, target.dot(c.cross(a)) / det,
                                 target.dot(a.cross(b)) / det};
  const double sum = parts[0] + parts[1] + parts[2];
  if (!(sum >= 1 - kRoundOff)) return crossing;
  for (std::size_t k = 0; k < 3; ++k) {
    const double weight = parts[k] / sum;
    if (!(weight >= -kRoundOff)) return crossing;
    crossing.weights[k] = weight > kRoundOff ? weight : 0;
  }
  crossing.crosses = true;
  return crossing;
}

}  // namespace geotherm
