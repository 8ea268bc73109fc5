// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "geotherm/backend.h"
#include "geotherm/error.h"
#include "solver/core/memory.h"
#include "solver/linear/front_kernels.h"

namespace geotherm {

/// The numbers of a factor, front after front, as FrontSolves reads them.
struct FrontFactor {
  FactorStorage storage = FactorStorage::kFull;
  LargeBuffer values;
  /// Largest diagonal entry over its pivot: rounding a number of the factor may change the answer
  /// by so many times as much.
  double cancellation = 1;

  StoredFront front(const FrontTree& tree, Index s) const {
    return {tree.width(s), tree.below(s), values.data() + tree.value_start[s] * bytes_of(storage)};
  }
};

/// What ended a factorisation.
struct FactorFailure {
  Index column = kNoIndex;  ///< its pivot is not positive or not finite
  bool narrow = false;      ///< numbers do not fit into the storage
  bool failed() const { return column != kNoIndex || narrow; }
};

/// Multifrontal Cholesky (Duff, Reid 1983; Liu 1992): each front gathers the entries of its columns
/// and the updates of its children, eliminates its columns with dense kernels and passes the update
/// of what is left on. Subtrees are factorised side by side. The result has the same bits for any
/// number of threads. Precondition: `matrix` has the tree's pattern. Throws std::bad_alloc. Cost:
/// tree.operations.
FactorFailure factorize_fronts(const FrontTree& tree, const LowerMatrix& matrix,
                               FactorStorage storage, int threads, FrontFactor& out,
                               InstructionSet set = best_instruction_set());

/// Bytes that factorize_fronts() holds at most beside the matrix and its result.
std::int64_t front_work_bytes(const FrontTree& tree, int threads);

}  // namespace geotherm
