// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "geotherm/backend.h"

namespace geotherm {

/// All entries of a symmetric matrix, row by row, columns ascending.
struct FullRows {
  std::vector<int> start, column;
  std::vector<double> value;

  Index size() const { return static_cast<Index>(start.size()) - 1; }
};

/// Zeros beside the diagonal are left out.
FullRows full_rows(const LowerMatrix& lower);

/// What an operator can be, too: one that knows each row by itself, so that nobody who needs some
/// of them has to keep them all.
class MatrixRows {
 public:
  virtual ~MatrixRows() = default;

  /// Appends the columns and entries of row i, the diagonal's first, each column once; zeros beside
  /// it may be left out. May be called from several threads.
  virtual void list_row(Index i, std::vector<Index>& columns,
                        std::vector<double>& values) const = 0;

  /// Frees what SymmetricOperator::assembled() has built. Not to be called from several threads at
  /// once.
  virtual void drop_assembled() const = 0;
};

}  // namespace geotherm
