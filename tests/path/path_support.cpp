// SPDX-License-Identifier: MIT
#include "tests/path/path_support.h"

#include <algorithm>
#include <cmath>

#include "geotherm/build_method.h"
#include "solver/path/path_surface.h"

namespace geotherm::test {
namespace {

bool lies_in(const TriangleMesh& mesh, const SurfacePoint& point, Index face) {
  const Face& f = mesh.faces()[face];
  const auto has = [&](Index v) { return std::ranges::count(f, v) > 0; };
  if (point.is_vertex()) return has(point.vertex);
  for (std::size_t k = 0; k < 3; ++k) {
    if (point.weights[k] > 0 && !has(mesh.faces()[point.face][k])) return false;
  }
  return true;
}

bool has_weights(const SurfacePoint& point) {
  const auto& [a, b, c] = point.weights;
  constexpr double kRoundOff = 1e-12;
  return point.is_vertex() || (std::min({a, b, c}) >= 0 && std::abs(a + b + c - 1) < kRoundOff);
}

}  // namespace

PathFinder finder_on(const MeshPtr& mesh, MethodKind kind) {
  MethodOptions options;
  options.method = kind;
  options.threads = 1;
  auto method = build_method(mesh, options);
  EXPECT_TRUE(method) << method.error().message;
  return {mesh, *method};
}

SurfacePath found(const PathFinder& finder, const std::vector<SurfacePoint>& points,
                  const PathOptions& options) {
  auto path = finder.find(points, options);
  EXPECT_TRUE(path) << path.error().message;
  if (!path) return {};
  EXPECT_TRUE(is_path(*finder.surface().mesh(), path->path));
  return path->path;
}

SurfacePath found(const PathFinder& finder, Index from, Index to, const PathOptions& options) {
  return found(finder, {vertex(from), vertex(to)}, options);
}

testing::AssertionResult is_path(const TriangleMesh& mesh, const SurfacePath& path) {
  if (path.points.empty() || path.faces.size() + 1 != path.points.size()) {
    return testing::AssertionFailure()
           << path.points.size() << " points and " << path.faces.size() << " faces";
  }
  const std::vector<Vec3> places = positions_of(mesh, path);
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!places[i].allFinite() || !has_weights(path.points[i])) {
      return testing::AssertionFailure() << "point " << i << " is none";
    }
  }
  for (std::size_t i = 0; i < path.faces.size(); ++i) {
    if (!lies_in(mesh, path.points[i], path.faces[i]) ||
        !lies_in(mesh, path.points[i + 1], path.faces[i])) {
      return testing::AssertionFailure() << "piece " << i << " leaves face " << path.faces[i];
    }
  }
  constexpr double kRoundOff = 1e-12;
  const double length = length_of(mesh, path.points);
  if (!(std::abs(length - path.length) <= kRoundOff * length)) {
    return testing::AssertionFailure() << "length " << path.length << ", pieces " << length;
  }
  return testing::AssertionSuccess();
}

}  // namespace geotherm::test
