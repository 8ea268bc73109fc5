// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <utility>

#include "solver/linear/triangular_factor.h"

namespace geotherm {

/// A factor that also says what its numbers cost: for backends whose library counts operations, or
/// that know them from the analysis. Everything else is the other factor's.
class CountedFactor final : public TriangularFactor {
 public:
  /// `operations` as in FactorStats.
  CountedFactor(std::unique_ptr<TriangularFactor> factor, std::int64_t operations)
      : factor_(std::move(factor)), operations_(operations) {}

  const EliminationTree& tree() const override { return factor_->tree(); }
  Index size() const override { return factor_->size(); }
  FactorStats stats() const override {
    FactorStats stats = factor_->stats();
    stats.operations = operations_;
    return stats;
  }
  void forward(double* x, Eigen::Index stride, int columns, std::span<const Index> nodes,
               int threads) const override {
    factor_->forward(x, stride, columns, nodes, threads);
  }
  void backward(double* x, Eigen::Index stride, int columns, std::span<const Index> nodes,
                int threads) const override {
    factor_->backward(x, stride, columns, nodes, threads);
  }

 private:
  std::unique_ptr<TriangularFactor> factor_;
  std::int64_t operations_;
};

}  // namespace geotherm
