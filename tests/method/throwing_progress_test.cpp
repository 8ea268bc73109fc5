// SPDX-License-Identifier: MIT
// A progress that throws ends the work like one that says stop, and what it throws arrives. Named
// Parallel, since that was hard on threads: the thread sanitizer runs these tests.
#include <gtest/gtest.h>

#include <functional>
#include <stdexcept>
#include <tuple>

#include "bench/models/generate.h"
#include "geotherm/accuracy.h"
#include "geotherm/build_method.h"
#include "geotherm/many.h"
#include "geotherm/path.h"
#include "solver/mesh/ray_tree.h"
#include "tests/support/shapes.h"

namespace geotherm::test {
namespace {

struct FromProgress : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Throws in call number `call`; later calls fail the test, for the work was to end.
class Thrower {
 public:
  explicit Thrower(int call) : left_(call) {}
  Progress progress() {
    return [this](std::string_view, double) {
      EXPECT_FALSE(thrown_) << "a call after the exception";
      if (--left_ > 0) return true;
      thrown_ = true;
      throw FromProgress("stop");
    };
  }
  bool thrown() const { return thrown_; }

 private:
  int left_;
  bool thrown_ = false;
};

/// Throws in the first call of `work`, the second, and so on to its last, in steps.
void expect_passed_on(const std::function<void(const Progress&)>& work) {
  for (int call = 1;; call = 1 + 2 * call) {
    Thrower thrower(call);
    const Progress progress = thrower.progress();
    try {
      work(progress);
    } catch (const FromProgress&) {
      ASSERT_TRUE(thrower.thrown());
      continue;
    }
    ASSERT_FALSE(thrower.thrown()) << "the exception of call " << call << " was lost";
    EXPECT_GT(call, 1) << "the work never asked";
    return;
  }
}

std::vector<SourceSet> progress_sets() {
  std::vector<SourceSet> sets;
  for (Index k = 0; k < 40; ++k) sets.push_back(SourceSet::of_vertices({5 * k}));
  return sets;
}

class ThrowingProgressParallel : public testing::TestWithParam<std::tuple<MethodKind, int, int>> {
 protected:
  MeshPtr mesh_ = finish(jittered_plane(20, 0.2, 1));

  MethodOptions options() const {
    MethodOptions options;
    options.method = std::get<0>(GetParam());
    options.threads = std::get<1>(GetParam());
    options.refine = std::get<2>(GetParam());
    return options;
  }
  std::shared_ptr<const DistanceMethod> method() const {
    auto made = build_method(mesh_, options());
    EXPECT_TRUE(made);
    return *made;
  }
};

TEST_P(ThrowingProgressParallel, PassesThroughBuild) {
  expect_passed_on(
      [&](const Progress& progress) { EXPECT_TRUE(build_method(mesh_, options(), progress)); });
}

TEST_P(ThrowingProgressParallel, PassesThroughQueriesAndTheMethodAnswersAsBefore) {
  const auto method = this->method();
  const std::vector<SourceSet> sets = progress_sets();
  const auto before = method->solve_each(sets);
  ASSERT_TRUE(before);
  expect_passed_on(
      [&](const Progress& progress) { EXPECT_TRUE(method->solve(sets.front(), {}, progress)); });
  expect_passed_on(
      [&](const Progress& progress) { EXPECT_TRUE(method->solve_each(sets, {}, progress)); });
  const auto after = method->solve_each(sets);
  ASSERT_TRUE(after);
  for (std::size_t k = 0; k < sets.size(); ++k) {
    EXPECT_EQ((*after)[k].distances, (*before)[k].distances);
  }
}

TEST_P(ThrowingProgressParallel, PassesThroughStreamsAndSamples) {
  const auto method = this->method();
  const std::vector<SourceSet> sets = progress_sets();
  expect_passed_on([&](const Progress& progress) {
    const auto sink = [](std::size_t, DistanceResult) { return Result<void>(); };
    EXPECT_TRUE(stream_answers(*method, sets, {.chunk = 8}, sink, progress));
  });
  expect_passed_on([&](const Progress& progress) {
    EXPECT_TRUE(farthest_points(*method, *mesh_, 4, {}, progress));
  });
}

INSTANTIATE_TEST_SUITE_P(EveryMethod, ThrowingProgressParallel,
                         testing::Combine(testing::Values(MethodKind::kHeat, MethodKind::kWavefront,
                                                          MethodKind::kWavefrontFine,
                                                          MethodKind::kFastMarching,
                                                          MethodKind::kExact),
                                          testing::Values(1, 2), testing::Values(0, 1)),
                         [](const auto& test) {
                           std::string name = to_text(std::get<0>(test.param));
                           std::erase(name, '-');
                           return name + "_" + std::to_string(std::get<1>(test.param)) +
                                  "threads_refined" + std::to_string(std::get<2>(test.param));
                         });

TEST(ThrowingProgressParallel, PassesThroughDiagnosis) {
  const MeshPtr mesh = finish(jittered_plane(20, 0.2, 1));
  MethodOptions options;
  options.threads = 2;
  options.boundary = BoundaryRule::kDirichlet;
  const SourceSet sources = SourceSet::of_vertices({200});
  const auto method = *build_method(mesh, options);
  const auto answer = method->solve(sources);
  ASSERT_TRUE(answer);
  const std::vector<double> better(answer->distances.size(), 1.0);
  expect_passed_on([&](const Progress& progress) {
    EXPECT_TRUE(diagnose(mesh, {*method, options, {&sources, 1}, {&answer->distances, 1}},
                         MethodKind::kWavefront, {&better, 1}, kMaxFacesDiagnosed, progress));
  });
}

TEST(ThrowingProgressParallel, PassesThroughPathsTreesAndGenerators) {
  const MeshPtr mesh = finish(jittered_plane(20, 0.2, 1));
  MethodOptions options;
  options.method = MethodKind::kWavefront;
  const PathFinder finder(mesh, *build_method(mesh, options));
  const std::vector<SurfacePoint> ends = {SurfacePoint::at_vertex(0), SurfacePoint::at_vertex(300)};
  expect_passed_on([&](const Progress& progress) { EXPECT_TRUE(finder.find(ends, {}, progress)); });
  // An exception that the library knows itself is no error of the library's here.
  const Progress refusing = [](std::string_view, double) -> bool {
    throw std::system_error(std::make_error_code(std::errc::io_error));
  };
  EXPECT_THROW(static_cast<void>(finder.find(ends, {}, refusing)), std::system_error);
  expect_passed_on([&](const Progress& progress) { EXPECT_TRUE(RayTree::build(mesh, progress)); });
  expect_passed_on(
      [&](const Progress& progress) { EXPECT_TRUE(generate_model("bunny", 1000, progress)); });
}

}  // namespace
}  // namespace geotherm::test
