// SPDX-License-Identifier: MIT
#include "tests/heat/faulty_backend.h"

#include <cmath>
#include <utility>

#include "tests/support/solve.h"

namespace geotherm::test {
namespace {

struct Plan {
  Fault fault;
  Error error;
  const Backend* inner;
};

class FaultyFactorization final : public Factorization {
 public:
  FaultyFactorization(const Plan& plan, std::unique_ptr<Factorization> inner)
      : plan_(plan), inner_(std::move(inner)) {}
  Result<SolveReport> solve(Block& x, std::span<const Index> support, const Progress& progress,
                            int threads) const override {
    if (plan_.fault == Fault::kSolve) return plan_.error;
    auto done = inner_->solve(x, support, progress, threads);
    if (plan_.fault != Fault::kNoise) return done;
    constexpr double kNoise = 1e-7;
    const double largest = x.cwiseAbs().maxCoeff();
    for (Eigen::Index i = 0; i < x.rows(); ++i) {
      x.row(i).array() += kNoise * largest * std::sin(12.9898 * static_cast<double>(i + 1));
    }
    return done;
  }
  FactorStats stats() const override { return inner_->stats(); }
  Index size() const override { return inner_->size(); }

 private:
  const Plan& plan_;
  std::unique_ptr<Factorization> inner_;
};

class FaultyAnalysis final : public Analysis {
 public:
  FaultyAnalysis(const Plan& plan, std::shared_ptr<const Analysis> inner)
      : plan_(plan), inner_(std::move(inner)) {}
  std::span<const Index> order() const override { return inner_->order(); }
  Result<std::unique_ptr<Factorization>> factorize(std::shared_ptr<const SymmetricOperator> matrix,
                                                   const FactorOptions& options) const override {
    if (plan_.fault == Fault::kFactor) return plan_.error;
    auto made = inner_->factorize(std::move(matrix), options);
    if (!made) return made;
    return std::unique_ptr<Factorization>(
        std::make_unique<FaultyFactorization>(plan_, *std::move(made)));
  }

 private:
  const Plan& plan_;
  std::shared_ptr<const Analysis> inner_;
};

class FaultyBackend final : public Backend {
 public:
  explicit FaultyBackend(Plan plan) : plan_(std::move(plan)) {}
  std::string_view name() const override { return "faulty"; }
  std::string_view description() const override { return "fails where it is told to"; }
  Result<std::shared_ptr<const Analysis>> analyze(const SymmetricPattern& pattern,
                                                  std::span<const Vec3> positions,
                                                  int threads) const override {
    if (plan_.fault == Fault::kAnalysis) return plan_.error;
    auto made = plan_.inner->analyze(pattern, positions, threads);
    if (!made) return made;
    return std::shared_ptr<const Analysis>(
        std::make_shared<FaultyAnalysis>(plan_, *std::move(made)));
  }

 private:
  Plan plan_;
};

}  // namespace

std::unique_ptr<const Backend> faulty_backend(Fault fault, Error error) {
  const Backend* inner = *find_backend(direct_backends().back());
  return std::make_unique<FaultyBackend>(Plan{fault, std::move(error), inner});
}

}  // namespace geotherm::test
