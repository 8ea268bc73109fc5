// SPDX-License-Identifier: MIT
#include "solver/linear/matrix_rows.h"

#include <numeric>

namespace geotherm {

FullRows full_rows(const LowerMatrix& lower) {
  const Index n = lower.size();
  FullRows rows;
  rows.start.assign(static_cast<std::size_t>(n) + 1, 0);
  const auto for_each = [&](auto&& take) {
    for (Index j = 0; j < n; ++j) {
      for (std::int64_t e = lower.start[j]; e < lower.start[j + 1]; ++e) {
        const Index i = lower.row[static_cast<std::size_t>(e)];
        const double value = lower.value[static_cast<std::size_t>(e)];
        if (i != j && value == 0) continue;
        take(i, j, value);
        if (i != j) take(j, i, value);
      }
    }
  };
  for_each([&](Index i, Index, double) { ++rows.start[i + 1]; });
  std::partial_sum(rows.start.begin(), rows.start.end(), rows.start.begin());
  rows.column.resize(static_cast<std::size_t>(rows.start.back()));
  rows.value.resize(rows.column.size());
  std::vector<int> next(rows.start.begin(), rows.start.end() - 1);
  // Columns ascend: those below the diagonal come in the order of j, and then the others.
  for_each([&](Index i, Index j, double value) {
    const int at = next[i]++;
    rows.column[at] = j;
    rows.value[at] = value;
  });
  return rows;
}

}  // namespace geotherm
