// SPDX-License-Identifier: MIT
#include <Eigen/OrderingMethods>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <limits>
#include <numeric>
#include <string>

#include "solver/core/text.h"
#include "solver/linear/backend_registry.h"
#include "solver/linear/multifrontal/fill_order.h"
#include "solver/linear/triangular_factor.h"

namespace geotherm {
namespace {

constexpr const char* kEigenName = "eigen-ldlt";

using Matrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;
using Ldlt = Eigen::SimplicialLDLT<Matrix, Eigen::Lower, Eigen::NaturalOrdering<int>>;

/// Eigen's LDL^T with its analysis kept apart from its numbers. The matrix arrives in elimination
/// order, so that Eigen is asked for the natural one and most of its analysis falls away.
class EigenAnalysis final : public Analysis {
 public:
  EigenAnalysis(std::vector<Index> order, const SymmetricPattern& pattern)
      : order_(std::move(order)), pattern_(pattern_hash(pattern)) {
    const ColumnCounts counts = count_columns(pattern);
    const auto below = std::accumulate(counts.below.begin(), counts.below.end(), std::int64_t{0});
    const std::int64_t lower = pattern.size() + std::ssize(pattern.neighbor) / 2;
    entries_ = std::max(lower, below);
    for (const std::int64_t entries : counts.below) operations_ += (entries + 1) * (entries + 1);
    factor_bytes_ = column_factor_bytes(counts);
    // Matrix and factor, each with Eigen's copy.
    work_bytes_ = kEntryBytes * (2 * lower + 2 * below);
  }

  std::span<const Index> order() const override { return order_; }
  std::int64_t factor_bytes(FactorStorage /*storage*/) const override { return factor_bytes_; }
  std::int64_t work_bytes() const override { return work_bytes_; }

  Result<std::unique_ptr<Factorization>> factorize(
      std::shared_ptr<const SymmetricOperator> matrix,
      const FactorOptions& /*options*/) const override {
    if (const auto same = check_pattern(*matrix, pattern_, static_cast<Index>(order_.size()));
        !same) {
      return same.error();
    }
    if (constexpr std::int64_t kMax = std::numeric_limits<int>::max(); entries_ > kMax) {
      return Error{ErrorCode::kOutOfMemory,
                   "needs a factor of " + std::to_string(entries_) + " entries, at most " +
                       std::to_string(kMax) + " can be counted",
                   {"try ", SettingHint{"backend", {"cg"}}},
                   kEigenName};
    }
    const LowerMatrix& lower = matrix->assembled();
    const std::vector<int> start(lower.start.begin(), lower.start.end());
    const Eigen::Map<const Matrix> view(lower.size(), lower.size(),
                                        static_cast<Eigen::Index>(lower.row.size()), start.data(),
                                        lower.row.data(), lower.value.data());
    Ldlt ldlt;
    try {
      ldlt.compute(view);
    } catch (const std::bad_alloc&) {
      return Error{ErrorCode::kOutOfMemory,
                   "ran out of memory on a matrix of size " + std::to_string(matrix->size()),
                   {"try ", SettingHint{"backend", {"cg"}}},
                   kEigenName};
    }
    const auto pivots = ldlt.vectorD();
    for (Index j = 0; j < lower.size(); ++j) {
      if (ldlt.info() == Eigen::Success && pivots[j] > 0) continue;
      return Error{ErrorCode::kNumericalFailure,
                   "the matrix is not positive definite (pivot " + rounded_text(pivots[j]) +
                       " in column " + std::to_string(j) + " of " + std::to_string(lower.size()) +
                       ")",
                   {"try another backend"},
                   kEigenName};
    }
    const Matrix& factor = ldlt.matrixL().nestedExpression();
    ColumnFactorData data;
    data.start.assign(factor.outerIndexPtr(), factor.outerIndexPtr() + lower.size() + 1);
    data.row.assign(factor.innerIndexPtr(), factor.innerIndexPtr() + data.start.back());
    data.value.assign(factor.valuePtr(), factor.valuePtr() + data.start.back());
    data.inverse_pivot.resize(static_cast<std::size_t>(lower.size()));
    for (Index j = 0; j < lower.size(); ++j) data.inverse_pivot[j] = 1 / pivots[j];
    return make_direct_factorization(make_column_factor(data, operations_));
  }

 private:
  static constexpr std::int64_t kEntryBytes = sizeof(double) + sizeof(int);

  std::vector<Index> order_;
  std::uint64_t pattern_;
  std::int64_t entries_ = 0, operations_ = 0, factor_bytes_ = 0, work_bytes_ = 0;
};

class EigenBackend final : public Backend {
 public:
  std::string_view name() const override { return kEigenName; }
  std::string_view description() const override { return "sparse LDL^T of Eigen, simplicial"; }

  Result<std::shared_ptr<const Analysis>> analyze(const SymmetricPattern& pattern,
                                                  std::span<const Vec3> positions,
                                                  int threads) const override {
    std::vector<Index> order = fill_reducing_order(pattern, positions, threads);
    const SymmetricPattern eliminated = permuted(pattern, order);
    return std::shared_ptr<const Analysis>(
        std::make_shared<EigenAnalysis>(std::move(order), eliminated));
  }
};

}  // namespace

const Backend* eigen_ldlt_backend() {
  static const EigenBackend kBackend;
  return &kBackend;
}

}  // namespace geotherm
