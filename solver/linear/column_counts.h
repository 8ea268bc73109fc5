// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "solver/linear/symmetric_pattern.h"

namespace geotherm {

/// How large the columns of a Cholesky factor will be.
struct ColumnCounts {
  std::vector<Index> parent;  ///< n: the row of a column's first entry below the diagonal; kNoIndex
  std::vector<Index> below;   ///< n: entries below the diagonal
};

/// Of a matrix with this pattern, eliminated in the order of its numbers. Cost: nearly O(entries of
/// the pattern), whatever the factor's (Gilbert, Ng, Peyton 1994).
ColumnCounts count_columns(const SymmetricPattern& pattern);

}  // namespace geotherm
