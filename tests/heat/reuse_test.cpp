// SPDX-License-Identifier: MIT
// with(), solve_each() and threads change what is computed when, not what comes out.
#include <gtest/gtest.h>

#include <algorithm>
#include <thread>
#include <tuple>

#include "tests/support/mesh_zoo.h"
#include "tests/support/solve.h"

namespace geotherm::test {
namespace {

// A block takes other kernels than a single column.
constexpr double kBlock = 1e-12;

struct Change {
  const char* name;
  void (*set)(HeatOptions&);
  bool analyses_again;
};

const Change kChanges[] = {
    {"time", [](HeatOptions& o) { o.time_step.factor = 3; }, false},
    {"pin",
     [](HeatOptions& o) {
       o.constraint = {ConstraintMode::kPinVertex, 17, 10};
     },
     false},
    {"penalty", [](HeatOptions& o) { o.constraint.mode = ConstraintMode::kPenalty; }, false},
    {"heat", [](HeatOptions& o) { o.heat = HeatMode::kHold; }, false},
    {"dirichlet", [](HeatOptions& o) { o.boundary = BoundaryRule::kDirichlet; }, false},
    {"average", [](HeatOptions& o) { o.boundary = BoundaryRule::kAverage; }, false},
    {"variant", [](HeatOptions& o) { o.variant = Variant::kClassic; }, false},
    {"refined", [](HeatOptions& o) { o.precision = Precision::kRefined; }, false},
    {"full", [](HeatOptions& o) { o.precision = Precision::kFull; }, false},
    {"backend", [](HeatOptions& o) { o.backend = backend_names().back(); }, true},
    {"laplacian", [](HeatOptions& o) { o.laplacian = LaplacianKind::kCotan; }, true},
};

void PrintTo(const Change& c, std::ostream* out) { *out << c.name; }

class Reuse : public testing::TestWithParam<Change> {
 protected:
  MeshPtr mesh = finish(jittered_plane(24, 0.35, 4));
  SourceSet sources = SourceSet::of_vertices({100, 333});
  HeatMethod method = method_of(mesh);

  HeatOptions changed() const {
    HeatOptions options = method.options();
    GetParam().set(options);
    return options;
  }
};

TEST_P(Reuse, GivesWhatAFreshBuildGives) {
  const auto other = method.with(changed());
  ASSERT_TRUE(other) << other.error().message;
  const HeatMethod fresh = method_of(mesh, changed());
  EXPECT_EQ(solve(*other, sources).distances, solve(fresh, sources).distances);
  EXPECT_EQ(other->t(), fresh.t());
  EXPECT_EQ(other->options(), fresh.options());
}

TEST_P(Reuse, AnalysesAgainOnlyWhereThePatternMayChange) {
  const auto other = method.with(changed());
  ASSERT_TRUE(other);
  EXPECT_EQ(other->timing().analyze > 0, GetParam().analyses_again);
}

TEST_P(Reuse, LeavesTheOriginalAsItWas) {
  const auto before = solve(method, sources).distances;
  ASSERT_TRUE(method.with(changed()));
  EXPECT_EQ(solve(method, sources).distances, before);
}

TEST_P(Reuse, ComesBackToTheOriginal) {
  const auto other = method.with(changed());
  ASSERT_TRUE(other);
  const auto back = other->with(method.options());
  ASSERT_TRUE(back);
  EXPECT_EQ(solve(*back, sources).distances, solve(method, sources).distances);
}

INSTANTIATE_TEST_SUITE_P(Changes, Reuse, testing::ValuesIn(kChanges),
                         [](const auto& each) { return each.param.name; });

class Blocks : public testing::TestWithParam<std::string> {
 protected:
  bool iterative = std::ranges::count(iterative_backends(), GetParam()) > 0;
  // Large enough for every way to factor; iterations would only take longer.
  MeshPtr mesh = finish(iterative ? torus(24, 12, 0.4) : torus(70, 40, 0.4));
  /// More sets than are solved at once, of one to three sources.
  std::vector<SourceSet> sets() const {
    std::vector<SourceSet> out;
    for (Index k = 0; k < 19; ++k) {
      std::vector<Index> vertices;
      for (Index j = 0; j <= k % 3; ++j)
        vertices.push_back((k * 131 + j * 977) % mesh->vertex_count());
      out.push_back(SourceSet::of_vertices(vertices));
    }
    return out;
  }
};

TEST_P(Blocks, EqualSeparateSolves) {
  const HeatMethod method = method_of(mesh, with_backend(GetParam()));
  const auto all = sets();
  const auto together = method.solve_each(all);
  ASSERT_TRUE(together) << together.error().message;
  ASSERT_EQ(together->size(), all.size());
  for (std::size_t k = 0; k < all.size(); ++k) {
    EXPECT_LE(relative_difference((*together)[k].distances, solve(method, all[k]).distances),
              kBlock)
        << "set " << k;
  }
}

TEST_P(Blocks, AreTheSameForAnyNumberOfThreads) {
  HeatOptions one = with_backend(GetParam()), two = one, four = one;
  one.threads = 1;
  two.threads = 2;
  four.threads = 4;
  const auto all = sets();
  const auto a = method_of(mesh, one).solve_each(all), b = method_of(mesh, two).solve_each(all),
             c = method_of(mesh, four).solve_each(all);
  ASSERT_TRUE(a && b && c);
  for (std::size_t k = 0; k < all.size(); ++k) {
    EXPECT_EQ((*a)[k].distances, (*b)[k].distances) << "set " << k;
    // From four on, a BLAS of several threads may sum in another order.
    EXPECT_LE(relative_difference((*c)[k].distances, (*a)[k].distances), kBlock) << "set " << k;
  }
}

TEST_P(Blocks, ConcurrentQueriesGiveTheSameBits) {
  const HeatMethod method = method_of(mesh, with_backend(GetParam()));
  const auto all = sets();
  const auto alone = solve(method, all[2]).distances;
  std::vector<std::vector<double>> answers(3);
  {
    std::vector<std::jthread> threads;
    threads.reserve(answers.size());
    for (auto& answer : answers) {
      threads.emplace_back([&] {
        auto result = method.solve(all[2]);
        if (result) answer = std::move(result->distances);
      });
    }
  }
  for (const auto& answer : answers) EXPECT_EQ(answer, alone);
}

TEST_P(Blocks, CanBeCancelled) {
  const HeatMethod method = method_of(mesh, with_backend(GetParam()));
  int calls = 0;
  const auto stopped = method.solve_each(sets(), {}, [&calls](std::string_view, double) {
    return ++calls < 2;  // after the first block
  });
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, ErrorCode::kCancelled);
  const auto never = HeatMethod::build(mesh, {}, [](std::string_view, double) { return false; });
  ASSERT_FALSE(never);
  EXPECT_EQ(never.error().code, ErrorCode::kCancelled);
}

INSTANTIATE_TEST_SUITE_P(Backends, Blocks, testing::ValuesIn(backend_names()), backend_test_name);

}  // namespace
}  // namespace geotherm::test
