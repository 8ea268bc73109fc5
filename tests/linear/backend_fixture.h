// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "geotherm/backend.h"
#include "tests/support/compare.h"
#include "tests/support/operators.h"
#include "tests/support/solve.h"

namespace geotherm::test {

/// A backend of this build by its name.
inline const Backend& backend_named(const std::string& name) { return **find_backend(name); }

inline std::span<const double> values(const Block& block) {
  return {block.data(), static_cast<std::size_t>(block.size())};
}

inline Block random_block(Index rows, Index columns, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  return Block::NullaryExpr(rows, columns, [&] { return normal(random); });
}

/// A matrix, factored. Fails the test where that is not possible.
inline std::unique_ptr<Factorization> factored(const Analysis& analysis,
                                               std::shared_ptr<const SymmetricOperator> matrix) {
  auto factor = analysis.factorize(std::move(matrix), {});
  if (!factor) {
    ADD_FAILURE() << factor.error().message;
    return nullptr;
  }
  return std::move(*factor);
}

/// X of M X = B.
inline Block solved(const Factorization& factor, Block b, std::span<const Index> support = {}) {
  const auto report = factor.solve(b, support);
  if (!report) ADD_FAILURE() << report.error().message;
  return b;
}

/// |B - M X| / |B|, Euclidean.
inline double relative_residual(const SymmetricOperator& matrix, const Block& x, const Block& b) {
  Block product(b.rows(), b.cols());
  std::vector<double> column(static_cast<std::size_t>(b.rows())), applied(column.size());
  for (Eigen::Index c = 0; c < b.cols(); ++c) {
    for (Eigen::Index i = 0; i < b.rows(); ++i) column[static_cast<std::size_t>(i)] = x(i, c);
    matrix.apply(column, applied);
    for (Eigen::Index i = 0; i < b.rows(); ++i)
      product(i, c) = applied[static_cast<std::size_t>(i)];
  }
  return (b - product).norm() / b.norm();
}

}  // namespace geotherm::test
