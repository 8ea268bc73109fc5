// SPDX-License-Identifier: MIT
// A backend that fails is replaced, and the answer says so.
#include <gtest/gtest.h>

#include <thread>

#include "geotherm/backend.h"
#include "tests/heat/faulty_backend.h"
#include "tests/support/solve.h"

namespace geotherm::test {
namespace {

const SourceSet kSources = SourceSet::of_vertices({7, 40});
const Error kPivot = {ErrorCode::kNumericalFailure, "pivot 3 of 8", {"try another"}, "faulty"};
const Error kMemory = {
    ErrorCode::kOutOfMemory, "ran out of memory at 9 MB", {"try less"}, "faulty"};
const Error kBudget = {ErrorCode::kBudgetEnded, "50 iterations ended", {"try more"}, "faulty"};

HeatOptions asking(const std::string& backend, bool strict = false) {
  HeatOptions options = with_backend(backend);
  options.strict = strict;
  return options;
}

bool says(const std::vector<Warning>& warnings, const std::string& text) {
  return std::ranges::count(warnings, text, &Warning::message) == 1;
}

struct Failing {
  const char* name;
  Fault fault;
  Error error;
};

void PrintTo(const Failing& f, std::ostream* out) { *out << f.name; }

class FailingSetup : public testing::TestWithParam<Failing> {
 protected:
  MeshPtr mesh = finish(torus(24, 12, 0.4));
  AddedBackend added{faulty_backend(GetParam().fault, GetParam().error)};
  // What ended for want of memory goes to a backend without a factor.
  std::string next = GetParam().error.code == ErrorCode::kOutOfMemory ? iterative_backends().front()
                                                                      : backend_names().front();
};

TEST_P(FailingSetup, IsTakenOverByTheNextBackend) {
  const HeatMethod method = method_of(mesh, asking("faulty"));
  EXPECT_EQ(method.options().backend, next);
  ASSERT_EQ(method.fallbacks().size(), 1U);
  EXPECT_EQ(method.fallbacks()[0].backend, "faulty");
  EXPECT_TRUE(says(method.warnings(), "faulty failed: " + method.fallbacks()[0].error.message +
                                          "; " + next + " took over"));
  const DistanceResult answer = solve(method, kSources);
  EXPECT_EQ(answer.distances, solve(method_of(mesh, asking(next)), kSources).distances);
  EXPECT_EQ(answer.backend, next);
  EXPECT_TRUE(answer.fallbacks.empty()) << "the query itself went well";
}

TEST_P(FailingSetup, IsAnErrorWhereStrict) {
  const auto method = HeatMethod::build(mesh, asking("faulty", true));
  ASSERT_FALSE(method);
  EXPECT_EQ(method.error().code, GetParam().error.code);
  EXPECT_EQ(method.error().message, GetParam().error.message);
}

TEST_P(FailingSetup, KeepsTheBackendThatTookOver) {
  HeatOptions options = asking("faulty");
  const HeatMethod method = method_of(mesh, options);
  options.time_step.factor = 2;
  const auto other = method.with(options);
  ASSERT_TRUE(other) << other.error().message;
  EXPECT_EQ(other->options().backend, next);
  EXPECT_EQ(other->timing().analyze, 0) << "nothing was analysed again";
  EXPECT_EQ(other->warnings(), method.warnings());
  options.backend = next;  // and now it is what was asked for
  EXPECT_TRUE(method.with(options)->warnings().empty());
  EXPECT_FALSE(method.with(asking("faulty", true)));
}

INSTANTIATE_TEST_SUITE_P(Of, FailingSetup,
                         testing::Values(Failing{"analysis", Fault::kAnalysis, kPivot},
                                         Failing{"factor", Fault::kFactor, kPivot},
                                         Failing{"memory", Fault::kFactor, kMemory}),
                         [](const auto& each) { return each.param.name; });

class FailingQuery : public testing::TestWithParam<Failing> {
 protected:
  MeshPtr mesh = finish(torus(24, 12, 0.4));
  AddedBackend added{faulty_backend(Fault::kSolve, GetParam().error)};
  std::string next = GetParam().error.code == ErrorCode::kOutOfMemory ? iterative_backends().front()
                                                                      : backend_names().front();
};

TEST_P(FailingQuery, IsAnsweredByTheNextBackend) {
  const HeatMethod method = method_of(mesh, asking("faulty"));
  EXPECT_EQ(method.options().backend, "faulty");
  EXPECT_TRUE(method.warnings().empty());
  const DistanceResult answer = solve(method, kSources);
  EXPECT_EQ(answer.backend, next);
  ASSERT_EQ(answer.fallbacks.size(), 1U);
  EXPECT_TRUE(says(answer.warnings, "faulty failed: " + answer.fallbacks[0].error.message + "; " +
                                        next + " took over"));
  EXPECT_EQ(answer.distances, solve(method_of(mesh, asking(next)), kSources).distances);
}

TEST_P(FailingQuery, IsAnErrorWhereStrict) {
  const auto answer = method_of(mesh, asking("faulty", true)).solve(kSources);
  ASSERT_FALSE(answer);
  EXPECT_EQ(answer.error().code, GetParam().error.code);
}

TEST_P(FailingQuery, GivesTheSameOnConcurrentThreads) {
  const HeatMethod method = method_of(mesh, asking("faulty"));
  std::vector<std::vector<double>> answers(3);
  {
    std::vector<std::jthread> threads;
    threads.reserve(answers.size());
    for (auto& answer : answers) {
      threads.emplace_back([&] {
        if (auto result = method.solve(kSources)) answer = std::move(result->distances);
      });
    }
  }
  const auto expected = solve(method_of(mesh, asking(next)), kSources).distances;
  for (const auto& answer : answers) EXPECT_EQ(answer, expected);
}

INSTANTIATE_TEST_SUITE_P(Of, FailingQuery,
                         testing::Values(Failing{"numbers", Fault::kSolve, kPivot},
                                         Failing{"budget", Fault::kSolve, kBudget},
                                         Failing{"memory", Fault::kSolve, kMemory}),
                         [](const auto& each) { return each.param.name; });

TEST(Fallbacks, DoNotHideBadInputOrExtremeTimes) {
  const MeshPtr mesh = finish(sphere(2));
  const AddedBackend added(faulty_backend(Fault::kFactor, kPivot));
  HeatOptions pinned = asking("faulty");
  pinned.constraint = {ConstraintMode::kPinVertex, 1'000'000, 10};
  EXPECT_EQ(HeatMethod::build(mesh, pinned).error().code, ErrorCode::kBadInput);
  HeatOptions extreme = asking("faulty");
  extreme.time_step.factor = 1e20;
  const auto method = HeatMethod::build(mesh, extreme);
  ASSERT_FALSE(method);
  EXPECT_NE(sentence(method.error()).find("smaller time-factor"), std::string::npos);
}

TEST(Fallbacks, CanBeCancelled) {
  const MeshPtr mesh = finish(sphere(2));
  const AddedBackend added(faulty_backend(Fault::kSolve, kPivot));
  const auto cancelled =
      method_of(mesh, asking("faulty")).solve(kSources, {}, [](std::string_view stage, double) {
        return stage != "analyze";
      });
  ASSERT_FALSE(cancelled) << "the substitute is set up during the query";
  EXPECT_EQ(cancelled.error().code, ErrorCode::kCancelled);
}

class MemoryLimit : public testing::TestWithParam<std::string> {
 protected:
  MeshPtr mesh = finish(jittered_plane(40, 0.35, 4));
  HeatMethod free = method_of(mesh, with_backend(GetParam()));

