// SPDX-License-Identifier: MIT
#pragma once

#include <cholmod.h>

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace geotherm::bench {

/// A symmetric positive definite matrix, factored by CHOLMOD the way that geometry libraries call
/// it (Eigen's CholmodSimplicialLDLT, geometry-central's PositiveDefiniteSolver): an analysis of
/// its own with CHOLMOD's default search for an ordering, a simplicial factorisation, and
/// cholmod_solve, which allocates its answer and workspace, for each right side.
class PlainCholmod {
 public:
  PlainCholmod();
  ~PlainCholmod();
  PlainCholmod(const PlainCholmod&) = delete;
  PlainCholmod& operator=(const PlainCholmod&) = delete;

  /// False when the matrix is not positive definite or memory ends.
  bool factorize(Eigen::SparseMatrix<double>& matrix);

  /// An empty vector when it fails.
  Eigen::VectorXd solve(Eigen::VectorXd& b);

  /// What the factor holds, unused capacity not counted.
  double bytes() const;

 private:
  cholmod_common common_{};
  cholmod_factor* factor_ = nullptr;
};

}  // namespace geotherm::bench
