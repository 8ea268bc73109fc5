// SPDX-License-Identifier: MIT
#include "app/session/reference_beside.h"

#include <gtest/gtest.h>

#include "app/session/model_solver.h"
#include "tests/support/shapes.h"

namespace geotherm::test {
namespace {

using app::ReferenceBeside;

const std::vector<SourceSet> kSets = {SourceSet::of_vertices({7})};

TEST(ReferenceBesideTest, IsTheOneThatIsSolvedAfterwards) {
  const auto mesh = finish(jittered_plane(20, 0.45, 3));
  for (const auto laplacian : {LaplacianKind::kAuto, LaplacianKind::kRefined}) {
    ReferenceBeside beside(mesh, MethodKind::kWavefront, kSets);
    HeatOptions options;
    options.laplacian = laplacian;
    const auto heat = HeatMethod::build(mesh, options, {}, beside.starter());
    ASSERT_TRUE(heat);
    ASSERT_TRUE(beside.has_begun());
    const auto early = beside.wait({});
    const auto late =
        solve_reference(mesh, MethodKind::kWavefront, kSets, 1, triangulation_for_waves(*heat));
    ASSERT_TRUE(early && late);
    EXPECT_EQ(early->distances, late->distances);
  }
}

TEST(ReferenceBesideTest, IsNotBegunWhereWavesNeedAnotherTriangulation) {
  const auto mesh = finish(jittered_plane(6, 0.45, 3));
  ReferenceBeside beside(mesh, MethodKind::kWavefront, kSets);
  HeatOptions options;
  options.laplacian = LaplacianKind::kCotan;
  ASSERT_TRUE(HeatMethod::build(mesh, options, {}, beside.starter()));
  EXPECT_FALSE(beside.has_begun());
}

TEST(ReferenceBesideTest, EndsWhereTheUserStopsIt) {
  const auto mesh = finish(plane_grid(50, 50, 1, 1));
  const std::vector<SourceSet> many(10'000,
                                    kSets.front());  // many seconds, were they not cancelled
  ReferenceBeside beside(mesh, MethodKind::kWavefront, many);
  const auto stopped = HeatMethod::build(
      mesh, {}, [](std::string_view stage, double) { return stage != "factorize"; },
      beside.starter());
  ASSERT_FALSE(stopped);
  ASSERT_TRUE(beside.has_begun());
  const auto waited = beside.wait([](std::string_view, double) { return false; });
  ASSERT_FALSE(waited);
  EXPECT_EQ(waited.error().code, ErrorCode::kCancelled);
}

TEST(ReferenceBesideTest, ChangesNothingInTheVerdict) {
  app::Model model;
  model.name = "plane";
  model.mesh = finish(plane_grid(170, 170, 1, 1));
  ASSERT_TRUE(ReferenceBeside::is_worth_it(*model.mesh, 2));
  ASSERT_FALSE(ReferenceBeside::is_worth_it(*model.mesh, 1));
  std::vector<std::shared_ptr<const AccuracyReport>> reports;
  std::vector<std::vector<Index>> nearest;
  for (const int threads : {1, 2}) {
    app::ModelSolver solver(model);
    MethodOptions options;
    options.threads = threads;
    app::Wanted wanted;
    wanted.query.nearest = true;
    wanted.check.against = app::Check::kOn;
    const auto solved = solver.solve(options, {SourceSet::of_vertices({7, 20'000}), {}}, wanted);
    ASSERT_TRUE(solved) << solved.error().message;
    reports.push_back(solved->error);
    nearest.push_back(solved->result.nearest_source);
  }
  EXPECT_EQ(reports[0]->reference, MethodKind::kWavefront);
  EXPECT_EQ(reports[0]->values, reports[1]->values);
  EXPECT_EQ(reports[0]->verdict, reports[1]->verdict);
  EXPECT_EQ(nearest[0].size(), static_cast<std::size_t>(model.mesh->vertex_count()));
  EXPECT_EQ(nearest[0], nearest[1]);
}

}  // namespace
}  // namespace geotherm::test
