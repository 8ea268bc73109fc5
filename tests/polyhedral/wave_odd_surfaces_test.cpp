// SPDX-License-Identifier: MIT
// Surfaces that textbooks exclude: edges with three faces, fans that touch, damaged faces.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <tuple>

#include "tests/polyhedral/wave_fixture.h"
#include "tests/support/compare.h"
#include "tests/support/mesh_zoo.h"

namespace geotherm::test {
namespace {

/// Whether vertices are joined by faces to vertex `from`.
std::vector<bool> joined_to(const TriangleMesh& mesh, Index from) {
  std::vector<Index> parent(static_cast<std::size_t>(mesh.vertex_count()));
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&parent](Index v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const auto& [a, b, c] : mesh.faces()) {
    if (a == b || b == c || c == a) continue;
    parent[root(a)] = root(b);
    parent[root(b)] = root(c);
  }
  std::vector<bool> out;
  for (Index v = 0; v < mesh.vertex_count(); ++v) out.push_back(root(v) == root(from));
  return out;
}

class AnyMesh : public testing::TestWithParam<std::tuple<ZooMesh, MethodKind>> {
 protected:
  MeshPtr mesh = std::get<0>(GetParam()).mesh();
  MethodKind kind = std::get<1>(GetParam());
};

TEST_P(AnyMesh, HasFiniteDistancesWhereSourcesCanBeAndInfiniteElsewhere) {
  const Index source = mesh->faces()[0][0];
  const auto result =
      solve(*method_of(mesh, kind), SourceSet::of_vertices({source}), {true, false, true});
  const auto joined = joined_to(*mesh, source);
  for (Index v = 0; v < mesh->vertex_count(); ++v) {
    const double d = result.distances[v];
    if (joined[v]) {
      EXPECT_TRUE(std::isfinite(d) && d >= 0) << "vertex " << v << ": " << d;
    } else {
      EXPECT_EQ(d, kUnreached) << "vertex " << v;
    }
    EXPECT_EQ(result.nearest_source[v], joined[v] ? 0 : kNoIndex);
  }
  EXPECT_EQ(result.distances[source], 0);
  EXPECT_TRUE(std::isfinite(result.quality.eikonal_error_mean));
}

TEST_P(AnyMesh, IsNoShorterThanStraightLines) {
  // Degenerate faces are mollified, which lengthens; waves undercut by their error alone.
  constexpr double kWaveError = 0.02;
  const Index source = mesh->faces()[0][0];
  const auto d = distances(mesh, kind, SourceSet::of_vertices({source}));
  const double range = largest(d);
  for (Index v = 0; v < mesh->vertex_count(); ++v) {
    const double straight = (mesh->positions()[v] - mesh->positions()[source]).norm();
    EXPECT_GE(d[v], straight - kWaveError * range) << "vertex " << v;
  }
}

INSTANTIATE_TEST_SUITE_P(Zoo, AnyMesh,
                         testing::Combine(testing::ValuesIn(zoo()), testing::ValuesIn(kWaveKinds)),
                         name_and_kind);

/// Pages that share the edges of a spine, x = 0; page p stands at its own angle.
Draft book(Index pages, Index n) {
  Draft draft;
  for (Index j = 0; j <= n; ++j) draft.add({0, static_cast<double>(j) / n, 0});
  for (Index p = 0; p < pages; ++p) {
    const Index first = draft.vertex_count();
    const double angle = 6.283185307179586 * p / pages;
    for (Index i = 1; i <= n; ++i) {
      const double x = static_cast<double>(i) / n;
      for (Index j = 0; j <= n; ++j) {
        draft.add({x * std::cos(angle), static_cast<double>(j) / n, x * std::sin(angle)});
      }
    }
    const auto at = [&](Index i, Index j) { return i == 0 ? j : first + (i - 1) * (n + 1) + j; };
    for (Index i = 0; i < n; ++i) {
      for (Index j = 0; j < n; ++j) {
        const Index a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
        draft.faces.insert(draft.faces.end(), {{a, b, c}, {a, c, d}});
      }
    }
  }
  return draft;
}

class Books : public testing::TestWithParam<std::tuple<Index, MethodKind>> {};

// Shares of the range. Any two pages unfold into a plane, on which round waves are exact; fast
// marching is of first order, with twelve edges a page: measured 0.08.
constexpr double kOddRoundOff = 1e-9;
constexpr double kFirstOrder = 0.12;

TEST_P(Books, HaveStraightWaysFromPageToPage) {
  const auto [pages, kind] = GetParam();
  constexpr Index kN = 12;
  const MeshPtr mesh = finish(book(pages, kN));
  const Index source = (kN + 1) + 5 * (kN + 1) + 6;  // page 0, (6, 6)
  const Vec3& s = mesh->positions()[source];
  const auto d = distances(mesh, kind, SourceSet::of_vertices({source}));
  std::vector<double> exact;
  for (Index v = 0; v < mesh->vertex_count(); ++v) {
    const Vec3& p = mesh->positions()[v];
    const bool same_page = v < (kN + 1) * (kN + 1);
    const double from_spine = std::hypot(p.x(), p.z());
    exact.push_back(same_page ? (p - s).norm() : std::hypot(s.x() + from_spine, p.y() - s.y()));
  }
  EXPECT_LE(relative_difference(d, exact),
            kind == MethodKind::kFastMarching ? kFirstOrder : kOddRoundOff);
}

INSTANTIATE_TEST_SUITE_P(
    Pages, Books, testing::Combine(testing::Values(1, 2, 3, 5), testing::ValuesIn(kWaveKinds)),
    [](const auto& each) {
      return std::to_string(std::get<0>(each.param)) + "_" + kind_name(std::get<1>(each.param));
    });

class TouchingFans : public testing::TestWithParam<MethodKind> {};

TEST_P(TouchingFans, LetDistancePass) {
  Draft draft;
  draft.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}};
  draft.faces = {{0, 1, 2}, {0, 3, 4}};
  const auto d = distances(finish(draft), GetParam(), SourceSet::of_vertices({1}));
  const double expected[] = {1, 0, 1, 2, 1 + std::sqrt(2.0)};
  for (int v = 0; v < 5; ++v) EXPECT_NEAR(d[v], expected[v], 1e-12);
}

