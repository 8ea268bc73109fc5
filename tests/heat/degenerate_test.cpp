// SPDX-License-Identifier: MIT
// Whatever a file may hold gets distances or one clear error, never something that is no number.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <tuple>

#include "tests/support/mesh_zoo.h"
#include "tests/support/solve.h"

namespace geotherm::test {
namespace {

/// For every vertex whether faces of three different corners join it to `source`.
std::vector<char> reach_of(const TriangleMesh& mesh, Index source) {
  std::vector<Index> parent(static_cast<std::size_t>(mesh.vertex_count()));
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&parent](Index v) {
    while (parent[v] != v) v = parent[v];
    return v;
  };
  std::vector<char> used(parent.size(), 0);
  for (const auto& [a, b, c] : mesh.faces()) {
    if (a == b || b == c || c == a) continue;
    parent[root(a)] = root(b);
    parent[root(b)] = root(c);
    used[a] = used[b] = used[c] = 1;
  }
  std::vector<char> reached(parent.size());
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    reached[v] = static_cast<char>(used[v] && root(v) == root(source));
  }
  return reached;
}

using DegenerateCase = std::tuple<std::string, ZooMesh>;

class EveryMesh : public testing::TestWithParam<DegenerateCase> {
 protected:
  MeshPtr mesh = std::get<1>(GetParam()).mesh();
  Index source = mesh->faces()[mesh->face_count() / 2][0];

  void expect_distances(const HeatOptions& options) const {
    const auto result = solve(mesh, {source}, with_backend(std::get<0>(GetParam()), options));
    const std::vector<char> reached = reach_of(*mesh, source);
    ASSERT_EQ(static_cast<Index>(result.distances.size()), mesh->vertex_count());
    for (Index v = 0; v < mesh->vertex_count(); ++v) {
      const double d = result.distances[v];
      if (reached[v]) {
        EXPECT_TRUE(std::isfinite(d) && d >= 0) << "vertex " << v << " has " << d;
      } else {
        EXPECT_EQ(d, kUnreached) << "vertex " << v;
      }
    }
    EXPECT_EQ(result.distances[source], 0);
  }
};

TEST_P(EveryMesh, HasFiniteDistancesInReachAndInfiniteOnesElsewhere) { expect_distances({}); }

TEST_P(EveryMesh, HasThemWithHeldSourcesAndAHeldBorder) {
  HeatOptions options;
  options.heat = HeatMode::kHold;
  options.boundary = BoundaryRule::kDirichlet;
  expect_distances(options);
}

TEST_P(EveryMesh, HasThemFromInsideAFace) {
  SourceSet inside;
  inside.points = {SurfacePoint::in_face(mesh->face_count() / 2, {0.2, 0.3, 0.5})};
  const auto method = method_of(mesh, with_backend(std::get<0>(GetParam())));
  const auto result = solve(method, inside);
  const std::vector<char> reached = reach_of(*mesh, source);
  for (Index v = 0; v < mesh->vertex_count(); ++v) {
    EXPECT_EQ(std::isfinite(result.distances[v]), reached[v] != 0) << "vertex " << v;
    EXPECT_GE(result.distances[v], 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Backends, EveryMesh,
                         testing::Combine(testing::ValuesIn(backend_names()),
                                          testing::ValuesIn(zoo())),
                         [](const auto& each) {
                           return test_name(std::get<0>(each.param)) + "_" +
                                  std::get<1>(each.param).name;
                         });

class SmoothMesh : public testing::TestWithParam<ZooMesh> {};

TEST_P(SmoothMesh, HasPositiveHeatEverywhere) {
  const MeshPtr mesh = GetParam().mesh();
  QueryOptions query;
  query.fields = true;
  const auto result = solve(method_of(mesh), SourceSet::of_vertices({5}), query);
  ASSERT_EQ(static_cast<Index>(result.heat.size()), mesh->vertex_count());
  for (Index v = 0; v < mesh->vertex_count(); ++v) EXPECT_GT(result.heat[v], 0) << "vertex " << v;
  EXPECT_EQ(result.heat[5], 1);
}

INSTANTIATE_TEST_SUITE_P(Zoo, SmoothMesh, testing::ValuesIn(zoo(kSmooth)), zoo_name);

TEST(MeshAtTheEndOfTheDoubles, IsOneClearErrorWithTheCure) {
  for (const double size : {3e307, 1.7e308}) {
    const auto method =
        HeatMethod::build(finish(transformed(sphere(2), size, Vec3::Zero(), false)));
    ASSERT_FALSE(method) << size;
    EXPECT_EQ(method.error().code, ErrorCode::kBadInput);
    EXPECT_NE(sentence(method.error()).find("scale"), std::string::npos) << method.error().message;
    EXPECT_NE(sentence(method.error()).find("e+30"), std::string::npos) << method.error().message;
  }
}

// Well-shaped triangles whose sizes span eleven decades, about the source: no size is special.
TEST(GradedDisc, HasDistancesOnItsSmallestTriangles) {
  constexpr Index kRings = 100, kAround = 24;
  constexpr double kRelative = 0.05;  // straight sides, and one row of triangles a ring
  Draft draft;
  draft.add(Vec3::Zero());
  for (Index r = 0; r < kRings; ++r) {
    const double radius = std::pow(1.3, r + 1 - kRings);
    for (Index s = 0; s < kAround; ++s) {
      const double angle = 2 * std::numbers::pi * (s + 0.5 * (r % 2)) / kAround;
      draft.add({radius * std::cos(angle), radius * std::sin(angle), 0});
    }
  }
  for (Index s = 0; s < kAround; ++s) {
    const Index next = (s + 1) % kAround;
    draft.faces.push_back({0, 1 + s, 1 + next});
    for (Index r = 0; r + 1 < kRings; ++r) {
      const Index a = 1 + r * kAround, b = a + kAround;
      if (r % 2 == 0) {
        draft.faces.insert(draft.faces.end(),
                           {{a + s, b + s, a + next}, {a + next, b + s, b + next}});
      } else {
        draft.faces.insert(draft.faces.end(),
                           {{a + s, b + s, b + next}, {a + s, b + next, a + next}});
      }
    }
  }
  const auto d = solve(finish(draft), {0}).distances;
  for (std::size_t v = 1; v < d.size(); ++v) {
    EXPECT_NEAR(d[v], draft.positions[v].norm(), kRelative * draft.positions[v].norm()) << v;
  }
}

TEST(MeshWithoutArea, IsOneClearError) {
  Draft points, line;
  points.positions.assign(3, Vec3(1, 2, 3));
  points.faces = {{0, 1, 2}};
  const auto method = HeatMethod::build(finish(points));
  ASSERT_FALSE(method);
  EXPECT_EQ(method.error().code, ErrorCode::kBadInput);
  line.positions = {{0, 0, 0}, {1, 0, 0}};
  line.faces = {{0, 1, 0}, {1, 1, 1}};
  const auto repeated = HeatMethod::build(finish(line));
  ASSERT_FALSE(repeated);
  EXPECT_EQ(repeated.error().code, ErrorCode::kBadInput);
  EXPECT_NE(sentence(repeated.error()).find('2'), std::string::npos) << repeated.error().message;
}

}  // namespace
}  // namespace geotherm::test
