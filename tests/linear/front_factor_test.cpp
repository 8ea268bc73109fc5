// SPDX-License-Identifier: MIT
// The numbers of a multifrontal factor, and what solving with them gives.
#include "solver/linear/multifrontal/front_factor.h"

#include <gtest/gtest.h>

#include <cstring>
#include <numeric>

#include "tests/linear/front_fixture.h"

namespace geotherm::test {
namespace {

constexpr InstructionSet kSets[] = {InstructionSet::kPlain, InstructionSet::kAvx2,
                                    InstructionSet::kAvx512};
constexpr FactorStorage kStorages[] = {FactorStorage::kFull, FactorStorage::kSingle,
                                       FactorStorage::kWideExponent};

// The heat step's matrix has a condition number of about 10.
constexpr double kFrontRoundOff = 1e-13;

/// What rounding each number of the factor to 53, 24 or 21 bits does to an answer, 4 times over.
double tolerance(FactorStorage storage) {
  constexpr double kBits[] = {kFrontRoundOff, 4 * 0x1p-24, 4 * 0x1p-21};
  return kBits[static_cast<int>(storage)];
}

std::vector<double> product(const SymmetricOperator& matrix, const std::vector<double>& x) {
  std::vector<double> out(x.size());
  matrix.apply(x, out);
  return out;
}

TEST(FrontFactor, GivesBackWhatWasMultiplied) {
  const Fronts fronts(many_tasks());
  const std::vector<double> x = random_numbers(fronts.tree.size(), 1);
  const std::vector<double> b = product(*fronts.heat(), x);
  for (const FactorStorage storage : kStorages) {
    const FrontFactor factor = fronts.factor(storage);
    EXPECT_LE(relative_difference(fronts.solve(factor, b), x), tolerance(storage));
  }
}

TEST(FrontFactor, NarrowNumbersAreThere) {
  // Else the test above would not see a factor that is kept in doubles after all.
  const Fronts fronts(many_tasks());
  const std::vector<double> x = random_numbers(fronts.tree.size(), 1);
  const std::vector<double> b = product(*fronts.heat(), x);
  for (const FactorStorage storage : {FactorStorage::kSingle, FactorStorage::kWideExponent}) {
    const FrontFactor factor = fronts.factor(storage);
    EXPECT_GE(relative_difference(fronts.solve(factor, b), x), 1e-9);
    EXPECT_LT(static_cast<std::int64_t>(factor.values.size()),
              fronts.tree.value_start.back() * 4 + 4096);
  }
}

TEST(FrontFactor, EveryInstructionSetGivesTheSameAnswer) {
  const Fronts fronts(many_tasks());
  for (const int group : {1, 2, 4, 8, 16}) {
    const std::vector<double> b = random_numbers(fronts.tree.size() * group, 2);
    const std::vector<double> expected =
        fronts.solve(fronts.factor(FactorStorage::kFull, 1, kSets[0]), b, group, 1, kSets[0]);
    for (const InstructionSet set : kSets) {
      const FrontFactor factor = fronts.factor(FactorStorage::kFull, 1, set);
      EXPECT_LE(relative_difference(fronts.solve(factor, b, group, 1, set), expected),
                kFrontRoundOff)
          << group << " right sides, set " << static_cast<int>(set);
    }
  }
}

TEST(FrontFactor, NarrowAnswersDifferBetweenInstructionSetsByLittle) {
  const Fronts fronts(many_tasks());
  const std::vector<double> b = random_numbers(fronts.tree.size(), 3);
  for (const FactorStorage storage : {FactorStorage::kSingle, FactorStorage::kWideExponent}) {
    const FrontFactor plain = fronts.factor(storage, 1, kSets[0]);
    const std::vector<double> expected = fronts.solve(plain, b, 1, 1, kSets[0]);
    for (const InstructionSet set : kSets) {
      // The same factor in another order of sums; then a factor that was computed in another order,
      // of which a few numbers in a million round to their other neighbour.
      EXPECT_LE(relative_difference(fronts.solve(plain, b, 1, 1, set), expected), kFrontRoundOff);
      const FrontFactor own = fronts.factor(storage, 1, set);
      EXPECT_LE(relative_difference(fronts.solve(own, b, 1, 1, set), expected), 1e-9);
    }
  }
}

TEST(FrontFactor, HasTheSameBitsForAnyNumberOfThreads) {
  const Fronts fronts(many_tasks());
  ASSERT_GT(fronts.tree.tasks.size(), 20U);
  for (const FactorStorage storage : kStorages) {
    const FrontFactor one = fronts.factor(storage, 1);
    const auto bytes = static_cast<std::size_t>(fronts.tree.value_start.back() * bytes_of(storage));
    for (const int threads : kSanitized ? std::vector{3} : std::vector{2, 3, 7}) {
      const FrontFactor more = fronts.factor(storage, threads);
      EXPECT_EQ(std::memcmp(one.values.data(), more.values.data(), bytes), 0);
      for (const int group : {1, 8}) {
        const std::vector<double> b = random_numbers(fronts.tree.size() * group, 4);
        EXPECT_EQ(fronts.solve(one, b, group, threads), fronts.solve(one, b, group, 1));
      }
    }
  }
}

TEST(FrontFactor, WalksAPathLikeTheWhole) {
  const Fronts fronts(many_tasks());
  const FrontFactor factor = fronts.factor(FactorStorage::kWideExponent);
  const std::vector<Index> rows = {3, fronts.tree.size() / 2, fronts.tree.size() - 1};
  const std::vector<Index> path = fronts.tree.tree.path(rows);
  ASSERT_LT(path.size(), static_cast<std::size_t>(fronts.tree.count()) / 4);
  for (const int group : {1, 4}) {
    std::vector<double> whole(static_cast<std::size_t>(fronts.tree.size()) * group, 0.0);
    for (const Index row : rows) {
      for (int k = 0; k < group; ++k) whole[row * group + k] = row + k + 1;
    }
    std::vector<double> along = whole, by_tasks = whole;
    const FrontPasses passes(fronts.tree, factor, group);
    passes.forward(whole.data(), group, 1);
    passes.forward_along(path, along.data(), group);
    passes.forward(by_tasks.data(), group, 3, path);
    EXPECT_EQ(along, whole);  // zeros that were added change no bit
    EXPECT_EQ(by_tasks, whole);
    passes.backward(whole.data(), group, 1);
    passes.backward_along(path, along.data(), group);
    passes.backward(by_tasks.data(), group, 3, path);
    EXPECT_EQ(by_tasks, along);  // and what is not on the path stays as it was
    for (const Index front : path) {
      for (Index row = fronts.tree.nodes.first[front]; row < fronts.tree.nodes.first[front + 1];
           ++row) {
        for (int k = 0; k < group; ++k) {
          EXPECT_EQ(along[row * group + k], whole[row * group + k]);
        }
      }
    }
  }
}

TEST(FrontFactor, NamesTheColumnThatIsNotPositive) {
  const Fronts fronts(torus(40, 30, 0.4));
  LowerMatrix matrix = fronts.heat()->assembled();
  for (const Index column : {Index{0}, matrix.size() / 3, matrix.size() - 1}) {
    for (const double bad : {-1.0, 0.0, std::numeric_limits<double>::quiet_NaN()}) {
      LowerMatrix broken = matrix;
      broken.value[broken.start[column]] = bad;
      FrontFactor out;
      const FactorFailure failure =
          factorize_fronts(fronts.tree, broken, {2, FactorStorage::kFull}, out);
      EXPECT_EQ(failure.column, column);
    }
  }
}

TEST(FrontFactor, SaysWhenNumbersDoNotFit) {
  const Fronts fronts(torus(40, 30, 0.4));
  LowerMatrix matrix = fronts.heat()->assembled();
  for (double& value : matrix.value) value *= 1e-80;  // D is 1e40: beyond what a float holds
  FrontFactor out;
  EXPECT_TRUE(factorize_fronts(fronts.tree, matrix, {1, FactorStorage::kSingle}, out).narrow);
  EXPECT_FALSE(
      factorize_fronts(fronts.tree, matrix, {1, FactorStorage::kWideExponent}, out).failed());
}

TEST(FrontFactor, MeasuresCancellation) {
  const Fronts fronts(torus(40, 30, 0.4));
  EXPECT_LT(fronts.factor(FactorStorage::kSingle).cancellation, 10);
  LowerMatrix weak = fronts.heat()->assembled();
  std::vector<double> rows(static_cast<std::size_t>(weak.size()), 0.0);
  for (Index j = 0; j < weak.size(); ++j) {
    for (std::int64_t e = weak.start[j] + 1; e < weak.start[j + 1]; ++e) {
      rows[j] -= weak.value[e];
      rows[weak.row[e]] -= weak.value[e];
    }
  }
  // A Laplacian with next to no mass: the last pivot is the mass of all.
  for (Index j = 0; j < weak.size(); ++j) weak.value[weak.start[j]] = rows[j] * (1 + 1e-9);
  FrontFactor out;
  EXPECT_FALSE(factorize_fronts(fronts.tree, weak, {1, FactorStorage::kFull}, out).failed());
  EXPECT_GT(out.cancellation, 1e4);
}

}  // namespace
}  // namespace geotherm::test
