// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "solver/linear/triangular_factor.h"

namespace geotherm {

/// M = L D L^T stored by sparse columns: L has a unit diagonal, which is not stored.
struct ColumnFactorData {
  std::vector<std::int64_t> start = {0};  ///< n + 1
  std::vector<Index> row;                 ///< ascending in each column, below the diagonal
  std::vector<double> value;
  std::vector<double> inverse_pivot;  ///< n: 1 / D
};

std::unique_ptr<TriangularFactor> make_column_factor(ColumnFactorData data);

}  // namespace geotherm
