// SPDX-License-Identifier: MIT
#include "app/picture/outward.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "solver/geometry/face_gradient.h"

namespace geotherm::app {
namespace {

Vec3 normal_of(const TriangleMesh& mesh, Index face) {
  const auto& [a, b, c] = mesh.faces()[face];
  const auto at = mesh.positions();
  return unit_normal(at[a], at[b], at[c]);
}

Outward outward_of(std::span<const Vec3> normals) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& normal : normals) sum += normal;
  const Vec3 way = sum.stableNormalized();
  double cosine = 1;
  for (const Vec3& normal : normals) {
    if (!normal.isZero(0)) cosine = std::min(cosine, way.dot(normal));
  }
  if (way.isZero(0) || cosine <= 0) return kAllAround;
  const Eigen::Vector3f floats = way.cast<float>();
  return {floats.x(), floats.y(), floats.z(), static_cast<float>(std::sqrt(1 - cosine * cosine))};
}

}  // namespace

std::vector<Outward> outward_at(const TriangleMesh& mesh, std::span<const OutwardPlace> places) {
  std::map<Index, std::vector<Vec3>> about;  // of the vertices
  std::vector<char> wanted(static_cast<std::size_t>(mesh.vertex_count()), 0);
  for (const OutwardPlace& place : places) {
    for (const Index v : place.vertices) {
      if (v != kNoIndex) wanted[static_cast<std::size_t>(v)] = 1;
    }
  }
  for (Index f = 0; f < mesh.face_count(); ++f) {
    for (const Index v : mesh.faces()[f]) {
      if (wanted[static_cast<std::size_t>(v)] != 0) about[v].push_back(normal_of(mesh, f));
    }
  }
  std::vector<Outward> out;
  for (const OutwardPlace& place : places) {
    std::vector<Vec3> normals;
    for (const Index v : place.vertices) {
      if (v != kNoIndex) normals.insert(normals.end(), about[v].begin(), about[v].end());
    }
    if (place.face != kNoIndex) normals.push_back(normal_of(mesh, place.face));
    out.push_back(outward_of(normals));
  }
  return out;
}

}  // namespace geotherm::app
