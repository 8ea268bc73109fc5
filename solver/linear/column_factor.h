// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "solver/linear/column_counts.h"
#include "solver/linear/triangular_factor.h"

namespace geotherm {

/// M = L D L^T by sparse columns, as simplicial codes give it: L has a unit diagonal, which is not
/// stored.
struct ColumnFactorData {
  std::vector<std::int64_t> start = {0};  ///< n + 1
  std::vector<Index> row;                 ///< ascending in each column, below the diagonal
  std::vector<double> value;
  std::vector<double> inverse_pivot;  ///< n: 1 / D, > 0
};

/// Gathers columns of equal structure into panels, so that every factor is solved with by the same
/// kernels: no zeros are added, and row numbers are stored once a panel. Precondition: the complete
/// pattern of a Cholesky factor. Cost: one copy.
std::unique_ptr<TriangularFactor> make_column_factor(const ColumnFactorData& data);

/// FactorStats::bytes of such a factor with these columns. Cost: O(n).
std::int64_t column_factor_bytes(const ColumnCounts& counts);

}  // namespace geotherm
