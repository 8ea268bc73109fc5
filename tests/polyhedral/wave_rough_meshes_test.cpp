// SPDX-License-Identifier: MIT
// Stretched, flattened, noisy and coarse meshes against exact distances.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <vector>

#include "bench/models/generate.h"
#include "solver/polyhedral/wave_surface.h"
#include "tests/polyhedral/wave_fixture.h"

namespace geotherm::test {
namespace {

Draft model(const char* name, Index faces) {
  const auto mesh = generate_model(name, faces);
  EXPECT_TRUE(mesh) << mesh.error().message;
  Draft draft;
  if (!mesh) return draft;
  draft.positions.assign(mesh->positions().begin(), mesh->positions().end());
  draft.faces.assign(mesh->faces().begin(), mesh->faces().end());
  return draft;
}

Draft scaled(Draft draft, const Vec3& by) {
  for (Vec3& p : draft.positions) p = p.cwiseProduct(by);
  return draft;
}

/// Every coordinate moved by up to `amount` mean edges.
Draft noisy(Draft draft, double amount) {
  double sum = 0;
  for (const Face& face : draft.faces) {
    sum += (draft.positions[face[0]] - draft.positions[face[1]]).norm();
  }
  const double edge = sum / static_cast<double>(draft.faces.size());
  std::mt19937 random(3);
  std::uniform_real_distribution<double> share(-amount * edge, amount * edge);
  for (Vec3& p : draft.positions) {
    for (int c = 0; c < 3; ++c) p(c) += share(random);
  }
  return draft;
}

struct RoughMesh {
  const char* name;
  Draft (*draft)();
};
const RoughMesh kMeshes[] = {
    {"stretched_by_10",
     [] {
       return scaled(model("bunny", 2000), {10, 1, 1});
     }},
    {"stretched_by_20",
     [] {
       return scaled(model("gargoyle", 2000), {1, 20, 1});
     }},
    {"flattened",
     [] {
       return scaled(model("gargoyle", 3000), {1, 1, 0.05});
     }},
    {"noisy", [] { return noisy(model("bunny", 2000), 0.2); }},
    {"coarse", [] { return model("gargoyle", 1000); }},
    {"coarse_torus", [] { return torus(32, 16, 0.4); }},
};
void PrintTo(const RoughMesh& mesh, std::ostream* out) { *out << mesh.name; }

// Mean errors in per cent, as the project promises.
const std::map<MethodKind, double> kBounds = {{MethodKind::kWavefront, 0.25},
                                              {MethodKind::kWavefrontFine, 0.1},
                                              {MethodKind::kFastMarching, 5}};

class RoughMeshes : public testing::TestWithParam<RoughMesh> {};

TEST_P(RoughMeshes, AreMeasuredWithinTheMethodsBounds) {
  const MeshPtr mesh = finish(GetParam().draft());
  const SourceSet set = SourceSet::of_vertices({mesh->vertex_count() / 3});
  const auto exact = distances(mesh, MethodKind::kExact, set);
  for (const MethodKind kind : kWaveKinds) {
    EXPECT_LE(errors(distances(mesh, kind, set), exact).mean, kBounds.at(kind)) << kind_name(kind);
  }
}

INSTANTIATE_TEST_SUITE_P(Meshes, RoughMeshes, testing::ValuesIn(kMeshes),
                         [](const auto& each) { return each.param.name; });

/// Random points of the unit square, with thin obtuse faces along the border, and four sources.
class BorderSlivers : public testing::TestWithParam<unsigned> {
 protected:
  MeshPtr mesh = finish(random_delaunay(900, GetParam()));
  std::vector<Index> sources = {3, 225, 450, 675};

  double straight(Index v, Index source) const {
    return (mesh->positions()[v] - mesh->positions()[source]).norm();
  }
};

TEST_P(BorderSlivers, LeaveDistancesAndLabelsOfWavesRight) {
  // What waves are off by on random meshes at most, of the range (docs/numerics.md).
  constexpr double kTaken = 0.015;
  std::vector<double> exact;
  for (Index v = 0; v < mesh->vertex_count(); ++v) {
    double least = kUnreached;
    for (const Index s : sources) least = std::min(least, straight(v, s));
    exact.push_back(least);
  }
  const double allowed = kTaken * *std::ranges::max_element(exact);
  for (const MethodKind kind : kRoundWaves) {
    const auto answer = solve(*method_of(mesh, kind), SourceSet::of_vertices(sources),
                              {.quality = false, .nearest = true});
    ASSERT_EQ(answer.distances.size(), exact.size()) << "inserted vertices are not told";
    for (Index v = 0; v < mesh->vertex_count(); ++v) {
      EXPECT_NEAR(answer.distances[v], exact[v], allowed) << kind_name(kind) << " " << v;
      EXPECT_LE(straight(v, sources[answer.nearest_source[v]]), exact[v] + 2 * allowed)
          << kind_name(kind) << " " << v;
    }
  }
}

TEST_P(BorderSlivers, ChangeNothingForMethodsThatInsertNoVertices) {
  const auto waves = build_wave_surface(mesh);
  ASSERT_TRUE(waves);
  ASSERT_GT((*waves)->base.refinement.points, 0);
  const SourceSet set = SourceSet::of_vertices(sources);
  for (const MethodKind kind : {MethodKind::kFastMarching, MethodKind::kExact}) {
    MethodOptions options;
    options.method = kind;
    const auto sharing = build_method(mesh, options, {}, *waves);
    ASSERT_TRUE(sharing);
    EXPECT_EQ(solve(**sharing, set).distances, distances(mesh, kind, set)) << kind_name(kind);
  }
}

/// Three pages at one edge, flat triangles: a vertex on the edge of one page alone would be a slit.
TEST(FlatPages, AreCrossedAtTheirCommonEdge) {
  constexpr double kHeight = 0.1, kThird = 2 * std::numbers::pi / 3;
  Draft book;
  book.positions = {{0, 0, 0}, {1, 0, 0}};
  for (int page = 0; page < 3; ++page) {
    book.positions.emplace_back(0.5, kHeight * std::cos(page * kThird),
                                kHeight * std::sin(page * kThird));
    book.faces.push_back({0, 1, 2 + page});
  }
  const MeshPtr mesh = finish(book);
  for (const MethodKind kind : kRoundWaves) {
    const auto d = distances(mesh, kind, SourceSet::of_vertices({2}));
    for (const Index other : {3, 4}) EXPECT_NEAR(d[other], 2 * kHeight, 1e-12) << kind_name(kind);
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, BorderSlivers, testing::Range(1U, 7U));

}  // namespace
}  // namespace geotherm::test
