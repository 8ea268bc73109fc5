// SPDX-License-Identifier: MIT
#include "geotherm/backend.h"

#include <algorithm>

namespace geotherm {

Result<Eigen::MatrixXd> Factorization::inverse_entries(std::span<const Index> rows) const {
  constexpr Eigen::Index kColumnsAtOnce = 16;
  const auto count = static_cast<Eigen::Index>(rows.size());
  Eigen::MatrixXd entries(count, count);
  for (Eigen::Index first = 0; first < count; first += kColumnsAtOnce) {
    const Eigen::Index columns = std::min(kColumnsAtOnce, count - first);
    Block x = Block::Zero(size(), columns);
    for (Eigen::Index c = 0; c < columns; ++c) x(rows[first + c], c) = 1;
    const auto solved =
        solve(x, rows.subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(columns)));
    if (!solved) return solved.error();
    for (Eigen::Index r = 0; r < count; ++r) {
      entries.block(r, first, 1, columns) = x.row(rows[static_cast<std::size_t>(r)]);
    }
  }
  return entries;
}

Result<void> check_pattern(const SymmetricOperator& matrix, std::uint64_t analysed, Index size) {
  if (matrix.pattern() == analysed) return {};
  return Error{ErrorCode::kBadInput,
               "the matrix of size " + std::to_string(matrix.size()) +
                   " does not have the pattern that was analysed (size " + std::to_string(size) +
                   ")",
               {"analyse its own pattern first"}};
}

}  // namespace geotherm
