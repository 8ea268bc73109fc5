// SPDX-License-Identifier: MIT
#include "tests/support/polygons.h"

#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

#include "tests/support/cells.h"

namespace geotherm::test {
namespace {

void add_quad(PolygonMesh& mesh, Index a, Index b, Index c, Index d) {
  mesh.corners.insert(mesh.corners.end(), {a, b, c, d});
  mesh.start.push_back(std::ssize(mesh.corners));
}

double relative_error(const std::vector<double>& distances, const std::vector<double>& exact) {
  double sum = 0;
  for (std::size_t v = 0; v < exact.size(); ++v) {
    if (exact[v] > 0) sum += std::abs(distances[v] - exact[v]) / exact[v];
  }
  return sum;
}

}  // namespace

PolygonMesh quads(Index n, double bend) {
  PolygonMesh out{{}, {0}, {}};
  for (Index i = 0; i <= n; ++i) {
    for (Index j = 0; j <= n; ++j) {
      const double up = (i + j) % 2 == 0 ? bend / n : 0;
      out.positions.push_back({double(i) / n, double(j) / n, up});
    }
  }
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < n; ++j) {
      const Index a = i * (n + 1) + j;
      add_quad(out, a, a + n + 1, a + n + 2, a + 1);
    }
  }
  return out;
}

PolygonMesh moved_quads(Index n, double stretch, double most) {
  PolygonMesh out = quads(n);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> shift(-most, most);
  for (Vec3& at : out.positions) {
    if (at[0] > 0 && at[0] < 1 && at[1] > 0 && at[1] < 1) {
      at[0] += shift(random) / n;
      at[1] += shift(random) / n;
    }
    at[0] *= stretch;
  }
  return out;
}

PolygonMesh quad_torus(double most) {
  constexpr Index kRound = 64, kAcross = 28;
  PolygonMesh out{{}, {0}, {}};
  std::mt19937 random(9);
  std::uniform_real_distribution<double> shift(-most, most);
  for (Index i = 0; i < kRound; ++i) {
    for (Index j = 0; j < kAcross; ++j) {
      const double a = 2 * std::numbers::pi * (i + shift(random)) / kRound;
      const double b = 2 * std::numbers::pi * (j + shift(random)) / kAcross;
      const double r = 1 + 0.4 * std::cos(b);
      out.positions.emplace_back(r * std::cos(a), r * std::sin(a), 0.4 * std::sin(b));
      const Index next = (i + 1) % kRound, above = (j + 1) % kAcross;
      add_quad(out, i * kAcross + j, next * kAcross + j, next * kAcross + above,
               i * kAcross + above);
    }
  }
  return out;
}

PolygonErrors errors_beside_triangles(const PolygonMesh& polygons, MethodKind truth,
                                      std::span<const Index> sources) {
  const auto triangles = std::make_shared<const TriangleMesh>(*triangulated(polygons));
  const auto as_polygons = HeatMethod::build(shared(cells_of(polygons)));
  const auto as_triangles = HeatMethod::build(triangles);
  MethodOptions options;
  options.method = truth;
  const auto method = build_method(triangles, options);
  EXPECT_TRUE(as_polygons && as_triangles && method);
  PolygonErrors errors;
  if (!as_polygons || !as_triangles || !method) return errors;
  for (const Index source : sources) {
    const auto set = SourceSet::of_vertices({source});
    const auto exact = (*method)->solve(set)->distances;
    errors.of_polygons += relative_error(as_polygons->solve(set)->distances, exact);
    errors.of_triangles += relative_error(as_triangles->solve(set)->distances, exact);
  }
  return errors;
}

}  // namespace geotherm::test
