// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "solver/linear/column_counts.h"

namespace geotherm {

/// Runs of columns of a Cholesky factor that are kept as one dense panel.
struct Supernodes {
  std::vector<Index> first = {0};  ///< S + 1: first column of each
  std::vector<Index> below;        ///< S: rows under its own
  std::vector<Index> parent;       ///< S: kNoIndex at roots

  Index count() const { return static_cast<Index>(first.size()) - 1; }
  Index width(Index s) const { return first[s + 1] - first[s]; }
};

/// Columns whose patterns are the same but for their own rows, and beyond that narrow children
/// with their parents where that stores few zeros (Ashcraft, Grimes 1989): dense kernels want some
/// columns at a time. Precondition: columns in postorder. Cost: O(n).
Supernodes find_supernodes(const ColumnCounts& counts);

}  // namespace geotherm
