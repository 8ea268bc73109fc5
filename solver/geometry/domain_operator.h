// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "geotherm/backend.h"
#include "geotherm/types.h"
#include "solver/linear/matrix_rows.h"

namespace geotherm {

/// A number for each component of a domain, or one for all of them.
class PerComponent {
 public:
  PerComponent(double all) : values_{all} {}  // NOLINT: a number is one for all
  /// Precondition: not empty. Numbers that are all the same become one.
  explicit PerComponent(std::vector<double> values) : values_(std::move(values)) {
    if (std::ranges::adjacent_find(values_, std::not_equal_to{}) == values_.end()) {
      values_.resize(1);
    }
  }

  double of(Index component) const {
    return values_.size() == 1 ? values_[0] : values_[static_cast<std::size_t>(component)];
  }
  /// f of each.
  template <class F>
  PerComponent map(const F& f) const {
    std::vector<double> out;
    for (const double value : values_) out.push_back(f(value));
    return PerComponent(std::move(out));
  }
  bool same() const { return values_.size() == 1; }
  double least() const { return std::ranges::min(values_); }
  double most() const { return std::ranges::max(values_); }

  bool operator==(const PerComponent&) const = default;

 private:
  std::vector<double> values_;
};

/// Some of the columns of a block, at most 16: a bit each.
using ColumnSet = std::uint16_t;

/// M = a A + s L on a domain: A a mass (rows sum to the lumped masses), L a stiffness (positive
/// semidefinite, rows sum to 0). Rows and columns of held vertices are those of the identity, which
/// keeps M symmetric and its pattern unchanged: the caller moves known values to the right side.
/// Immutable but for assembled().
class DomainOperator : public SymmetricOperator, public MatrixRows {
 public:
  std::span<const Index> held() const { return held_; }
  bool is_held(Index i) const { return !is_held_.empty() && is_held_[i] != 0; }

  /// One that assembles a matrix of its own. Precondition: assembled() was not called.
  virtual std::shared_ptr<const DomainOperator> copy() const = 0;

  /// y = M x.
  void apply(std::span<const double> x, std::span<double> y) const final;

  /// y = M x as if no row were held: what moves known values to the right.
  virtual void apply_free(std::span<const double> x, std::span<double> y) const = 0;

  /// (M x)_i alone, x as a function of the row. Cost: the cells at i.
  virtual double product_at(Index i, const std::function<double(Index)>& x) const = 0;

  /// r = b - M x, columns side by side. The same bits with any number of threads.
  virtual void residual(const Block& b, const Block& x, Block& r, int threads) const = 0;

  /// Appends the rows that share a cell with row i, i among them, some more than once.
  virtual void list_neighbors(Index i, std::vector<Index>& rows) const = 0;

  /// For each row, the columns that it lacks in `sets` and that a row which shares a cell with it
  /// has there. `listed` gets the rows with any, in any order.
  virtual std::vector<ColumnSet> columns_beside(std::span<const ColumnSet> sets, int threads,
                                                std::vector<Index>& listed) const = 0;

 protected:
  /// `held`: rows in any order; empty for none.
  DomainOperator(Index size, std::vector<Index> held);

 private:
  std::vector<Index> held_;
  std::vector<char> is_held_;  ///< n, or empty when nothing is held
};

}  // namespace geotherm
