// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "solver/geometry/fem_operator.h"
#include "solver/linear/backend.h"

namespace geotherm {

/// An operator on a surface and its factorisation by some backend. Immutable.
class LinearSystem {
 public:
  /// Factorises a A + s L with `held` rows replaced by the identity's.
  static Result<std::shared_ptr<const LinearSystem>> build(
      const Analysis& analysis, std::shared_ptr<const OperatorMesh> mesh, double mass_factor,
      const PerComponent& stiffness_factor, std::vector<Index> held, const FactorOptions& options,
      const PerComponent& consistent_share = 0.0);

  const FemOperator& matrix() const { return *matrix_; }
  const Factorization& factor() const { return *factor_; }

  /// Solves with the held rows at the values that x brings: their influence is moved to the right
  /// side. `support`, `progress` and `threads` as in Factorization::solve; `support` is ignored
  /// when a held value is not 0.
  Result<SolveReport> solve(Block& x, std::span<const Index> support = {},
                            const Progress& progress = {}, int threads = 1) const;

 private:
  LinearSystem() = default;
  std::shared_ptr<const FemOperator> matrix_;
  std::unique_ptr<Factorization> factor_;
};

}  // namespace geotherm
