// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "geotherm/backend.h"
#include "solver/geometry/fem_operator.h"
#include "solver/heat/block_pool.h"

namespace geotherm {

/// An operator on a surface and its factorisation by some backend. Immutable.
class LinearSystem {
 public:
  /// Factorises a A + s L with `held` rows replaced by the identity's.
  static Result<std::shared_ptr<const LinearSystem>> build(
      const Analysis& analysis, std::shared_ptr<const OperatorMesh> mesh, double mass_factor,
      const PerComponent& stiffness_factor, std::vector<Index> held, const FactorOptions& options,
      const PerComponent& consistent_share = 0.0);

  /// The same system and factor; with `refine` each solve is followed by a step of iterative
  /// refinement, x += M^-1 (b - M x), with M x in double (Wilkinson 1963). The residual is small
  /// beside M x row by row, and M^-1, whose entries are the heat that reaches one row from another,
  /// carries it no farther than it carries u: entries far below the largest gain as many digits.
  std::shared_ptr<const LinearSystem> refined(bool refine) const;
  bool refines() const { return refine_; }

  const FemOperator& matrix() const { return *matrix_; }
  const Factorization& factor() const { return *factor_; }

  /// Solves with the held rows at the values that x brings: their influence is moved to the right
  /// side. `support` and `progress` as in Factorization::solve; `support` is ignored when a held
  /// value is not 0.
  Result<SolveReport> solve(Block& x, std::span<const Index> support, const Workspace& work,
                            const Progress& progress = {}) const;

  /// The same with the operator as it stands: held rows are the identity's, and nothing is moved.
  Result<SolveReport> invert(Block& x, std::span<const Index> support, const Workspace& work,
                             const Progress& progress = {}) const;
  /// The same where only rows with a flag in `wanted` (n) are of use.
  Result<SolveReport> invert_where(Block& x, std::span<const Index> support,
                                   std::span<const char> wanted, const Workspace& work,
                                   const Progress& progress = {}) const;

 private:
  LinearSystem() = default;
  std::shared_ptr<const FemOperator> matrix_;
  std::shared_ptr<const Factorization> factor_;
  bool refine_ = false;
};

}  // namespace geotherm
