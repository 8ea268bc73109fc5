// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "geotherm/backend.h"
#include "solver/core/processor.h"
#include "solver/linear/multifrontal/front_tree.h"

namespace geotherm {

/// The dense panel of one front while it is factorised: slabs of eight rows, in each the front's
/// own columns, padded to whole slabs, one after the other. First the slabs of the own rows, then
/// those below. Padding is zero.
struct FrontPanel {
  Index width;  ///< own columns
  Index below;  ///< rows below
  double* values;

  std::int64_t slab_size() const { return std::int64_t{kSlab} * padded(width); }
  double* below_values() const { return values + slabs(width) * slab_size(); }
};

/// The dense kernels of the factorisation M = L L^T of a front. They work left-looking by blocks of
/// eight columns and invert each block's diagonal (D = L11^-1), so that solves consist of products
/// alone.
struct FrontKernels {
  /// L of the own rows, in place (the upper part of a diagonal block is of no use), and the inverse
  /// of each diagonal block by rows, 64 doubles each. Returns the first column whose pivot is not
  /// positive and finite, or kNoIndex.
  Index (*factor_own)(const FrontPanel& front, double* inverses);

  /// L of the slabs [begin, end) below, in place.
  void (*factor_below)(const FrontPanel& front, const double* inverses, Index begin, Index end);

  /// Subtracts L L^T of the rows below from slabs [begin, end) of a triangle of slabs.
  void (*update)(const FrontPanel& front, double* triangle, Index begin, Index end);

  /// Writes what solves read, in the order in which they do: for each block of columns D and -L D,
  /// in tiles of eight rows by the block's columns; the last tile has the rows that are left.
  /// Returns false where a number does not fit.
  bool (*store)(const FrontPanel& front, const double* inverses, FactorStorage storage, void* to);
};

/// The kernels for an instruction set; one that this build or processor lacks is replaced by the
/// best lower one.
const FrontKernels& front_kernels(InstructionSet set = best_instruction_set());

/// Bytes of a number.
constexpr std::int64_t bytes_of(FactorStorage storage) {
  return storage == FactorStorage::kFull ? 8 : 4;
}

/// Numbers that may be read after the last one.
inline constexpr std::int64_t kStoredPadding = 16;

/// The stored numbers of one front, as solves read them.
struct StoredFront {
  Index width, below;
  const void* values;
};

/// The two passes over one front, and what joins fronts, for a group of 1, 2, 4, 8 or 16 right
/// sides. `x`: the values at its places, a group each; what stands in the padding is of no use.
struct FrontSolves {
  /// Own places: x := D-blocks of L^-1 x; to the places below what they lose is added, or set where
  /// the front is `fresh`: nothing is there yet.
  void (*forward)(const StoredFront& front, double* x, bool fresh);
  /// Own places: x := L^-T x; the final values below are above[place[i]]. Precondition: the padding
  /// of the own places is 0.
  void (*backward)(const StoredFront& front, double* x, const double* above, const Index* place);
  /// Adds `count` groups of a child's, which lie one after the other, to x[place[i]].
  void (*take)(const double* left, const Index* place, Index count, double* x);
};

const FrontSolves& front_solves(FactorStorage storage, int group,
                                InstructionSet set = best_instruction_set());

}  // namespace geotherm
