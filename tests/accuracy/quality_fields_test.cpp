// SPDX-License-Identifier: MIT
#include "geotherm/accuracy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "geotherm/heat_method.h"
#include "geotherm/mesh_report.h"
#include "tests/support/shapes.h"

namespace geotherm::test {
namespace {

// Gradients of numbers of order 1 on triangles that are no needles.
constexpr double kRounding = 1e-12;

DistanceResult answer_on(const MeshPtr& mesh, Index source, HeatOptions options = {}) {
  const auto method = HeatMethod::build(mesh, options);
  EXPECT_TRUE(method) << method.error().message;
  auto answer = method->solve(SourceSet::of_vertices({source}), {.fields = true});
  EXPECT_TRUE(answer) << answer.error().message;
  return *std::move(answer);
}

TEST(QualityFieldTest, EikonalErrorIsThatOfTheSlopeAtAnyScale) {
  for (const double scale : {1e-150, 1.0, 1e150}) {
    const MeshPtr mesh = finish(transformed(plane_grid(4, 3, 2, 1), scale, Vec3::Zero(), false));
    std::vector<double> distances;
    for (const Vec3& p : mesh->positions()) distances.push_back(1.25 * p.x());
    for (const double error : eikonal_errors(*mesh, distances)) {
      EXPECT_NEAR(error, 0.25, kRounding) << scale;
    }
  }
}

TEST(QualityFieldTest, FacesWithoutAreaOrReachHaveNoEikonalError) {
  Draft draft = plane_grid(1, 1, 1, 1);
  const Index far = draft.add({9, 9, 0});
  draft.faces.push_back({0, 0, 1});
  draft.faces.push_back({0, 1, far});
  const MeshPtr mesh = finish(draft);
  const std::vector<double> distances = {0, 1, 1, 2, kUnreached};
  const std::vector<double> errors = eikonal_errors(*mesh, distances);
  EXPECT_TRUE(std::isfinite(errors[0]));
  EXPECT_TRUE(std::isfinite(errors[1]));
  EXPECT_EQ(errors[2], kUnreached);
  EXPECT_EQ(errors[3], kUnreached);
}

TEST(QualityFieldTest, TriangleQualityIsOneForEquilateralAndTheMeanIsTheReports) {
  Draft one;
  one.add({0, 0, 0});
  one.add({1, 0, 0});
  one.add({0.5, std::sqrt(0.75), 0});
  one.faces = {{0, 1, 2}, {0, 0, 1}};
  const std::vector<double> quality = triangle_qualities(*finish(one));
  EXPECT_NEAR(quality[0], 1, kRounding);
  EXPECT_EQ(quality[1], 0);
  const MeshPtr mesh = finish(jittered_plane(8, 0.4, 1));
  const std::vector<double> all = triangle_qualities(*mesh);
  const double sum = std::accumulate(all.begin(), all.end(), 0.0);
  EXPECT_NEAR(sum / mesh->face_count(), inspect_mesh(*mesh).mean_quality, kRounding);
}

TEST(QualityFieldTest, EachNonDelaunayEdgeCountsAtBothOfItsFaces) {
  const MeshPtr mesh = finish(jittered_plane(8, 0.4, 1));
  const std::vector<double> counts = non_delaunay_edges(*mesh);
  const Index edges = inspect_mesh(*mesh).non_delaunay_edges;
  EXPECT_GT(edges, 0);
  EXPECT_EQ(std::accumulate(counts.begin(), counts.end(), 0.0), 2.0 * edges);
  for (const double n : counts) EXPECT_TRUE(n == 0 || n == 1 || n == 2 || n == 3) << n;
}

TEST(QualityFieldTest, LostGradientsAreThoseOfTheQualityFigures) {
  // Heat that is the same everywhere has no direction.
  const MeshPtr mesh = finish(sphere(3));
  DistanceResult answer = answer_on(mesh, 0);
  const std::vector<double> none = lost_gradients(*mesh, answer.distances, answer.log_heat);
  EXPECT_EQ(std::accumulate(none.begin(), none.end(), 0.0), answer.quality.zero_gradient_faces);
  std::ranges::fill(answer.log_heat, 0.0);
  const std::vector<double> all = lost_gradients(*mesh, answer.distances, answer.log_heat);
  EXPECT_EQ(std::accumulate(all.begin(), all.end(), 0.0), mesh->face_count());
}

TEST(QualityFieldTest, AnglesAreExactNearZeroAndNear180Degrees) {
  constexpr double kSmall = 1e-9;  // radians; the cosine is 1 to the last bit
  const std::vector<Vec3> a = {{1e200, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 0}};
  const std::vector<Vec3> b = {{1, kSmall, 0}, {-3, 0, 0}, {1, 0, 0}, {1, 0, 0}};
  const std::vector<double> angles = angles_between(a, b);
  EXPECT_NEAR(angles[0] * std::acos(-1) / 180 / kSmall, 1, 1e-6);
  EXPECT_NEAR(angles[1], 180, kRounding);
  EXPECT_NEAR(angles[2], 90, kRounding);
  EXPECT_EQ(angles[3], kUnreached);
}

class EveryField : public testing::TestWithParam<QualityField> {};

TEST_P(EveryField, HasAValueForEachElementOfItsPlaceAndANameThatReadsBack) {
  const MeshPtr mesh = finish(jittered_plane(6, 0.3, 1));
  const DistanceResult answer = answer_on(mesh, 0);
  const std::vector<double> error(answer.distances.size(), 0.5);
  const DataField field = quality_field(GetParam(), *mesh, answer, error);
  const bool on_faces = field.place == DataField::Place::kFaces;
  EXPECT_EQ(field.values.size(), on_faces ? mesh->faces().size() : mesh->positions().size());
  for (const double value : field.values) EXPECT_FALSE(std::isnan(value));
  if (field.type == DataField::Type::kUint8) {
    for (const double value : field.values) EXPECT_TRUE(value >= 0 && value <= 3) << value;
  }
  EXPECT_EQ(*parse<QualityField>(to_text(GetParam())), GetParam());
  EXPECT_EQ(field.name.find('-'), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Names, EveryField, testing::ValuesIn(all_values<QualityField>()),
                         [](const auto& test) { return described(test.param).name; });

}  // namespace
}  // namespace geotherm::test
