// SPDX-License-Identifier: MIT
#include "solver/directions/spread_system.h"

#include <algorithm>
#include <utility>

namespace geotherm {
namespace {

class AddedUp final : public SymmetricOperator {
 public:
  AddedUp(const LowerPattern& lower, std::uint64_t hash)
      : matrix_{lower.start, lower.row, std::vector<double>(lower.row.size(), 0.0)}, hash_(hash) {}

  void add(Index i, Index j, double value) {
    const auto column = std::min(i, j), row = std::max(i, j);
    const auto begin = matrix_.row.begin() + matrix_.start[column];
    const auto end = matrix_.row.begin() + matrix_.start[column + 1];
    matrix_.value[std::lower_bound(begin, end, row) - matrix_.row.begin()] += value;
  }

  void finish() {
    for (Index i = 0; i < size(); ++i) diagonal_.push_back(matrix_.value[matrix_.start[i]]);
  }

  Index size() const override { return matrix_.size(); }
  void apply(std::span<const double> x, std::span<double> y) const override {
    std::ranges::fill(y, 0.0);
    for (Index column = 0; column < size(); ++column) {
      for (auto e = matrix_.start[column]; e < matrix_.start[column + 1]; ++e) {
        const Index row = matrix_.row[e];
        y[row] += matrix_.value[e] * x[column];
        if (row != column) y[column] += matrix_.value[e] * x[row];
      }
    }
  }
  std::span<const double> diagonal() const override { return diagonal_; }
  std::uint64_t pattern() const override { return hash_; }
  const LowerMatrix& assembled() const override { return matrix_; }

 private:
  LowerMatrix matrix_;
  std::uint64_t hash_;
  std::vector<double> diagonal_;
};

}  // namespace

Result<SpreadSystem> SpreadSystem::build(const Backend& backend, SymmetricPattern pattern,
                                         std::span<const Vec3> positions, int threads) {
  SpreadSystem out;
  auto analysis = backend.analyze(pattern, positions, threads);
  if (!analysis) return analysis.error();
  out.analysis_ = *std::move(analysis);
  out.row_ = inverse_permutation(out.analysis_->order(), threads);
  out.lower_ = permuted_lower(pattern, out.analysis_->order(), threads);
  out.hash_ = pattern_hash(out.lower_, threads);
  return out;
}

Result<std::shared_ptr<const Factorization>> SpreadSystem::factorize(const Entries& entries,
                                                                     int threads) const {
  auto matrix = std::make_shared<AddedUp>(lower_, hash_);
  entries([&](Index i, Index j, double value) { matrix->add(row_[i], row_[j], value); });
  matrix->finish();
  FactorOptions options;
  options.threads = threads;
  auto factor = analysis_->factorize(std::move(matrix), options);
  if (!factor) return factor.error();
  return std::shared_ptr<const Factorization>(*std::move(factor));
}

Result<std::vector<double>> SpreadSystem::solve(const Factorization& factor,
                                                std::span<const double> right,
                                                const Progress& progress, int threads) const {
  Block block(size(), 1);
  for (Index i = 0; i < size(); ++i) block(row_[i], 0) = right[i];
  if (auto solved = factor.solve(block, {}, progress, threads); !solved) return solved.error();
  std::vector<double> out(right.size());
  for (Index i = 0; i < size(); ++i) out[i] = block(row_[i], 0);
  return out;
}

}  // namespace geotherm
