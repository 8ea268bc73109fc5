// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "geotherm/backend.h"
#include "geotherm/error.h"
#include "solver/core/memory.h"
#include "solver/linear/multifrontal/front_kernels.h"

namespace geotherm {

/// The numbers of a factor, front after front, as FrontSolves reads them.
struct FrontFactor {
  FactorStorage storage = FactorStorage::kFull;
  LargeBuffer values;
  /// Largest diagonal entry over its pivot: rounding a number of the factor may change the answer
  /// by so many times as much.
  double cancellation = 1;
  /// Per task: the update of its last front. Empty unless kept for changes of some rows.
  std::vector<std::shared_ptr<const double[]>> updates;
  Index factored = 0;  ///< fronts that were factorised for it

  StoredFront front(const FrontTree& tree, Index s) const {
    return {tree.width(s), tree.below(s), values.data() + tree.value_start[s] * bytes_of(storage)};
  }
};

/// Why a factorisation failed, if it did.
struct FactorFailure {
  Index column = kNoIndex;  ///< its pivot is not positive or not finite
  bool narrow = false;      ///< a number is too large for the storage
  bool failed() const { return column != kNoIndex || narrow; }
};

/// A factor of a matrix that differs in some rows.
struct EarlierFronts {
  const FrontTree* tree = nullptr;
  const FrontFactor* factor = nullptr;  ///< null, or one that keeps its updates
  std::span<const char> changed;        ///< n: EarlierFactor::changed
};

/// Flags the tasks whose numbers can be taken over from an earlier factor: no row has changed in
/// them or below them, and their fronts are the same. Empty where none can.
std::vector<char> find_unchanged(const FrontTree& tree, FactorStorage storage,
                                 const EarlierFronts& earlier);

/// What is taken over from an earlier factor.
struct KeptTasks {
  EarlierFronts earlier;
  std::vector<char> unchanged;  ///< find_unchanged()
};

/// Multifrontal Cholesky (Duff, Reid 1983; Liu 1992): each front gathers the entries of its columns
/// and the updates of its children, eliminates its columns with dense kernels and passes the update
/// of what is left on. Subtrees are factorised side by side. The result has the same bits for any
/// number of threads. With `kept` the updates between tasks are kept, and only the tasks that are
/// not unchanged are factorised, of which alone the columns of `matrix` are read; the rest is
/// copied. Precondition: `matrix` has the tree's pattern. Throws std::bad_alloc. Cost:
/// tree.operations.
FactorFailure factorize_fronts(const FrontTree& tree, const LowerMatrix& matrix,
                               const FactorOptions& options, FrontFactor& out,
                               const KeptTasks* kept = nullptr,
                               InstructionSet set = best_instruction_set());

/// Bytes that factorize_fronts() holds at most beside the matrix and its result.
std::int64_t front_work_bytes(const FrontTree& tree, int threads);

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

  /// The same over a few fronts, on this thread, at a cost that does not depend on the size of the
  /// tree.
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
