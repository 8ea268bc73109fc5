// SPDX-License-Identifier: MIT
#include "geotherm/path.h"

#include <algorithm>

namespace geotherm {
namespace {

/// Weights in a face that holds the point.
SurfacePoint express(const TriangleMesh& mesh, const SurfacePoint& point, Index face) {
  if (!point.is_vertex() && point.face == face) return point;
  SurfacePoint out = SurfacePoint::in_face(face, {});
  const auto put = [&](Index vertex, double weight) {
    const Face& corners = mesh.faces()[face];
    const auto k = std::ranges::find(corners, vertex) - corners.begin();
    if (k < 3) out.weights[static_cast<std::size_t>(k)] += weight;
  };
  if (point.is_vertex()) {
    put(point.vertex, 1);
    return out;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    if (point.weights[k] != 0) put(mesh.faces()[point.face][k], point.weights[k]);
  }
  return out;
}

}  // namespace

Vec3 position_at(const TriangleMesh& mesh, const SurfacePoint& point) {
  if (point.is_vertex()) return mesh.positions()[point.vertex];
  const Face& face = mesh.faces()[point.face];
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    if (point.weights[k] != 0) sum += point.weights[k] * mesh.positions()[face[k]];
  }
  return sum;
}

std::vector<SurfacePoint> points_in_faces(const TriangleMesh& mesh, const SurfacePath& path) {
  std::vector<SurfacePoint> out;
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    const SurfacePoint& point = path.points[i];
    if (!path.faces.empty()) {
      out.push_back(express(mesh, point, path.faces[std::min(i, path.faces.size() - 1)]));
      continue;
    }
    const auto holds = [&](const Face& face) { return std::ranges::count(face, point.vertex) > 0; };
    const auto face =
        point.is_vertex() ? std::ranges::find_if(mesh.faces(), holds) : mesh.faces().end();
    const auto number = static_cast<Index>(face - mesh.faces().begin());
    out.push_back(face == mesh.faces().end() ? point : express(mesh, point, number));
  }
  return out;
}

std::vector<Vec3> positions_of(const TriangleMesh& mesh, const SurfacePath& path) {
  std::vector<Vec3> out;
  out.reserve(path.points.size());
  for (const SurfacePoint& point : path.points) out.push_back(position_at(mesh, point));
  return out;
}

double length_of(const TriangleMesh& mesh, const std::vector<SurfacePoint>& points) {
  double length = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    length += (position_at(mesh, points[i]) - position_at(mesh, points[i - 1])).stableNorm();
  }
  return length;
}

SurfacePath reversed(SurfacePath path) {
  std::ranges::reverse(path.points);
  std::ranges::reverse(path.faces);
  return path;
}

void append(SurfacePath& path, const SurfacePath& next) {
  if (path.points.empty()) {
    path = next;
    return;
  }
  path.points.insert(path.points.end(), next.points.begin() + 1, next.points.end());
  path.faces.insert(path.faces.end(), next.faces.begin(), next.faces.end());
  path.length += next.length;
}

}  // namespace geotherm
