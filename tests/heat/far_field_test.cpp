// SPDX-License-Identifier: MIT
// At t = h^2 heat falls below the range of doubles after some 700 edges. Directions must not.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geotherm/options.h"
#include "tests/support/solve.h"

namespace geotherm::test {
namespace {

// Far from the source fronts are straight lines across the strip: an edge's length each edge.
constexpr double kSlope = 1e-6;
constexpr double kFarIterative = 1e-6;
constexpr double kFarDirect = 1e-9;

constexpr Index kLength = 5000;

class FarField : public testing::TestWithParam<std::string> {};

TEST_P(FarField, OfAStripOfThousandsOfEdgesIsLinear) {
  const MeshPtr strip = finish(plane_grid(kLength, 2, kLength, 2));
  const auto result = solve(strip, {grid_vertex(kLength, 0, 1)}, with_backend(GetParam()));
  EXPECT_EQ(result.quality.zero_gradient_faces, 0);
  const auto at = [&](Index i) { return result.distances[grid_vertex(kLength, i, 1)]; };
  // Neither the source's neighbourhood nor the strip's end is felt beyond a few dozen edges.
  for (Index i = 100; i < kLength - 100; ++i) {
    ASSERT_NEAR(at(i + 1) - at(i), 1, kSlope) << "edge " << i;
  }
  EXPECT_NEAR(at(kLength), kLength, 1);
}

/// Faces without direction, and the farthest that a vertex of a strip one face wide is off the
/// straight distance from one of its corners.
struct StripErrors {
  Index faces;
  double most;
};
StripErrors strip_errors(Index length, const HeatOptions& options) {
  const Draft draft = plane_grid(length, 1, length, 1);
  const auto result = solve(finish(draft), {0}, options);
  StripErrors out{result.quality.zero_gradient_faces, 0};
  for (std::size_t v = 0; v < draft.positions.size(); ++v) {
    const double straight = (draft.positions[v] - draft.positions[0]).norm();
    out.most = std::max(out.most, std::abs(result.distances[v] - straight));
  }
  return out;
}

TEST_P(FarField, OfAStripOneFaceWideIsRightToTheEndSlow) {
  // What is off is off beside the source and at the strip's end, and nothing is added on the way: a
  // direction that is lost on one face takes up to an edge away.
  constexpr double kEdges = 0.7;
  HeatOptions options = with_backend(GetParam());
  StripErrors errors = strip_errors(GetParam() == "native" ? 200'000 : 60'000, options);
  EXPECT_EQ(errors.faces, 0);
  EXPECT_LE(errors.most, kEdges);
  options.variant = Variant::kClassic;
  errors = strip_errors(60'000, options);
  EXPECT_EQ(errors.faces, 0);
  EXPECT_LE(errors.most, kEdges);
}

TEST_P(FarField, GoesOnBeyondAByteOfRestartsSlow) {
  // At a small t the heat falls by two decades an edge, and 40,000 edges take 270 restarts. The
  // waves are no longer round then: the distance is not judged.
  HeatOptions options = with_backend(GetParam());
  options.variant = Variant::kClassic;
  options.time_step.factor = 0.01;
  EXPECT_EQ(strip_errors(40'000, options).faces, 0);
}

TEST_P(FarField, KeepsDirectionsThroughSeveralColumns) {
  // The same from both ends in one block, where the levels of the columns differ.
  const Index n = 1200;
  const HeatMethod method = method_of(finish(plane_grid(n, 2, n, 2)), with_backend(GetParam()));
  const SourceSet sets[] = {SourceSet::of_vertices({grid_vertex(n, 0, 0)}),
                            SourceSet::of_vertices({grid_vertex(n, n / 2, 1)}),
                            SourceSet::of_vertices({grid_vertex(n, n, 2)})};
  const auto together = method.solve_each(sets);
  ASSERT_TRUE(together) << together.error().message;
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_LE(relative_difference((*together)[c].distances, solve(method, sets[c]).distances),
              kFarDirect);
  }
  // The strip is its own image under a half turn.
  const auto& left = (*together)[0].distances;
  std::vector<double> turned((*together)[2].distances.rbegin(), (*together)[2].distances.rend());
  EXPECT_LE(relative_difference(turned, left), kFarDirect);
}

TEST_P(FarField, OfABlockIsThatOfEachColumn) {
  // Two strips: columns end at different levels, in one strip, in the other or in both.
  const Index length = 2000, shorter = 700;
  Draft draft = plane_grid(length, 2, length, 2);
  const Index second = static_cast<Index>(draft.positions.size());
  append(draft, plane_grid(shorter, 2, shorter, 2));
  const HeatMethod method = method_of(finish(draft), with_backend(GetParam()));
  const Index start = grid_vertex(length, 0, 1), middle = grid_vertex(length, length / 2, 1);
  const Index other = second + grid_vertex(shorter, 3, 1);
  std::vector<SourceSet> sets;
  for (const auto& sources : std::vector<std::vector<Index>>{
           {middle}, {start}, {other}, {start, other}, {start, middle, other}}) {
    sets.push_back(SourceSet::of_vertices(sources));
  }
  const auto together = method.solve_each(sets);
  ASSERT_TRUE(together) << together.error().message;
  for (std::size_t c = 0; c < sets.size(); ++c) {
    const DistanceResult alone = solve(method, sets[c]);
    EXPECT_EQ(alone.quality.zero_gradient_faces, 0) << c;
    EXPECT_LE(relative_difference((*together)[c].distances, alone.distances), kFarDirect) << c;
  }
}

INSTANTIATE_TEST_SUITE_P(Backends, FarField, testing::ValuesIn(direct_backends()),
                         backend_test_name);

/// The radius beyond which an iterative solver that stops by its residual knows nothing.
class IterativeFarField : public testing::TestWithParam<std::string> {
 protected:
  static void expect_agreement(const MeshPtr& mesh, const std::vector<Index>& sources,
                               const HeatOptions& options) {
    EXPECT_LE(relative_difference(
                  solve(mesh, sources, with_backend(GetParam(), options)).distances,
                  solve(mesh, sources, with_backend(direct_backends().front(), options)).distances),
              kFarIterative);
  }
  MeshPtr strip = finish(plane_grid(700, 4, 700, 4));
};

TEST_P(IterativeFarField, AgreesBeyondFiveHundredEdges) {
  expect_agreement(strip, {grid_vertex(700, 0, 2)}, {});
}

TEST_P(IterativeFarField, AgreesWithTheBorderHeld) {
  HeatOptions options;
  options.boundary = BoundaryRule::kDirichlet;
  expect_agreement(strip, {grid_vertex(700, 3, 2)}, options);
}

TEST_P(IterativeFarField, AgreesWithSourcesHeld) {
  HeatOptions options;
  options.heat = HeatMode::kHold;
  expect_agreement(strip, {grid_vertex(700, 0, 2), grid_vertex(700, 9, 2)}, options);
}

TEST_P(IterativeFarField, AgreesAroundALongRing) {
  expect_agreement(finish(torus(1200, 6, 0.004)), {0}, {});
}

INSTANTIATE_TEST_SUITE_P(Backends, IterativeFarField, testing::ValuesIn(iterative_backends()),
                         backend_test_name);

}  // namespace
}  // namespace geotherm::test
