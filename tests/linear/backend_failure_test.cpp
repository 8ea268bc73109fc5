// SPDX-License-Identifier: MIT
// Matrices that no Cholesky factor exists for, names that no backend has, and who may assemble.
#include <gtest/gtest.h>

#include <cctype>
#include <set>

#include "tests/linear/backend_fixture.h"
#include "tests/linear/counting_operator.h"
#include "tests/support/mesh_zoo.h"

namespace geotherm::test {
namespace {

// An iterative backend stops at 1e-13, relative to the preconditioned right side.
constexpr double kSmallResidual = 1e-11;

/// Factorises and solves; the error of whichever fails.
Result<Block> attempt(const Analysis& analysis, std::shared_ptr<const SymmetricOperator> matrix,
                      Block b) {
  auto factor = analysis.factorize(std::move(matrix), {});
  if (!factor) return factor.error();
  const auto report = (*factor)->solve(b);
  if (!report) return report.error();
  return b;
}

class BackendFailures : public testing::TestWithParam<std::string> {
 protected:
  const Backend& backend = backend_named(GetParam());
  Analysed surface = analysed(*finish(torus(24, 12, 0.4)), backend);
  Block b = random_block(surface.operators->size(), 1, 1);

  void expect_not_definite(std::shared_ptr<const SymmetricOperator> matrix) const {
    const auto answer = attempt(*surface.analysis, std::move(matrix), b);
    ASSERT_FALSE(answer) << "solved a matrix that is not positive definite";
    EXPECT_EQ(answer.error().code, ErrorCode::kNumericalFailure);
    const std::string message = sentence(answer.error());
    EXPECT_TRUE(std::ranges::any_of(message, [](unsigned char c) { return std::isdigit(c); }))
        << message;
    EXPECT_EQ(answer.error().subject, backend.name());
  }
};

TEST_P(BackendFailures, IndefiniteMatrixIsANumericalFailure) {
  // The constants have negative energy, oscillating vectors positive.
  expect_not_definite(std::make_shared<FemOperator>(surface.operators, -0.1, 1));
}

TEST_P(BackendFailures, NegativeDefiniteMatrixIsANumericalFailure) {
  expect_not_definite(std::make_shared<FemOperator>(surface.operators, -1, -1));
}

TEST_P(BackendFailures, NegativeMassesAloneAreANumericalFailure) {
  expect_not_definite(std::make_shared<FemOperator>(surface.operators, -1, 0));
}

TEST_P(BackendFailures, ConstantsAreProjectedOutOrHeld) {
  const auto laplacian = std::make_shared<FemOperator>(surface.operators, 0, 1);
  b.array() -= b.mean();
  const auto answer = attempt(*surface.analysis, laplacian, b);
  if (backend.iterative()) {
    ASSERT_TRUE(answer) << answer.error().message;
    EXPECT_LE(relative_residual(*laplacian, *answer, b), kSmallResidual);
    return;
  }
  // Without a held row a direct backend may find a last pivot of round-off; whatever it answers
  // solves the system.
  if (answer) {
    EXPECT_LE(relative_residual(*laplacian, *answer, b), 1e-6);
  } else {
    EXPECT_EQ(answer.error().code, ErrorCode::kNumericalFailure);
  }
}

TEST_P(BackendFailures, MatrixFreeBackendsNeverAssemble) {
  const auto counted =
      std::make_shared<CountingOperator>(std::make_shared<FemOperator>(surface.operators, 1, 1));
  ASSERT_TRUE(attempt(*surface.analysis, counted, b));
  EXPECT_EQ(counted->assemblies > 0, !backend.iterative());
  EXPECT_EQ(counted->applied > 0, backend.iterative());
}

/// I plus what turns pairs of entries by a right angle: not symmetric, so that conjugate gradients
/// never come to an end.
class TurningOperator final : public SymmetricOperator {
 public:
  explicit TurningOperator(const SymmetricOperator& like)
      : ones_(static_cast<std::size_t>(like.size()), 1.0), pattern_(like.pattern()) {}

  Index size() const override { return static_cast<Index>(ones_.size()); }
  void apply(std::span<const double> x, std::span<double> y) const override {
    std::ranges::copy(x, y.begin());
    for (std::size_t i = 0; i + 1 < x.size(); i += 2) {
      y[i] -= x[i + 1];
      y[i + 1] += x[i];
    }
  }
  std::span<const double> diagonal() const override { return ones_; }
  std::uint64_t pattern() const override { return pattern_; }
  const LowerMatrix& assembled() const override { return none_; }

 private:
  std::vector<double> ones_;
  std::uint64_t pattern_;
  LowerMatrix none_;
};

TEST(ConjugateGradients, ThatDoNotEndNameTheBackendOfEveryBuild) {
  const Analysed surface = analysed(*finish(torus(24, 12, 0.4)), backend_named("cg"));
  const auto matrix = std::make_shared<TurningOperator>(FemOperator(surface.operators, 1, 1));
  const auto answer = attempt(*surface.analysis, matrix, random_block(matrix->size(), 1, 1));
  ASSERT_FALSE(answer);
  EXPECT_EQ(answer.error().code, ErrorCode::kBudgetEnded);
  EXPECT_NE(sentence(answer.error()).find("try backend native"), std::string::npos)
      << sentence(answer.error());
}

INSTANTIATE_TEST_SUITE_P(Backends, BackendFailures, testing::ValuesIn(backend_names()),
                         backend_test_name);

TEST(BackendRegistry, KnowsEveryNameItLists) {
  std::set<std::string> seen;
  for (const std::string& name : backend_names()) {
    const auto backend = find_backend(name);
    ASSERT_TRUE(backend) << name;
    EXPECT_EQ((*backend)->name(), name);
    EXPECT_FALSE((*backend)->description().empty());
    EXPECT_TRUE(seen.insert(name).second);
  }
}

TEST(BackendRegistry, AnswersAnUnknownNameWithTheNamesThereAre) {
  const auto backend = find_backend("pardiso");
  ASSERT_FALSE(backend);
  EXPECT_EQ(backend.error().code, ErrorCode::kNotAvailable);
  EXPECT_NE(sentence(backend.error()).find("pardiso"), std::string::npos);
  for (const std::string& name : backend_names()) {
    EXPECT_NE(sentence(backend.error()).find(name), std::string::npos) << name;
  }
}

}  // namespace
}  // namespace geotherm::test
