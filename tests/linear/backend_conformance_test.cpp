// SPDX-License-Identifier: MIT
// What every backend must do, on meshes small and large enough for each of its ways to factor.
#include <gtest/gtest.h>

#include <thread>
#include <tuple>

#include "tests/linear/backend_fixture.h"
#include "tests/support/mesh_zoo.h"

namespace geotherm::test {
namespace {

// The heat step's matrix has a condition number of about 10, an iterative backend stops at 1e-13.
constexpr double kResidual = 1e-11;
// Direct backends against themselves in another order of operations.
constexpr double kBackendRoundOff = 1e-12;

struct ConformanceMesh {
  const char* name;
  Draft (*draft)();
};
const ConformanceMesh kSmall = {"small", [] { return jittered_plane(24, 0.3, 1); }};
const ConformanceMesh kParts = {"two_components", [] {
                                  Draft draft = sphere(2);
                                  append(draft, torus(20, 10, 0.4));
                                  return draft;
                                }};
// Ordered by dissection, and dense enough for supernodes.
const ConformanceMesh kDissected = {"dissected", [] { return torus(80, 50, 0.4); }};

void PrintTo(const ConformanceMesh& mesh, std::ostream* out) { *out << mesh.name; }

using Case = std::tuple<std::string, ConformanceMesh>;

class Conformance : public testing::TestWithParam<Case> {
 protected:
  const Backend& backend = backend_named(std::get<0>(GetParam()));
  Analysed surface = analysed(*finish(std::get<1>(GetParam()).draft()), backend);
  Index n = surface.operators->size();

