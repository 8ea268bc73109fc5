// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "solver/linear/matrix_rows.h"

namespace geotherm {

/// Conjugate gradients on the rows around a right side that is zero but for a few of them. Answers
/// of a heat step fall by e over each diffusion length, so that what lies further away than the
/// tolerance reaches is not looked at: the work is that of the window, whatever the size of the
/// matrix.
class WindowSolver {
 public:
  /// Makes the solver of one matrix. Keeps a reference to its rows.
  WindowSolver(const SymmetricOperator& matrix, const MatrixRows& rows);

  /// Column `column` of M x = b in place, where b is zero but for `support`: rows out of the window
  /// become 0. The window grows until what is left beyond it, and within, is below `tolerance` of b
  /// in the norm of the diagonal's inverse. Gives the iterations of the last window; 0: it would be
  /// most of the matrix, or more than `budget` are needed, and x is as before.
  int solve(Block& x, Eigen::Index column, std::span<const Index> support, double tolerance,
            int budget) const;

 private:
  const MatrixRows& rows_;
  Index size_;
  double length_ = 1;  ///< diffusion length in edges, about
};

}  // namespace geotherm
