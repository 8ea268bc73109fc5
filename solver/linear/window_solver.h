// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "geotherm/backend.h"

namespace geotherm {

/// All entries of a symmetric matrix, row by row, columns ascending.
struct FullRows {
  std::vector<int> start, column;
  std::vector<double> value;

  Index size() const { return static_cast<Index>(start.size()) - 1; }
};

/// Zeros beside the diagonal are left out.
FullRows full_rows(const LowerMatrix& lower);

/// Conjugate gradients on the rows around a right side that is zero but for a few of them. Answers
/// of a heat step fall by e over each diffusion length, so that what lies further away than the
/// tolerance reaches is not looked at: the work is that of the window, whatever the size of the
/// matrix.
class WindowSolver {
 public:
  explicit WindowSolver(const LowerMatrix& lower);

  /// Column `column` of M x = b in place, where b is zero but for `support`: rows out of the window
  /// become 0. The window grows until what is left beyond it, and within, is below `tolerance` of b
  /// in the norm of the diagonal's inverse. Gives the iterations of the last window; 0: it would be
  /// most of the matrix, or more than `budget` are needed, and x is as before.
  int solve(Block& x, Eigen::Index column, std::span<const Index> support, double tolerance,
            int budget) const;

 private:
  FullRows rows_;
  double length_ = 1;  ///< diffusion length in edges, about
};

}  // namespace geotherm
