// SPDX-License-Identifier: MIT
// The figures that tell a good answer from a bad one.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <numeric>
#include <tuple>

#include "geotherm/backend.h"
#include "geotherm/build_method.h"
#include "solver/accuracy/check_heat.h"
#include "solver/heat/linear_system.h"
#include "solver/heat/surface.h"
#include "tests/heat/faulty_backend.h"
#include "tests/support/mesh_zoo.h"
#include "tests/support/solve.h"

namespace geotherm::test {
namespace {

constexpr double kDirectResidual = 1e-9;
constexpr double kIterativeResidual = 1e-6;
// A distance has slope 1 but at sources, creases and borders: an edge or two on each side of them,
// which on these coarse meshes is a third of the area.
constexpr double kSlopeError = 0.2;
constexpr double kConserved = 1e-11;

using Case = std::tuple<std::string, ZooMesh>;

class QualityFigures : public testing::TestWithParam<Case> {
 protected:
  std::string backend = std::get<0>(GetParam());
  MeshPtr mesh = std::get<1>(GetParam()).mesh();
  bool iterative = (*find_backend(backend))->iterative();
};

TEST_P(QualityFigures, AreGoodOnGoodMeshes) {
  const auto result = solve(mesh, {3, mesh->vertex_count() / 2}, with_backend(backend));
  const Quality& q = result.quality;
  const double residual = iterative ? kIterativeResidual : kDirectResidual;
  EXPECT_LE(q.heat_residual, residual);
  EXPECT_LE(q.poisson_residual, residual);
  EXPECT_EQ(q.zero_gradient_faces, 0);
  EXPECT_LE(q.max_source_distance, residual * largest(result.distances));
  EXPECT_GT(q.eikonal_error_mean, 0);
  EXPECT_LE(q.eikonal_error_mean, kSlopeError);
  EXPECT_EQ(q.iterations_heat > 0, iterative);
  EXPECT_EQ(q.iterations_poisson > 0, iterative || backend == "petsc");  // that of Poisson alone
  EXPECT_TRUE(result.warnings.empty()) << sentence(result.warnings.front());
}

// 1' (A + t L) u = 1' A u: whatever heat goes in is there afterwards, when none can leave.
TEST_P(QualityFigures, HeatIsConserved) {
  const auto surface = build_surface(mesh, **find_backend(backend), LaplacianKind::kAuto, 1);
  ASSERT_TRUE(surface) << surface.error().message;
  const auto system = LinearSystem::build(**surface, 1.0, 1.0, {}, {}, 0.5);
  ASSERT_TRUE(system) << system.error().message;
  Block u = Block::Zero((*surface)->operators->size(), 1);
  u(3, 0) = 2;
  u(40, 0) = 5;
  BlockPool pool;
  ASSERT_TRUE((*system)->solve(u, {}, {pool, 1}));
  const auto& mass = (*surface)->operators->mass;
  double total = 0;
  for (Eigen::Index i = 0; i < u.rows(); ++i) total += mass[i] * u(i, 0);
  EXPECT_NEAR(total, 7, 7 * kConserved);
}

INSTANTIATE_TEST_SUITE_P(Backends, QualityFigures,
                         testing::Combine(testing::ValuesIn(backend_names()),
                                          testing::ValuesIn(zoo(kSmooth))),
                         [](const auto& each) {
                           return test_name(std::get<0>(each.param)) + "_" +
                                  std::get<1>(each.param).name;
                         });

class QualityResponds : public testing::Test {
 protected:
  MeshPtr mesh = finish(sphere(3));
  DistanceResult with_constraint(ConstraintMode mode) const {
    HeatOptions options;
    options.constraint.mode = mode;
    return solve(mesh, {0, 100, 400}, options);
  }
};

TEST_F(QualityResponds, SourcesOffZeroShowBeforeTheyAreMoved) {
  const DistanceResult shifted = with_constraint(ConstraintMode::kPinVertex);
  const DistanceResult pinned = with_constraint(ConstraintMode::kPinSources);
  EXPECT_GT(shifted.quality.max_source_distance, kDirectResidual * largest(shifted.distances));
  EXPECT_LE(pinned.quality.max_source_distance, kDirectResidual * largest(pinned.distances));
}

TEST_F(QualityResponds, DistancesBelowZeroAreCountedAndSaid) {
  HeatOptions options;
  options.constraint.mode = ConstraintMode::kPinVertex;
  options.variant = Variant::kClassic;  // near fields stand in for what is below 0
  const DistanceResult shifted = solve(mesh, {0, 100, 400}, options);
  ASSERT_GT(shifted.quality.clamped_vertices, 0);
  const std::string count = std::to_string(shifted.quality.clamped_vertices) + " vertices (";
  ASSERT_EQ(shifted.warnings.size(), 1U);
  EXPECT_NE(sentence(shifted.warnings[0]).find(count), std::string::npos)
      << sentence(shifted.warnings[0]);
  EXPECT_NE(sentence(shifted.warnings[0]).find("pin-sources"), std::string::npos)
      << sentence(shifted.warnings[0]);
}

TEST_F(QualityResponds, TheWarningOfClampedVerticesSaysWhatItMeans) {
  DistanceResult result;
  result.distances = {0, 0, 3, kUnreached};
  result.quality.reached_vertices = 3;
  result.quality.clamped_vertices = 1;
  result.quality.clamped_reach = 2.5;
  ASSERT_TRUE(assess_heat({}, 1, {}, result));
  ASSERT_EQ(result.warnings.size(), 1U);
  for (const char* part : {"1 vertex (33.3 %)", "no information", "too short", "up to 2.5 from",
                           "use method wavefront"}) {
    EXPECT_NE(sentence(result.warnings[0]).find(part), std::string::npos)
        << sentence(result.warnings[0]);
  }
}

TEST_F(QualityResponds, DistancesWithoutHeatAreBelowTheStraightLineSlow) {
  const AddedBackend noisy(faulty_backend(Fault::kNoise, {}));
  const MeshPtr plane = finish(plane_grid(60, 60, 60, 60));
  for (const bool noise : {false, true}) {
    const DistanceResult result = solve(plane, {0}, with_backend(noise ? "faulty" : "native"));
    EXPECT_EQ(result.quality.below_straight_line > 0, noise);
    EXPECT_EQ(
        std::ranges::any_of(result.warnings,
                            [](const Warning& warning) {
                              return warning.message.find("straight line to the nearest source") !=
                                     std::string::npos;
                            }),
        noise);
    EXPECT_EQ(result.quality.most_below_straight_line > 0.2, noise);
  }
}

TEST_F(QualityResponds, FacesOfSourcesAloneHaveNoSlope) {
  std::vector<Index> all(static_cast<std::size_t>(mesh->vertex_count()));
  std::iota(all.begin(), all.end(), 0);
  const DistanceResult nowhere = solve(mesh, all);
  EXPECT_EQ(nowhere.quality.eikonal_error_mean, 0);
  EXPECT_TRUE(nowhere.warnings.empty()) << sentence(nowhere.warnings.front());
  MethodOptions options;
  options.method = MethodKind::kWavefront;
  const auto waves = build_method(mesh, options);
  ASSERT_TRUE(waves);
  EXPECT_EQ((*waves)->solve(SourceSet::of_vertices(all))->quality.eikonal_error_mean, 0);
}

TEST_F(QualityResponds, ALargeTimeBlursTheSlope) {
  HeatOptions blurred;
  blurred.time_step.factor = 300;
  blurred.variant = Variant::kClassic;
  HeatOptions sharp;
  sharp.variant = Variant::kClassic;
  EXPECT_GT(solve(mesh, {0, 100, 400}, blurred).quality.eikonal_error_mean,
            solve(mesh, {0, 100, 400}, sharp).quality.eikonal_error_mean);
}

TEST_F(QualityResponds, FiguresAreLeftOutWhenNotAsked) {
  QueryOptions query;
  query.quality = false;
  const auto result = solve(method_of(mesh), SourceSet::of_vertices({0}), query);
  EXPECT_EQ(result.quality.eikonal_error_mean, 0);
  EXPECT_EQ(result.distances, solve(mesh, {0}).distances);
}

}  // namespace
}  // namespace geotherm::test