  std::shared_ptr<const FemOperator> heat(double t = 1, std::vector<Index> held = {}) const {
    return std::make_shared<FemOperator>(surface.operators, 1, t, std::move(held));
  }
  std::vector<Index> some_rows(Index count) const {
    std::vector<Index> rows(static_cast<std::size_t>(count));
    for (Index k = 0; k < count; ++k) rows[k] = (k * 7919 + 13) % n;
    return rows;
  }
};

TEST_P(Conformance, OrderIsAPermutation) {
  std::vector<Index> order(surface.analysis->order().begin(), surface.analysis->order().end());
  std::sort(order.begin(), order.end());
  std::vector<Index> expected(order.size());
  std::iota(expected.begin(), expected.end(), 0);
  EXPECT_EQ(order, expected);
}

TEST_P(Conformance, SolvesToASmallResidual) {
  const auto matrix = heat();
  const Block b = random_block(n, 3, 1);
  EXPECT_LE(relative_residual(*matrix, solved(*factored(*surface.analysis, matrix), b), b),
            kResidual);
}

TEST_P(Conformance, SolvesWithHeldRows) {
  const auto matrix = heat(1, some_rows(9));
  const Block b = random_block(n, 2, 2);
  const Block x = solved(*factored(*surface.analysis, matrix), b);
  EXPECT_LE(relative_residual(*matrix, x, b), kResidual);
  for (const Index i : matrix->held()) {
    EXPECT_NEAR(x(i, 0), b(i, 0), kResidual * b.norm());
  }
}

TEST_P(Conformance, SolvesForSomeRowsAlone) {
  const auto matrix = heat();
  const auto factor = factored(*surface.analysis, matrix);
  const std::vector<Index> support = some_rows(3), rows = some_rows(5);
  std::vector<char> wanted(static_cast<std::size_t>(n), 0);
  for (const Index row : rows) wanted[row] = 1;
  for (const Index columns : {1, 3}) {
    Block b = Block::Zero(n, columns);
    for (const Index row : support) b.row(row).setConstant(row + 1);
    const Block expected = solved(*factor, b);
    ASSERT_TRUE(factor->solve_where(b, support, wanted, {}, 2));
    for (const Index row : rows) {
      for (Index c = 0; c < columns; ++c) {
        EXPECT_NEAR(b(row, c), expected(row, c), kBackendRoundOff * expected.norm());
      }
    }
  }
}

TEST_P(Conformance, OneAnalysisServesSeveralMatrices) {
  const auto first = heat(1), second = heat(25);
  const auto factor1 = factored(*surface.analysis, first);
  const auto factor2 = factored(*surface.analysis, second);
  const Block b = random_block(n, 1, 3);
  EXPECT_LE(relative_residual(*first, solved(*factor1, b), b), kResidual);
  EXPECT_LE(relative_residual(*second, solved(*factor2, b), b), kResidual);
}

TEST_P(Conformance, SparseSupportGivesTheAnswerOfADenseRightSide) {
  const auto factor = factored(*surface.analysis, heat());
  const std::vector<Index> support = some_rows(5);
  Block b = Block::Zero(n, 3);
  const Block random = random_block(5, 3, 4);
  for (Index k = 0; k < 5; ++k) b.row(support[k]) = random.row(k);
  EXPECT_LE(relative_difference(values(solved(*factor, b, support)), values(solved(*factor, b))),
            kBackendRoundOff);
}

TEST_P(Conformance, InverseEntriesAreThoseOfTheInverse) {
  const auto factor = factored(*surface.analysis, heat());
  const std::vector<Index> rows = some_rows(19);
  const auto entries = factor->inverse_entries(rows);
  ASSERT_TRUE(entries) << entries.error().message;
  Block unit = Block::Zero(n, 19);
  for (Index k = 0; k < 19; ++k) unit(rows[k], k) = 1;
  const Block inverse = solved(*factor, unit);
  Eigen::MatrixXd expected(19, 19);
  for (Index k = 0; k < 19; ++k) expected.row(k) = inverse.row(rows[k]);
  EXPECT_LE(relative_difference(test::values(*entries), test::values(expected)), kBackendRoundOff);
}

TEST_P(Conformance, ReportsItsCost) {
  const auto factor = factored(*surface.analysis, heat());
  EXPECT_EQ(factor->size(), n);
  EXPECT_EQ(factor->stats().nonzeros > 0, !backend.iterative());
  EXPECT_GE(factor->stats().bytes,
            factor->stats().nonzeros * static_cast<std::int64_t>(sizeof(double)));
  Block b = random_block(n, 1, 5);
  const auto report = factor->solve(b);
  ASSERT_TRUE(report);
  EXPECT_EQ(report->iterations > 0, backend.iterative());
}

TEST_P(Conformance, StopsWhenToldToIfItIterates) {
  const auto factor = factored(*surface.analysis, heat());
  Block b = random_block(n, 2, 6);
  int calls = 0;
  const auto stopped = factor->solve(b, {}, [&calls](std::string_view, double share) {
    EXPECT_GE(share, 0);
    EXPECT_LE(share, 1);
    return ++calls < 2;  // in the second column at the latest
  });
  if (backend.iterative()) {
    ASSERT_FALSE(stopped);
    EXPECT_EQ(stopped.error().code, ErrorCode::kCancelled);
    EXPECT_EQ(calls, 2);
  }
  const Block again = random_block(n, 2, 6);
  EXPECT_LE(relative_residual(*heat(), solved(*factor, again), again), kResidual);
}

TEST_P(Conformance, AnotherPatternIsBadInput) {
  const Analysed other = analysed(*finish(sphere(1)), backend);
  const auto matrix = std::make_shared<FemOperator>(other.operators, 1, 1);
  const auto factor = surface.analysis->factorize(matrix, {});
  ASSERT_FALSE(factor);
  EXPECT_EQ(factor.error().code, ErrorCode::kBadInput);
  EXPECT_NE(sentence(factor.error()).find(std::to_string(n)), std::string::npos);
}

TEST_P(Conformance, ConcurrentSolvesGiveTheSameBits) {
  const auto factor = factored(*surface.analysis, heat());
  const Block b = random_block(n, 5, 6);
  const Block alone = solved(*factor, b);
  std::vector<Block> answers(4, b);
  {
    std::vector<std::jthread> threads;
    threads.reserve(answers.size());
    for (Block& answer : answers) {
      threads.emplace_back([&factor, &answer] {
        if (!factor->solve(answer)) answer.setZero();
      });
    }
  }
  for (const Block& answer : answers) {
    EXPECT_TRUE(std::ranges::equal(values(answer), values(alone)));
  }
}

TEST_P(Conformance, ConcurrentFactorisationsOfOneAnalysisAgree) {
  const Block b = random_block(n, 1, 7);
  std::vector<Block> answers(3, b);
  {
    std::vector<std::jthread> threads;
    threads.reserve(answers.size());
    for (Block& answer : answers) {
      threads.emplace_back([this, &answer] {
        const auto factor = surface.analysis->factorize(heat(), {});
        if (!factor || !(*factor)->solve(answer)) answer.setZero();
      });
    }
  }
  for (const Block& answer : answers) {
    EXPECT_LE(relative_difference(values(answer), values(answers[0])), kBackendRoundOff);
    EXPECT_GT(answer.norm(), 0);
  }
}

std::string conformance_name(const testing::TestParamInfo<Case>& info) {
  return test_name(std::get<0>(info.param)) + "_" + std::get<1>(info.param).name;
}
INSTANTIATE_TEST_SUITE_P(Backends, Conformance,
                         testing::Combine(testing::ValuesIn(backend_names()),
                                          testing::Values(kSmall, kParts, kDissected)),
                         conformance_name);

class ConformanceOfWidths : public Conformance {};

TEST_P(ConformanceOfWidths, ABlockIsSolvedLikeItsColumns) {
  const auto factor = factored(*surface.analysis, heat());
  constexpr Index kWidest = 20;  // beyond the widest group of 16
  // A right side with equal columns would hide a column that is mixed up with another.
  const Block b = random_block(n, kWidest, 8);
  Block singly(n, kWidest);
  for (Index c = 0; c < kWidest; ++c) singly.col(c) = solved(*factor, b.col(c));
  for (Index width = 2; width <= kWidest; ++width) {
    const Block first = singly.leftCols(width);
    EXPECT_LE(relative_difference(values(solved(*factor, b.leftCols(width))), values(first)),
              kBackendRoundOff)
        << width << " columns";
  }
}

INSTANTIATE_TEST_SUITE_P(Backends, ConformanceOfWidths,
                         testing::Combine(testing::ValuesIn(backend_names()),
                                          testing::Values(kSmall)),
                         conformance_name);
INSTANTIATE_TEST_SUITE_P(BackendsSlow, ConformanceOfWidths,
                         testing::Combine(testing::ValuesIn(backend_names()),
                                          testing::Values(kDissected)),
                         conformance_name);

}  // namespace
}  // namespace geotherm::test