  /// With room for `mb` of factors, those being made with their working space.
  HeatOptions limited(double mb, bool strict = false) const {
    HeatOptions options = asking(GetParam(), strict);
    options.memory_limit_mb = mb;
    options.threads = 1;
    return options;
  }
};

TEST_P(MemoryLimit, IsKnownBeforeFactorsAreMade) {
  EXPECT_GE(free.forecast_mb(), 0.9 * free.memory_mb());
  if (GetParam() == "petsc") return;  // which foresees a factor for Poisson, and makes none
  EXPECT_LE(free.forecast_mb(), 1.1 * free.memory_mb());
}

TEST_P(MemoryLimit, SendsWhatDoesNotFitToABackendThatDoes) {
  const HeatMethod method = method_of(mesh, limited(free.memory_mb() / 10));
  EXPECT_EQ(method.options().backend, iterative_backends().front());
  EXPECT_EQ(method.memory_mb(), 0);
  ASSERT_EQ(method.fallbacks().size(), direct_backends().size());
  EXPECT_EQ(method.fallbacks()[0].backend, GetParam());
  EXPECT_NE(sentence(method.warnings()[0]).find("MB for 2 factors"), std::string::npos)
      << sentence(method.warnings()[0]);
}

TEST_P(MemoryLimit, IsAnErrorWithTheNumbersWhereStrict) {
  const auto method = HeatMethod::build(mesh, limited(0.01, true));
  ASSERT_FALSE(method);
  EXPECT_EQ(method.error().code, ErrorCode::kOutOfMemory);
  for (const char* part : {"MB for 2 factors", "the limit is 0.01 MB", "raise memory-limit"}) {
    EXPECT_NE(sentence(method.error()).find(part), std::string::npos) << method.error().message;
  }
}

TEST_P(MemoryLimit, HoldsForFactorsThatAreThereAlready) {
  const auto lower = free.with(limited(free.memory_mb() / 10));
  ASSERT_TRUE(lower) << lower.error().message;
  EXPECT_EQ(lower->options().backend, iterative_backends().front());
  const auto higher = lower->with(with_backend(GetParam()));
  ASSERT_TRUE(higher) << higher.error().message;
  EXPECT_EQ(higher->options().backend, GetParam());
  EXPECT_TRUE(higher->warnings().empty());
}

TEST_P(MemoryLimit, CountsTheFactorThatAnotherBoundaryRuleAdds) {
  // What both factors take while the last is made, and a third would not have.
  double enough = free.memory_mb();
  while (!HeatMethod::build(mesh, limited(enough, true))) enough += free.memory_mb() / 8;
  const HeatMethod method = method_of(mesh, limited(enough, true));
  HeatOptions average = limited(enough, true);
  average.boundary = BoundaryRule::kAverage;
  const auto refused = method.with(average);
  ASSERT_FALSE(refused);
  EXPECT_NE(sentence(refused.error()).find("3 factors"), std::string::npos)
      << refused.error().message;
  average.memory_limit_mb = 0;
  EXPECT_TRUE(method.with(average));
}

TEST_P(MemoryLimit, HoldsForTheFactorThatAQueryMakes) {
  double enough = free.memory_mb();
  while (!HeatMethod::build(mesh, limited(enough, true))) enough += free.memory_mb() / 8;
  std::vector<Index> many(200);
  for (Index v = 0; v < 200; ++v) many[static_cast<std::size_t>(v)] = v;
  const SourceSet sources = SourceSet::of_vertices(many);
  const auto refused = method_of(mesh, limited(enough, true)).solve(sources);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kOutOfMemory);
  EXPECT_NE(sentence(refused.error()).find("3 factors"), std::string::npos)
      << refused.error().message;
  const DistanceResult answer = solve(method_of(mesh, limited(enough)), sources);
  EXPECT_EQ(answer.backend, iterative_backends().front());
}

INSTANTIATE_TEST_SUITE_P(Backends, MemoryLimit, testing::ValuesIn(direct_backends()),
                         backend_test_name);

}  // namespace
}  // namespace geotherm::test
