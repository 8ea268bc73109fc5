// SPDX-License-Identifier: MIT
#include "solver/linear/column_counts.h"

namespace geotherm {

ColumnCounts count_columns(const SymmetricPattern& pattern) {
  const auto size = static_cast<std::size_t>(pattern.size());
  ColumnCounts out{std::vector<Index>(size, kNoIndex), std::vector<Index>(size, 0)};
  std::vector<Index> last_row(size, kNoIndex);  // that was found to have an entry in the column
  for (Index row = 0; row < pattern.size(); ++row) {
    last_row[row] = row;
    for (const Index neighbor : pattern.neighbors(row)) {
      if (neighbor > row) break;
      for (Index column = neighbor; last_row[column] != row; column = out.parent[column]) {
        if (out.parent[column] == kNoIndex) out.parent[column] = row;
        ++out.below[column];
        last_row[column] = row;
      }
    }
  }
  return out;
}

}  // namespace geotherm
