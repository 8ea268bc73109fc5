// SPDX-License-Identifier: MIT
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "geotherm/domains.h"
#include "solver/mesh/local_simplex.h"
#include "solver/volume/clean_tets.h"

namespace geotherm {
namespace {

using LocalTet = LocalSimplex<4>;

/// The query itself where the tet holds it: exactly there, not to round-off.
bool offer_volume(LocalTet& t) {
  const auto& [a, b, c, d] = t.corners;
  LocalTet::Weights w = {b.dot(c.cross(d)), -a.dot(c.cross(d)), a.dot(b.cross(d)),
                         -a.dot(b.cross(c))};
  const double sum = w[0] + w[1] + w[2] + w[3];
  if (sum < 0) {
    for (double& each : w) each = -each;
  }
  // The volume of a flat tet is round-off, and so are its parts.
  if (!(std::abs(sum) > 1e-14) || *std::ranges::min_element(w) < 0) return false;
  for (double& each : w) each /= std::abs(sum);
  t.weights = w;
  t.distance = 0;
  return true;
}

/// Offers the points that may be nearest.
void offer_all(LocalTet& local) {
  // A corner at the query is the corner, whatever round-off makes of its weights.
  for (std::size_t k = 0; k < 4; ++k) {
    if (!local.corners[k].isZero(0)) continue;
    local.distance = 0;
    local.weights[k] = 1;
    return;
  }
  if (offer_volume(local)) return;
  for (int k = 0; k < 4; ++k) {
    const Face face = face_opposite({0, 1, 2, 3}, k);
    local.offer_triangle(face[0], face[1], face[2]);
  }
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i + 1; j < 4; ++j) local.offer_edge(i, j);
  }
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
  LocalTet::Weights best{};
  double distance = std::numeric_limits<double>::infinity();
  Index best_tet = kNoIndex;
  for (Index t = 0; t < mesh.tet_count(); ++t) {
    const Tet& tet = mesh.tets()[t];
    if (!(least_distance(mesh, tet, query) < distance) || !has_volume(mesh, tet)) continue;
    const auto p = mesh.positions();
    LocalTet local({p[tet[0]], p[tet[1]], p[tet[2]], p[tet[3]]}, query);
    offer_all(local);
    if (!(local.distance < distance)) continue;
    distance = local.distance;
    best = local.weights;
    best_tet = t;
  }
  if (best_tet == kNoIndex) {
    return Error{ErrorCode::kBadInput,
                 "none of the " + std::to_string(mesh.tet_count()) +
                     " tetrahedra can hold a point; each has no volume or is infinitely far"};
  }
  for (std::size_t k = 0; k < 4; ++k) {
    if (best[k] != 1.0) continue;
    return ClosestVolumePoint{VolumePoint::at_vertex(mesh.tets()[best_tet][k]), distance};
  }
  return ClosestVolumePoint{VolumePoint::in_tet(best_tet, best), distance};
}

}  // namespace geotherm
