// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/core/types.h"

namespace geotherm {

/// The lower triangle of a symmetric matrix by columns; the diagonal is the first entry of each.
struct LowerMatrix {
  std::vector<std::int64_t> start;  ///< n + 1
  std::vector<Index> row;           ///< ascending in each column
  std::vector<double> value;

  Index size() const { return static_cast<Index>(start.size()) - 1; }
};

/// Constant vectors that an operator maps to zero: one for each listed component.
struct Kernel {
  std::span<const Index> component;  ///< component of every row; empty when there is no kernel
  Index count = 0;

  bool empty() const { return count == 0; }
};

/// A real symmetric positive (semi)definite operator of size n, in elimination numbering (row k
/// belongs to the k-th eliminated vertex of the Analysis it is given to).
class SymmetricOperator {
 public:
  virtual ~SymmetricOperator() = default;

  virtual Index size() const = 0;

  /// y = M x, without forming M. Sizes n. May be called from several threads.
  virtual void apply(std::span<const double> x, std::span<double> y) const = 0;

  /// The n diagonal entries, > 0.
  virtual std::span<const double> diagonal() const = 0;

  /// Empty when the operator is definite.
  virtual Kernel kernel() const { return {}; }

  /// Hash of the pattern (pattern_hash of the permuted graph).
  virtual std::uint64_t pattern() const = 0;

  /// M as a matrix, built on the first call. Matrix-free backends never call it. Not to be called
  /// from several threads at once.
  virtual const LowerMatrix& assembled() const = 0;
};

}  // namespace geotherm
