// SPDX-License-Identifier: MIT
#include "geotherm/accuracy.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "bench/models/generate.h"
#include "geotherm/heat_method.h"
#include "tests/support/shapes.h"

namespace geotherm::test {
namespace {

using Distances = std::vector<double>;

/// A set-up and the answer to one question.
struct Asked {
  MeshPtr mesh;
  MethodOptions options;
  std::shared_ptr<const DistanceMethod> method;
  std::vector<SourceSet> sources;
  std::vector<Distances> distances;

  CheckedAnswers answers() const { return {*method, options, sources, distances}; }
};

Asked ask(const MeshPtr& mesh, const MethodOptions& options, const std::vector<Index>& sources) {
  Asked asked{mesh, options, *build_method(mesh, options), {}, {}};
  for (const Index v : sources) {
    asked.sources.push_back(SourceSet::of_vertices({v}));
    asked.distances.push_back(asked.method->solve(asked.sources.back())->distances);
  }
  return asked;
}

/// From the middle of a plane distances are straight lines.
Distances straight_lines(const TriangleMesh& mesh, Index from) {
  Distances out;
  for (const Vec3& p : mesh.positions()) out.push_back((p - mesh.positions()[from]).norm());
  return out;
}

TEST(AccuracyTest, MeasuresWhatIsKnownOnThePlaneSlow) {
  constexpr Index kCells = 40;
  const MeshPtr mesh = finish(plane_grid(kCells, kCells, 1, 1));
  const Index middle = grid_vertex(kCells, kCells / 2, kCells / 2);
  const Asked asked = ask(mesh, {}, {middle});
  const auto report = check_accuracy(mesh, asked.answers());
  ASSERT_TRUE(report) << report.error().message;
  ASSERT_TRUE(report->measured);
  EXPECT_EQ(report->reference, MethodKind::kWavefront);
  const DistanceError known = distance_error(asked.distances[0], straight_lines(*mesh, middle));
  // The reference is wrong by some hundredths of a per cent there.
  constexpr double kReference = 1e-3;
  EXPECT_NEAR(report->figures.mean_relative, known.mean_relative, kReference);
  EXPECT_NEAR(report->figures.max_of_range, known.max_of_range, kReference);
  EXPECT_EQ(report->grade, grade_of(known));
}

TEST(AccuracyTest, AFewGrosslyWrongVerticesArePoorWhateverTheMeanSlow) {
  const MeshPtr mesh = finish(sphere(4));
  Asked asked = ask(mesh, {}, {0});
  auto before = check_accuracy(mesh, asked.answers());
  ASSERT_TRUE(before && !before->is_poor()) << before->verdict;
  asked.distances[0][333] *= 1.2;
  const auto report = check_accuracy(mesh, asked.answers());
  ASSERT_TRUE(report);
  EXPECT_LT(report->figures.mean_relative, kGoodError) << "the mean hides it";
  EXPECT_TRUE(report->is_poor());
  EXPECT_EQ(report->figures.worst, 333);
  EXPECT_EQ(report->verdict.rfind("poor: up to ", 0), 0U) << report->verdict;
  ASSERT_TRUE(report->remedy) << report->verdict;
  EXPECT_LE(report->remedy->max_of_range, kMaxOfRange);
}

TEST(AccuracyTest, SeveralSetsHaveTheMeanOfTheMeansAndTheLargestOfAny) {
  const MeshPtr mesh = finish(jittered_plane(12, 0.3, 2));
  const Asked both = ask(mesh, {}, {0, 80});
  const AccuracyOptions options{.search = RemedySearch::kNever};
  const auto joint = check_accuracy(mesh, both.answers(), options);
  ASSERT_TRUE(joint);
  double mean = 0, most = 0;
  std::size_t worst = 0;
  for (std::size_t i = 0; i < 2; ++i) {
    const auto one = check_accuracy(
        mesh, {*both.method, both.options, {&both.sources[i], 1}, {&both.distances[i], 1}},
        options);
    ASSERT_TRUE(one);
    mean += one->figures.mean_relative / 2;
    if (one->figures.max_of_range > most) worst = i;
    most = std::max(most, one->figures.max_of_range);
  }
  EXPECT_DOUBLE_EQ(joint->figures.mean_relative, mean);
  EXPECT_DOUBLE_EQ(joint->figures.max_of_range, most);
  EXPECT_EQ(joint->worst_set, worst);
  EXPECT_EQ(joint->sets, 2U);
}

TEST(AccuracyTest, APoorAnswerNamesACureThatGivesWhatItSaysSlow) {
  constexpr Index kFaces = 4000;
  const auto mesh = std::make_shared<const TriangleMesh>(*generate_model("bunny", kFaces));
  MethodOptions options;
  options.time_step.factor = 100;
  const Asked asked = ask(mesh, options, {0});
  const auto report = check_accuracy(mesh, asked.answers());
  ASSERT_TRUE(report && report->is_poor());
  ASSERT_TRUE(report->remedy) << report->verdict;
  ASSERT_EQ(hint_text({setting_of(*report->remedy)}), "time-factor 1") << report->verdict;
  const auto cured = check_accuracy(mesh, ask(mesh, {}, {0}).answers());
  ASSERT_TRUE(cured);
  // Factors are shared where they can be, which rounds otherwise.
  constexpr double kRounding = 1e-6;
  EXPECT_NEAR(cured->figures.mean_relative, report->remedy->mean_relative, kRounding);
  EXPECT_FALSE(cured->is_poor());
}

TEST(AccuracyTest, TheVerdictHasTheFigureThatMakesItPoorAndTheSameOfTheCure) {
  const MeshPtr mesh = finish(sphere(3));
  Asked asked = ask(mesh, {}, {0});
  const ReferenceAnswers better = *solve_reference(mesh, MethodKind::kExact, asked.sources, 1);
  const double largest = *std::ranges::max_element(better.distances[0]);
  // The mean is fair, which is no reason to call it poor.
  asked.distances = better.distances;
  for (double& d : asked.distances[0]) d *= 1.03;
  constexpr double kTooLarge = 0.2;
  asked.distances[0].back() = better.distances[0].back() + kTooLarge * largest;
  AccuracyReport report = hold_against(asked.distances, MethodKind::kHeat, better);
  ASSERT_TRUE(report.is_poor());
  ASSERT_GT(report.figures.mean_relative, kGoodError);
  ASSERT_LT(report.figures.mean_relative, kFairError);
  ASSERT_TRUE(find_remedy(report, mesh, asked.answers(), better, RemedySearch::kWherePoor));
  ASSERT_TRUE(report.remedy) << report.verdict;
  EXPECT_TRUE(report.verdict.starts_with("poor: up to 20 % of the largest distance"))
      << report.verdict;
  const std::string gain = "with " + hint_text({setting_of(*report.remedy)}) + " it is up to " +
                           percent_text(report.remedy->max_of_range);
  EXPECT_NE(sentence(report).find(gain), std::string::npos) << sentence(report);
  EXPECT_EQ(sentence(report).find(percent_text(report.figures.mean_relative)), std::string::npos);
}

TEST(AccuracyTest, NothingIsMeasuredAgainstAMethodThatIsNoBetter) {
  const MeshPtr mesh = finish(sphere(2));
  MethodOptions options;
  options.method = MethodKind::kWavefrontFine;
  const auto report = check_accuracy(mesh, ask(mesh, options, {0}).answers());
  ASSERT_TRUE(report);
  EXPECT_FALSE(report->measured || report->is_poor());
  EXPECT_FALSE(report->verdict.empty());
}

TEST(AccuracyTest, WavesOnTheTriangulationOfHeatAreThoseOnTheirOwn) {
  Draft needles = jittered_plane(12, 0.45, 3);
  for (Vec3& p : needles.positions) p.x() *= 6;
  const MeshPtr mesh = finish(needles);
  const Asked asked = ask(mesh, {}, {7});
  ASSERT_GT(asked.method->heat()->flips(), 0) << "there is something to share";
  ASSERT_TRUE(asked.method->heat()->delaunay_triangulation());
  const auto shared = solve_reference(mesh, MethodKind::kWavefront, asked.sources, 1,
                                      triangulation_for_waves(*asked.method));
  const auto own = solve_reference(mesh, MethodKind::kWavefront, asked.sources, 1);
  ASSERT_TRUE(shared && own);
  EXPECT_EQ(shared->distances, own->distances);
}

TEST(AccuracyTest, WavesWalkOverInsertedVertices) {
  constexpr double kOfWaves = 3.3e-3;  // the largest error of waves on eleven meshes, of the range
  const MeshPtr mesh = finish(random_delaunay(300, 5));
  const Asked asked = ask(mesh, {}, {7});
  ASSERT_GT(asked.method->heat()->refinement().points, 0);
  const auto shared = solve_reference(mesh, MethodKind::kWavefront, asked.sources, 1,
                                      triangulation_for_waves(*asked.method));
  ASSERT_TRUE(shared);
  const auto& positions = mesh->positions();
  std::vector<double> straight;
  for (const Vec3& p : positions) straight.push_back((p - positions[7]).norm());
  ASSERT_EQ(shared->distances.front().size(), straight.size());
  const DistanceError error = distance_error(shared->distances.front(), straight);
  EXPECT_LE(error.max_of_range, kOfWaves);
}

TEST(AccuracyTest, ATriangulationThatIsNotThatOfWavesIsNotShared) {
  const MeshPtr mesh = finish(jittered_plane(6, 0.45, 3));
  for (const LaplacianKind kind :
       {LaplacianKind::kCotan, LaplacianKind::kIntrinsicDelaunay, LaplacianKind::kTufted}) {
    MethodOptions options;
    options.laplacian = kind;
    const auto method = build_method(mesh, options);
    ASSERT_TRUE(method);
    EXPECT_FALSE((*method)->heat()->delaunay_triangulation());
  }
}

TEST(AccuracyTest, CanBeCancelled) {
  const MeshPtr mesh = finish(sphere(2));
  const auto never = [](std::string_view, double) { return false; };
  const auto report = check_accuracy(mesh, ask(mesh, {}, {0}).answers(), {}, never);
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().code, ErrorCode::kCancelled);
}

TEST(AccuracyTest, SharesAreWrittenAsPerCentsThatCanBeRead) {
  EXPECT_EQ(percent_text(0.0081), "0.81 %");
  EXPECT_EQ(percent_text(0.12), "12 %");
  EXPECT_EQ(percent_text(1.234), "123 %");
}

}  // namespace
}  // namespace geotherm::test
