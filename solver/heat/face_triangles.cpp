// SPDX-License-Identifier: MIT
#include "solver/heat/face_triangles.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace geotherm {
namespace {

/// A point whose other two weights are below this is a corner.
constexpr double kWeightAtCorner = 1e-6;
/// A point that is nearer to an edge than this share of its length is on it: flatter triangles
/// would be joined with no others.
constexpr double kHeightOnEdge = 1e-4;

Vec3 normal_of(const std::array<Vec3, 3>& at) { return (at[1] - at[0]).cross(at[2] - at[0]); }

}  // namespace

PlaceInTriangle find_triangle(std::span<const std::array<Vec3, 3>> triangles, const Vec3& place) {
  // Triangles that share an edge are as near to what lies on it.
  constexpr double kAsNear = 1e-9;
  PlaceInTriangle out{0, {1, 0, 0}, triangles.front()[0]};
  double nearest = kUnreached, inmost = -kUnreached;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const std::array<Vec3, 3>& at = triangles[t];
    const Vec3 normal = normal_of(at);
    std::array<double, 3> weights{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 &from = at[(k + 1) % 3], &to = at[(k + 2) % 3];
      weights[k] = (to - from).cross(place - from).dot(normal) / normal.squaredNorm();
    }
    const double least = std::ranges::min(weights);
    double sum = 0;
    for (double& weight : weights) sum += weight = std::max(weight, 0.0);
    if (!std::isfinite(least) || !std::isfinite(sum)) continue;
    Vec3 point = Vec3::Zero();
    for (std::size_t k = 0; k < 3; ++k) point += (weights[k] /= sum) * at[k];
    const double apart = (point - place).norm(), tolerance = kAsNear * std::sqrt(normal.norm());
    const bool is_nearer = apart < nearest - tolerance;
    if (!is_nearer && !(apart <= nearest + tolerance && least > inmost)) continue;
    nearest = apart;
    inmost = least;
    out = {t, weights, point};
  }
  return out;
}

void FaceTriangles::add(const std::array<std::int64_t, 3>& corners, const std::array<Vec3, 3>& at) {
  corners_.push_back(corners);
  at_.push_back(at);
}

bool FaceTriangles::insert(std::int64_t number, const Vec3& place,
                           std::vector<SourceOnSide>& on_sides) {
  if (at_.empty()) return false;
  const PlaceInTriangle found = find_triangle(at_, place);
  const auto is_low = [](double weight) { return weight < kWeightAtCorner; };
  if (std::ranges::count_if(found.weights, is_low) > 1) return false;
  const std::array<Vec3, 3>& at = at_[found.triangle];
  const double twice_area = normal_of(at).norm();
  std::size_t edge = 0;  // the corner opposite to the edge that it is nearest to
  double least = kUnreached;
  for (std::size_t k = 0; k < 3; ++k) {
    const double side = (at[(k + 2) % 3] - at[(k + 1) % 3]).squaredNorm();
    const double height = found.weights[k] * twice_area / side;  // over the length of the side
    if (!(height < least)) continue;
    least = height;
    edge = k;
  }
  if (least < kHeightOnEdge) {
    const auto& corners = corners_[found.triangle];
    const SourceOnSide source{corners[(edge + 1) % 3], corners[(edge + 2) % 3], number, found.at};
    if (split_at(source) == 1) on_sides.push_back(source);
    return true;
  }
  constexpr std::array<std::size_t, 3> kAll = {0, 1, 2};
  replace(found.triangle, kAll, number, found.at);
  return true;
}

int FaceTriangles::split_at(const SourceOnSide& source) {
  int count = 0;
  for (std::size_t t = 0, end = size(); t < end; ++t) {
    std::vector<std::size_t> ends;
    for (std::size_t k = 0; k < 3; ++k) {
      if (corners_[t][k] == source.from || corners_[t][k] == source.to) ends.push_back(k);
    }
    if (ends.size() != 2) continue;
    ++count;
    replace(t, ends, source.number, source.place);
  }
  return count;
}

void FaceTriangles::replace(std::size_t triangle, std::span<const std::size_t> instead_of,
                            std::int64_t number, const Vec3& place) {
  const std::array<std::int64_t, 3> corners = corners_[triangle];
  const std::array<Vec3, 3> at = at_[triangle];
  for (const std::size_t k : instead_of) {
    const bool is_first = k == instead_of.front();
    if (!is_first) add(corners, at);
    const std::size_t here = is_first ? triangle : size() - 1;
    corners_[here][k] = number;
    at_[here][k] = place;
  }
}

}  // namespace geotherm
