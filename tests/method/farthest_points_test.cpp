// SPDX-License-Identifier: MIT
#include "geotherm/many.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "geotherm/build_method.h"
#include "geotherm/mesh.h"
#include "solver/method/farthest_points.h"
#include "tests/support/broken_mesh.h"
#include "tests/support/shapes.h"

namespace geotherm::test {
namespace {

/// Of a distance: what the heat method is off by on a sphere of a thousand faces, both ways.
constexpr double kHeatError = 0.1;

std::shared_ptr<const DistanceMethod> method_on(const MeshPtr& mesh, MethodKind kind,
                                                int threads = 1) {
  MethodOptions options;
  options.method = kind;
  options.threads = threads;
  auto method = build_method(mesh, options);
  EXPECT_TRUE(method) << method.error().message;
  return method ? *method : nullptr;
}

FarthestPoints points_on(const MeshPtr& mesh, Index count, MethodKind kind = MethodKind::kHeat,
                         Index first = kNoIndex, int threads = 1) {
  auto points = farthest_points(*method_on(mesh, kind, threads), *mesh, count, {first});
  EXPECT_TRUE(points) << points.error().message;
  return points ? *std::move(points) : FarthestPoints();
}

Draft two_spheres() {
  Draft draft = sphere(2);
  append(draft, transformed(sphere(2), 0.5, Vec3(9, 0, 0), false));
  return draft;
}

TEST(FarthestPoints, OfASphereAreItsPolesFirst) {
  const auto mesh = finish(sphere(3));
  const auto points = points_on(mesh, 2, MethodKind::kExact, 0);
  ASSERT_EQ(points.samples.size(), 2U);
  EXPECT_EQ(points.samples[0].vertex, 0);
  const Vec3 antipode = mesh->positions()[points.samples[1].vertex];
  const double edge = 0.2;  // of the mesh, at most: the antipode lies within one
  EXPECT_LT((antipode + mesh->positions()[0]).norm(), edge);
  EXPECT_NEAR(points.samples[1].distance, std::numbers::pi, 0.05);
  EXPECT_EQ(points.samples[1].distance, points.samples[0].radius);
  EXPECT_NEAR(points.radius(), std::numbers::pi / 2, 0.05);
}

class FarthestPointsBy : public testing::TestWithParam<MethodKind> {};

// Gonzalez (1985): in a metric samples lie at least the radius apart that they cover.
TEST_P(FarthestPointsBy, LieAsFarApartAsTheyCover) {
  const auto mesh = finish(sphere(3));
  const auto points = points_on(mesh, 30, GetParam());
  for (const FarthestSample& sample : points.samples) {
    EXPECT_GE(sample.distance, points.radius());
  }
  EXPECT_GE(points.separation(), (1 - kHeatError) * points.radius());
  const auto exact = method_on(mesh, MethodKind::kExact);
  double apart = kUnreached;
  for (const FarthestSample& sample : points.samples) {
    const auto d = exact->solve(SourceSet::of_vertices({sample.vertex}));
    for (const FarthestSample& other : points.samples) {
      if (other.vertex != sample.vertex) apart = std::min(apart, d->distances[other.vertex]);
    }
  }
  EXPECT_GE(apart, (1 - kHeatError) * points.radius());
}

TEST_P(FarthestPointsBy, LabelTheNearestOfThem) {
  const auto mesh = finish(torus(40, 20, 0.4));
  const auto method = method_on(mesh, GetParam());
  const auto points = points_on(mesh, 7, GetParam());
  std::vector<std::vector<double>> from;
  for (const FarthestSample& sample : points.samples) {
    from.push_back(method->solve(SourceSet::of_vertices({sample.vertex}))->distances);
  }
  for (Index v = 0; v < mesh->vertex_count(); ++v) {
    double least = kUnreached;
    for (const auto& d : from) least = std::min(least, d[v]);
    EXPECT_EQ(points.distances[v], least) << v;
    ASSERT_GE(points.nearest[v], 0);
    EXPECT_EQ(from[points.nearest[v]][v], least) << v;
  }
  EXPECT_EQ(points.radius(), *std::ranges::max_element(points.distances));
}

TEST_P(FarthestPointsBy, AreSeparatedByTheSmallerOfBothDirections) {
  const auto mesh = finish(jittered_plane(20, 0.4, 3));
  const auto method = method_on(mesh, GetParam());
  const auto points = points_on(mesh, 12, GetParam());
  double apart = kUnreached;
  for (const FarthestSample& sample : points.samples) {
    const auto from = method->solve(SourceSet::of_vertices({sample.vertex}));
    for (const FarthestSample& other : points.samples) {
      if (other.vertex != sample.vertex) apart = std::min(apart, from->distances[other.vertex]);
    }
  }
  EXPECT_EQ(points.separation(), apart);
}

TEST_P(FarthestPointsBy, AreTheSameOnAnyNumberOfThreads) {
  const auto mesh = finish(jittered_plane(20, 0.4, 3));
  const auto one = points_on(mesh, 12, GetParam(), kNoIndex, 1);
  const auto three = points_on(mesh, 12, GetParam(), kNoIndex, 3);
  EXPECT_EQ(one.distances, three.distances);
  EXPECT_EQ(one.nearest, three.nearest);
  for (std::size_t i = 0; i < one.samples.size(); ++i) {
    EXPECT_EQ(one.samples[i].vertex, three.samples[i].vertex);
  }
}

INSTANTIATE_TEST_SUITE_P(Method, FarthestPointsBy,
                         testing::Values(MethodKind::kHeat, MethodKind::kWavefront,
                                         MethodKind::kExact),
                         [](const auto& test) { return to_text(test.param); });

TEST(FarthestPoints, VisitEveryComponentBeforeASecondTimeOne) {
  const auto mesh = finish(two_spheres());
  const auto points = points_on(mesh, 3);
  const Index half = mesh->vertex_count() / 2;
  EXPECT_LT(points.samples[0].vertex, half);
  EXPECT_EQ(points.samples[1].vertex, half);  // the lowest of what is infinitely far
  EXPECT_LT(points.samples[2].vertex, half);  // the larger sphere
  EXPECT_EQ(points.samples[0].radius, kUnreached);
  EXPECT_EQ(points.samples[1].distance, kUnreached);
  EXPECT_TRUE(std::isfinite(points.samples[1].radius));
  EXPECT_TRUE(std::isfinite(points.separation()));
}

TEST(FarthestPoints, MayBeAllVertices) {
  const auto mesh = finish(plane_grid(3, 3, 1, 1));
  const auto points = points_on(mesh, mesh->vertex_count());
  std::set<Index> vertices;
  for (const FarthestSample& sample : points.samples) vertices.insert(sample.vertex);
  EXPECT_EQ(static_cast<Index>(vertices.size()), mesh->vertex_count());
  EXPECT_EQ(points.radius(), 0);
}

TEST(FarthestPoints, CoverVerticesThatAreOne) {
  Draft draft = plane_grid(2, 1, 2, 1);
  Draft other = plane_grid(2, 1, 2, 1);
  for (Vec3& p : other.positions) p.x() += 2;
  append(draft, other);
  auto welded = weld(*finish(draft), 0.0);
  ASSERT_TRUE(welded);
  const auto mesh = std::make_shared<const TriangleMesh>(std::move(welded->mesh));
  const Index copy = draft.vertex_count() / 2;  // lies where vertex 2 does
  ASSERT_EQ(mesh->standing_for(copy), 2);
  const auto points = points_on(mesh, 2, MethodKind::kHeat, copy);
  EXPECT_EQ(points.samples[0].vertex, 2);
  EXPECT_EQ(points.distances[copy], 0);
  EXPECT_EQ(points.nearest[copy], 0);
}

TEST(FarthestPoints, RefuseWhatThereIsNot) {
  Draft draft = plane_grid(1, 1, 1, 1);
  draft.add(Vec3(5, 5, 5));  // in no face
  const auto mesh = finish(draft);
  const auto refusal = [&](Index count, Index first) {
    const auto valid = check_sampling(*mesh, count, {first});
    EXPECT_FALSE(valid);
    return valid ? std::string() : sentence(valid.error());
  };
  EXPECT_NE(refusal(0, kNoIndex).find("1 to 4"), std::string::npos);
  EXPECT_NE(refusal(5, kNoIndex).find("5 samples were asked for"), std::string::npos);
  EXPECT_NE(refusal(1, 9).find("no vertex 9"), std::string::npos);
  EXPECT_NE(refusal(1, 4).find("no face"), std::string::npos);
  EXPECT_TRUE(check_sampling(*mesh, 4, {3}));
  EXPECT_EQ(points_on(mesh, 4).nearest[4], kNoIndex);
}

/// Components of other sizes, so that some have no sample when others have several.
TEST(FarthestPoints, AreTheSameByACrewThatIsAskedLessOften) {
  const auto mesh = finish(two_spheres());
  const auto method = method_on(mesh, MethodKind::kWavefront);
  constexpr Index kSamples = 24;
  constexpr std::size_t kAtOnce = 3;
  const auto alone = farthest_points(*method, *mesh, kSamples);
  int calls = 0;
  const auto solve = [&](std::span<const Index> vertices, const QueryOptions& query,
                         const Progress& progress) -> Result<std::vector<DistanceResult>> {
    ++calls;
    EXPECT_LE(vertices.size(), kAtOnce);
    std::vector<DistanceResult> out;
    for (const Index v : vertices) {
      auto answer = method->solve(SourceSet::of_vertices({v}), query, progress);
      if (!answer) return answer.error();
      out.push_back(*std::move(answer));
    }
    return out;
  };
  const auto together = farthest_points_by({kAtOnce, solve}, *mesh, kSamples);
  ASSERT_TRUE(alone && together);
  EXPECT_EQ(together->distances, alone->distances);
  EXPECT_EQ(together->nearest, alone->nearest);
  for (std::size_t i = 0; i < alone->samples.size(); ++i) {
    EXPECT_EQ(together->samples[i].vertex, alone->samples[i].vertex);
    EXPECT_EQ(together->samples[i].distance, alone->samples[i].distance);
    EXPECT_EQ(together->samples[i].radius, alone->samples[i].radius);
    EXPECT_EQ(together->samples[i].back, alone->samples[i].back);
  }
  EXPECT_LT(calls, 2 * kSamples / 3);  // alone: one more than samples
}

TEST(FarthestPoints, OfAMeshWithoutAreaAreRefusedForThat) {
  Draft point;
  for (int i = 0; i < 3; ++i) point.add(Vec3(1, 1, 1));
  point.faces = {{0, 1, 2}};
  Draft folded = point;
  folded.positions[1] = Vec3(2, 1, 1);
  folded.faces = {{0, 0, 1}};
  for (const Draft& draft : {point, folded}) {
    const auto valid = check_sampling(*finish(draft), 9);
    ASSERT_FALSE(valid);
    EXPECT_EQ(valid.error().code, ErrorCode::kBadFile);
    EXPECT_NE(sentence(valid.error()).find("no face with area (1 face, "), std::string::npos)
        << valid.error().message;
    EXPECT_NE(sentence(valid.error()).find("; check how"), std::string::npos);
  }
}

TEST(FarthestPoints, CanBeCancelledBetweenSamples) {
  const auto mesh = finish(sphere(1));
  std::vector<double> shares;
  const auto points = farthest_points(*method_on(mesh, MethodKind::kHeat), *mesh, 9, {0},
                                      [&](std::string_view stage, double share) {
                                        if (stage == kSamplesStage) shares.push_back(share);
                                        return shares.size() < 3;
                                      });
  ASSERT_FALSE(points);
  EXPECT_EQ(points.error().code, ErrorCode::kCancelled);
  ASSERT_EQ(shares.size(), 3U);
  EXPECT_DOUBLE_EQ(shares[2], 3.0 / 9);
}

class FarthestPointsOnBrokenMeshes : public testing::TestWithParam<int> {};

TEST_P(FarthestPointsOnBrokenMeshes, CoverEveryVertexOfAFaceAndShrink) {
  const auto mesh = finish(broken_mesh(static_cast<std::uint64_t>(GetParam())).draft);
  MethodOptions options;
  options.threads = 1;
  const auto method = build_method(mesh, options);
  if (!method) return;  // refused in one sentence: tests/broken
  std::vector<char> used(mesh->positions().size(), 0);
  for (const Face& f : mesh->faces()) {
    if (f[0] == f[1] || f[1] == f[2] || f[2] == f[0]) continue;
    for (const Index corner : f) used[corner] = 1;
  }
  const auto count = static_cast<Index>(std::min<std::ptrdiff_t>(std::ranges::count(used, 1), 10));
  const auto points = farthest_points(**method, *mesh, count);
  ASSERT_TRUE(points) << points.error().message;
  for (std::size_t i = 1; i < points->samples.size(); ++i) {
    EXPECT_LE(points->samples[i].radius, points->samples[i - 1].radius);
    EXPECT_GE(points->samples[i].distance, points->samples[i].radius);
  }
  if (!std::isfinite(points->radius())) return;  // more components than samples
  for (std::size_t v = 0; v < used.size(); ++v) {
    EXPECT_EQ(points->nearest[v] != kNoIndex, used[v] != 0) << v;
    EXPECT_EQ(std::isfinite(points->distances[v]), used[v] != 0) << v;
  }
}

INSTANTIATE_TEST_SUITE_P(Number, FarthestPointsOnBrokenMeshes, testing::Range(0, 40));

}  // namespace
}  // namespace geotherm::test
