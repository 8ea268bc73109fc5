// SPDX-License-Identifier: MIT
// Set-up and queries stop when they are told to, and what was stopped leaves no trace.
#include <gtest/gtest.h>

#include <atomic>
#include <limits>
#include <semaphore>
#include <set>
#include <string>
#include <thread>
#include <tuple>

#include "tests/support/mesh_zoo.h"
#include "tests/support/sanitized.h"
#include "tests/support/solve.h"

namespace geotherm::test {
namespace {

constexpr int kNever = std::numeric_limits<int>::max();

/// Counts its calls and says stop in the one after `most`.
struct Countdown {
  int most = kNever;
  int calls = 0;
  double share = 0;
  std::set<std::string> stages = {};

  Progress progress() {
    return [this](std::string_view stage, double now) {
      EXPECT_GE(now, share) << stage;
      EXPECT_LE(now, 1) << stage;
      share = now;
      stages.emplace(stage);
      return calls++ < most;
    };
  }
};

struct Work {
  const char* name;
  void (*set)(HeatOptions&);
  std::vector<SourceSet> (*sources)();
};

std::vector<Index> first_vertices(Index count) {
  std::vector<Index> vertices(static_cast<std::size_t>(count));
  for (Index v = 0; v < count; ++v) vertices[static_cast<std::size_t>(v)] = v;
  return vertices;
}

std::vector<SourceSet> inside() { return {SourceSet::of_vertices({300, 77})}; }
std::vector<SourceSet> on_the_border() { return {SourceSet::of_vertices({0, 300})}; }
std::vector<SourceSet> many() { return {SourceSet::of_vertices(first_vertices(200))}; }
std::vector<SourceSet> twenty_sets() {
  std::vector<SourceSet> sets(20);
  for (Index k = 0; k < 20; ++k) {
    sets[static_cast<std::size_t>(k)] = SourceSet::of_vertices({7 * k});
  }
  return sets;
}

const Work kWorks[] = {
    {"plain", [](HeatOptions&) {}, inside},
    {"average", [](HeatOptions& o) { o.boundary = BoundaryRule::kAverage; }, on_the_border},
    {"hold", [](HeatOptions& o) { o.heat = HeatMode::kHold; }, many},
    {"pin_vertex", [](HeatOptions& o) { o.constraint.mode = ConstraintMode::kPinVertex; }, inside},
    {"long_way", [](HeatOptions& o) { o.time_step.factor = 1e-4; }, inside},
    {"blocks", [](HeatOptions& o) { o.threads = 1; }, twenty_sets},
    {"blocks_of_threads", [](HeatOptions& o) { o.threads = 3; }, twenty_sets},
};

void PrintTo(const Work& work, std::ostream* out) { *out << work.name; }

/// Is told to stop, in set-up and in queries.
class CancelQuery : public testing::TestWithParam<std::tuple<std::string, Work>> {
 protected:
  HeatOptions options() const {
    HeatOptions out = with_backend(std::get<0>(GetParam()));
    std::get<1>(GetParam()).set(out);
    return out;
  }
  MeshPtr mesh = finish(jittered_plane(kSanitized ? 18 : 24, 0.35, 4));
  std::vector<SourceSet> sets = std::get<1>(GetParam()).sources();
};

std::vector<std::vector<double>> distances(const Result<std::vector<DistanceResult>>& results) {
  std::vector<std::vector<double>> out;
  EXPECT_TRUE(results);
  if (!results) return out;
  for (const DistanceResult& result : *results) out.push_back(result.distances);
  return out;
}

TEST_P(CancelQuery, EndsItAtThatCallAndLeavesTheMethodUnharmed) {
  const HeatMethod method = method_of(mesh, options());
  Countdown free;
  const auto expected = distances(method.solve_each(sets, {}, free.progress()));
  EXPECT_GE(free.calls, 3);
  const int stride = 1 + free.calls / 8;  // eight calls speak for many, the last among them
  for (int most = free.calls - 1; most >= 0; most -= stride) {
    Countdown countdown{most};
    const auto stopped = method.solve_each(sets, {}, countdown.progress());
    ASSERT_FALSE(stopped) << most;
    EXPECT_EQ(stopped.error().code, ErrorCode::kCancelled);
    EXPECT_EQ(countdown.calls, most + 1) << "nothing is asked after stop";
  }
  EXPECT_EQ(distances(method.solve_each(sets)), expected);
}

TEST_P(CancelQuery, DuringSetUpEndsThatAndAnotherTryWorks) {
  HeatOptions wanted = options();
  const HeatMethod base = method_of(mesh, with_backend(wanted.backend));
  wanted.time_step.factor *= 3;
  Countdown free;
  const auto built = HeatMethod::build(mesh, wanted, free.progress());
  ASSERT_TRUE(built);
  EXPECT_EQ(free.stages, (std::set<std::string>{"operators", "analyze", "factorize"}));
  EXPECT_EQ(free.share, 1);
  for (int most = 0; most < free.calls; ++most) {
    Countdown countdown{most};
    const auto stopped = HeatMethod::build(mesh, wanted, countdown.progress());
    ASSERT_FALSE(stopped) << most;
    EXPECT_EQ(stopped.error().code, ErrorCode::kCancelled);
    EXPECT_EQ(countdown.calls, most + 1);
  }
  for (const int most : {0, 1, 2}) {
    Countdown countdown{most};
    const auto stopped = base.with(wanted, countdown.progress());
    ASSERT_FALSE(stopped) << most;
    EXPECT_EQ(stopped.error().code, ErrorCode::kCancelled);
  }
  const auto other = base.with(wanted);
  ASSERT_TRUE(other);
  EXPECT_EQ(distances(other->solve_each(sets)), distances(built->solve_each(sets)));
}

INSTANTIATE_TEST_SUITE_P(All, CancelQuery,
                         testing::Combine(testing::ValuesIn(backend_names()),
                                          testing::ValuesIn(kWorks)),
                         [](const auto& test) {
                           return test_name(std::get<0>(test.param) + "_" +
                                            std::get<1>(test.param).name);
                         });

TEST(CancelFlips, EndsThemWithAValidMesh) {
  const MeshPtr mesh = finish(jittered_plane(24, 0.35, 4));
  HeatOptions options;
  options.laplacian = LaplacianKind::kIntrinsicDelaunay;
  Countdown free;
  const auto method = HeatMethod::build(mesh, options, free.progress());
  ASSERT_TRUE(method);
  ASSERT_GT(method->flips(), 0);
  Countdown plain;
  options.laplacian = LaplacianKind::kCotan;
  ASSERT_TRUE(HeatMethod::build(mesh, options, plain.progress()));
  EXPECT_GT(free.calls, plain.calls) << "flips ask as well";
}

class CancelIteration : public testing::TestWithParam<std::string> {};

TEST_P(CancelIteration, StopsWithinASolveAndTellsItsShareUntilThenSlow) {
  const HeatMethod method = method_of(finish(plane_grid(120, 120, 1, 1)), with_backend(GetParam()));
  const SourceSet source = SourceSet::of_vertices({7000});
  const QueryOptions distances_only{.quality = false, .fields = false};
  Countdown free;
  const auto result = method.solve(source, distances_only, free.progress());
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_GE(free.calls, 20) << "a share now and then, not only between the steps";
  EXPECT_GT(free.share, 0.9);
  for (const int most : {free.calls / 8, free.calls / 2, free.calls - 1}) {
    Countdown countdown{most};
    const auto stopped = method.solve(source, distances_only, countdown.progress());
    ASSERT_FALSE(stopped);
    EXPECT_EQ(stopped.error().code, ErrorCode::kCancelled);
    EXPECT_EQ(countdown.calls, most + 1);
  }
  EXPECT_EQ(solve(method, source, distances_only).distances, result->distances);
}

INSTANTIATE_TEST_SUITE_P(Backends, CancelIteration, testing::ValuesIn(iterative_backends()),
                         backend_test_name);

class CancelConcurrently : public testing::TestWithParam<std::string> {};

TEST_P(CancelConcurrently, FromAnotherThreadEndsOneQueryAndNoOther) {
  const HeatMethod method =
      method_of(finish(jittered_plane(kSanitized ? 14 : 24, 0.35, 4)), with_backend(GetParam()));
  const std::vector<SourceSet> sets = twenty_sets();
  const auto expected = distances(method.solve_each(sets));
  std::atomic<bool> stop = false;
  std::binary_semaphore started{0}, told{0};
  bool first = true;
  const Progress progress = [&](std::string_view, double) {
    if (first) {
      first = false;
      started.release();
      told.acquire();
    }
    return !stop;
  };
  std::vector<std::vector<double>> beside;
  std::optional<Error> error;
  {
    const std::jthread cancelled([&] {
      const auto result = method.solve_each(sets, {}, progress);
      if (!result) error = result.error();
    });
    const std::jthread other([&] { beside = distances(method.solve_each(sets)); });
    started.acquire();
    stop = true;
    told.release();
  }
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code, ErrorCode::kCancelled);
  EXPECT_EQ(beside, expected);
  EXPECT_EQ(distances(method.solve_each(sets)), expected);
}

INSTANTIATE_TEST_SUITE_P(Backends, CancelConcurrently, testing::ValuesIn(backend_names()),
                         backend_test_name);

}  // namespace
}  // namespace geotherm::test
