// SPDX-License-Identifier: MIT
#include "geotherm/mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace geotherm {
namespace {

using Weights = std::array<double, 3>;

struct Candidate {
  Weights weights{};
  double distance = std::numeric_limits<double>::infinity();
};

/// Corners relative to the query, divided by their largest coordinate: no square over- or
/// underflows, and what is near keeps its digits.
struct LocalTriangle {
  std::array<Vec3, 3> corners;
  double unit;
};

LocalTriangle around(const Vec3& query, const std::array<Vec3, 3>& corners) {
  LocalTriangle local{{corners[0] - query, corners[1] - query, corners[2] - query}, 0.0};
  for (const Vec3& corner : local.corners) {
    local.unit = std::max(local.unit, corner.cwiseAbs().maxCoeff());
  }
  if (local.unit > 0) {
    for (Vec3& corner : local.corners) corner /= local.unit;
  }
  return local;
}

/// The distance is measured at the point that the weights give, so that it is honest even where
/// the weights of a needle are not.
void offer(const LocalTriangle& t, const Weights& w, Candidate& best) {
  const double distance =
      t.unit * (w[0] * t.corners[0] + w[1] * t.corners[1] + w[2] * t.corners[2]).norm();
  if (distance < best.distance) best = {w, distance};
}

void offer_inside(const LocalTriangle& t, Candidate& best) {
  const auto& [a, b, c] = t.corners;
  const Vec3 normal = (b - a).cross(c - a);
  Weights w = {b.cross(c).dot(normal), c.cross(a).dot(normal), a.cross(b).dot(normal)};
  const double sum = w[0] + w[1] + w[2];
  if (!(sum > 0) || std::min({w[0], w[1], w[2]}) < 0) return;
  for (double& each : w) each /= sum;
  offer(t, w, best);
}

void offer_side(const LocalTriangle& t, int k, Candidate& best) {
  const int next = k == 2 ? 0 : k + 1;
  const Vec3 along = t.corners[next] - t.corners[k];
  const double length2 = along.squaredNorm();
  const double s = length2 > 0 ? std::clamp(-t.corners[k].dot(along) / length2, 0.0, 1.0) : 0.0;
  Weights w{};
  w[k] = 1 - s;
  w[next] = s;
  offer(t, w, best);
}

}  // namespace

Result<ClosestPoint> closest_point(const TriangleMesh& mesh, const Vec3& query) {
  if (!query.allFinite()) {
    return Error{ErrorCode::kBadInput, "the point has a coordinate that is not finite"};
  }
  Candidate best;
  Index best_face = kNoIndex;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const Face& face = mesh.faces()[f];
    if (face[0] == face[1] || face[1] == face[2] || face[2] == face[0]) continue;
    const LocalTriangle local = around(
        query, {mesh.positions()[face[0]], mesh.positions()[face[1]], mesh.positions()[face[2]]});
    Candidate here;
    offer_inside(local, here);
    for (int k = 0; k < 3; ++k) offer_side(local, k, here);
    if (!(here.distance < best.distance)) continue;
    best = here;
    best_face = f;
  }
  if (best_face == kNoIndex) {
    return Error{ErrorCode::kBadInput,
                 "none of the " + std::to_string(mesh.face_count()) +
                     " faces can hold a point; each repeats a corner or is infinitely far"};
  }
  for (int k = 0; k < 3; ++k) {
    if (best.weights[k] != 1.0) continue;
    return ClosestPoint{SurfacePoint::at_vertex(mesh.faces()[best_face][k]), best.distance};
  }
  return ClosestPoint{SurfacePoint::in_face(best_face, best.weights), best.distance};
}

}  // namespace geotherm
