// SPDX-License-Identifier: MIT
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "geotherm/domains.h"
#include "solver/volume/clean_tets.h"

namespace geotherm {
namespace {

using TetWeights = std::array<double, 4>;

struct NearestInTet {
  TetWeights weights{};
  double distance = std::numeric_limits<double>::infinity();
};

/// Corners relative to the query, divided by their largest coordinate: no square over- or
/// underflows, and what is near keeps its digits.
struct LocalTet {
  std::array<Vec3, 4> corners;
  double unit = 0;
};

LocalTet local_tet(const TetMesh& mesh, const Tet& tet, const Vec3& query) {
  LocalTet local;
  for (std::size_t k = 0; k < 4; ++k) {
    local.corners[k] = mesh.positions()[tet[k]] - query;
    local.unit = std::max(local.unit, local.corners[k].cwiseAbs().maxCoeff());
  }
  if (local.unit > 0) {
    for (Vec3& corner : local.corners) corner /= local.unit;
  }
  return local;
}

/// The distance is measured at the point that the weights give, so that it is honest even where
/// the weights of a sliver are not.
void offer_weights(const LocalTet& t, const TetWeights& w, NearestInTet& best) {
  Vec3 point = Vec3::Zero();
  for (std::size_t k = 0; k < 4; ++k) point += w[k] * t.corners[k];
  const double distance = t.unit * point.norm();
  if (distance < best.distance) best = {w, distance};
}

/// The query itself where the tet holds it: exactly there, not to round-off.
bool offer_volume(const LocalTet& t, NearestInTet& best) {
  const auto& [a, b, c, d] = t.corners;
  TetWeights w = {b.dot(c.cross(d)), -a.dot(c.cross(d)), a.dot(b.cross(d)), -a.dot(b.cross(c))};
  const double sum = w[0] + w[1] + w[2] + w[3];
  if (sum < 0) {
    for (double& each : w) each = -each;
  }
  // The volume of a flat tet is round-off, and so are its parts.
  if (!(std::abs(sum) > 1e-14) || *std::ranges::min_element(w) < 0) return false;
  for (double& each : w) each /= std::abs(sum);
  if (0 < best.distance) best = {w, 0.0};
  return true;
}

void offer_face(const LocalTet& t, int opposite, NearestInTet& best) {
  const Face k = face_opposite({0, 1, 2, 3}, opposite);
  const Vec3 &a = t.corners[k[0]], &b = t.corners[k[1]], &c = t.corners[k[2]];
  const Vec3 normal = (b - a).cross(c - a);
  const std::array<double, 3> w = {b.cross(c).dot(normal), c.cross(a).dot(normal),
                                   a.cross(b).dot(normal)};
  const double sum = w[0] + w[1] + w[2];
  if (!(sum > 0) || std::min({w[0], w[1], w[2]}) < 0) return;
  TetWeights all{};
  for (std::size_t i = 0; i < 3; ++i) all[k[i]] = w[i] / sum;
  offer_weights(t, all, best);
}

void offer_edge(const LocalTet& t, std::size_t i, std::size_t j, NearestInTet& best) {
  const Vec3 along = t.corners[j] - t.corners[i];
  const double length2 = along.squaredNorm();
  const double s = length2 > 0 ? std::clamp(-t.corners[i].dot(along) / length2, 0.0, 1.0) : 0.0;
  TetWeights w{};
  w[i] = 1 - s;
  w[j] = s;
  offer_weights(t, w, best);
}

NearestInTet nearest_in(const LocalTet& local) {
  NearestInTet here;
  // A corner at the query is the corner, whatever round-off makes of its weights.
  for (std::size_t k = 0; k < 4; ++k) {
    if (local.corners[k].isZero(0)) {
      here.distance = 0;
      here.weights[k] = 1;
      return here;
    }
  }
  if (offer_volume(local, here)) return here;
  for (int k = 0; k < 4; ++k) offer_face(local, k, here);
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i + 1; j < 4; ++j) offer_edge(local, i, j, here);
  }
  return here;
}

bool has_volume(const TetMesh& mesh, const Tet& tet) {
  const auto p = mesh.positions();
  const double volume = tet_gradient(p[tet[0]], p[tet[1]], p[tet[2]], p[tet[3]]).volume;
  return volume != 0 && std::isfinite(volume);
}

/// No point of the tet is nearer: the distance to its box.
double least_distance(const TetMesh& mesh, const Tet& tet, const Vec3& query) {
  Vec3 low = mesh.positions()[tet[0]], high = low;
  for (std::size_t k = 1; k < 4; ++k) {
    low = low.cwiseMin(mesh.positions()[tet[k]]);
    high = high.cwiseMax(mesh.positions()[tet[k]]);
  }
  return (low - query).cwiseMax(query - high).cwiseMax(0.0).maxCoeff();
}

}  // namespace

Result<ClosestVolumePoint> closest_point(const TetMesh& mesh, const Vec3& query) {
  if (!query.allFinite()) {
    return Error{ErrorCode::kBadInput, "the point has a coordinate that is not finite"};
  }
  NearestInTet best;
  Index best_tet = kNoIndex;
  for (Index t = 0; t < mesh.tet_count(); ++t) {
    const Tet& tet = mesh.tets()[t];
    if (!(least_distance(mesh, tet, query) < best.distance) || !has_volume(mesh, tet)) continue;
    const NearestInTet here = nearest_in(local_tet(mesh, tet, query));
    if (!(here.distance < best.distance)) continue;
    best = here;
    best_tet = t;
  }
  if (best_tet == kNoIndex) {
    return Error{ErrorCode::kBadInput,
                 "none of the " + std::to_string(mesh.tet_count()) +
                     " tetrahedra can hold a point; each has no volume or is infinitely far"};
  }
  for (std::size_t k = 0; k < 4; ++k) {
    if (best.weights[k] != 1.0) continue;
    return ClosestVolumePoint{VolumePoint::at_vertex(mesh.tets()[best_tet][k]), best.distance};
  }
  return ClosestVolumePoint{VolumePoint::in_tet(best_tet, best.weights), best.distance};
}

}  // namespace geotherm
