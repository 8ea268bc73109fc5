// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "solver/linear/front_factor.h"

namespace geotherm {

/// Triangular solves with a factor made of fronts, for `group` (1, 2, 4, 8 or 16) right sides whose
/// row i starts at x + i * stride. Each front works on a small vector of its own rows; what
/// children leave is added in a fixed order, so that the result has the same bits for any number of
/// threads. Cost: the factor is read once a pass. Throws std::bad_alloc.
class FrontPasses {
 public:
  FrontPasses(const FrontTree& tree, const FrontFactor& factor, int group,
              InstructionSet set = best_instruction_set());

  /// x := L^-1 x and x := L^-T x, L with its diagonal blocks taken out as D (front_kernels.h).
  /// `fronts`: those to visit, with all above them, ascending; empty means all. Forward gives what
  /// the whole pass gives where x is 0 in all others; backward what it gives on these.
  void forward(double* x, Eigen::Index stride, int threads,
               std::span<const Index> fronts = {}) const;
  void backward(double* x, Eigen::Index stride, int threads,
                std::span<const Index> fronts = {}) const;

  /// The same over a few fronts by this thread, which looks at nothing else.
  void forward_along(std::span<const Index> fronts, double* x, Eigen::Index stride) const;
  void backward_along(std::span<const Index> fronts, double* x, Eigen::Index stride) const;

 private:
  class Steps;
  class Visits;
  class Upwards;
  class Downwards;
  const FrontTree& tree_;
  const FrontFactor& factor_;
  int group_;
  const FrontSolves& solves_;
};

}  // namespace geotherm