TEST_P(TouchingFans, OneTriangleIsExact) {
  Draft draft;
  draft.positions = {{0, 0, 0}, {3, 0, 0}, {0, 4, 0}};
  draft.faces = {{0, 1, 2}};
  const MeshPtr mesh = finish(draft);
  EXPECT_EQ(distances(mesh, GetParam(), SourceSet::of_vertices({1}))[2], 5);
  const auto d = distances(mesh, GetParam(), {{SurfacePoint::in_face(0, {0.5, 0.25, 0.25})}, {}});
  EXPECT_NEAR(d[0], std::hypot(0.75, 1.0), 1e-12);
  EXPECT_NEAR(d[1], std::hypot(2.25, 1.0), 1e-12);
  EXPECT_NEAR(d[2], std::hypot(0.75, 3.0), 1e-12);
}

TEST_P(TouchingFans, StretchedStripsHandDistanceOn) {
  // Along the lower border from the left end: no sample on the long sides to the right end's upper
  // corner, a source itself, comes to know of it.
  constexpr Index kLength = 6;
  const Index upper = grid_vertex(kLength, kLength, 1), lower = grid_vertex(kLength, kLength, 0);
  const auto d = distances(finish(plane_grid(kLength, 1, kLength, 40)), GetParam(),
                           SourceSet::of_vertices({0, upper, grid_vertex(kLength, 2, 1)}));
  const bool first_order = GetParam() == MethodKind::kFastMarching;
  EXPECT_NEAR(d[lower], kLength, first_order ? 0.05 : 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Methods, TouchingFans, testing::ValuesIn(kWaveKinds),
                         [](const auto& each) { return kind_name(each.param); });

}  // namespace
}  // namespace geotherm::test
