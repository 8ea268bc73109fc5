// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "geotherm/backend.h"
#include "solver/linear/elimination_tree.h"

namespace geotherm {

/// A Cholesky factor in elimination order, M = L L^T or L D L^T, with the two triangular passes
/// over some or all of its nodes. What a direct backend hands back once it, or the library behind
/// it, has computed the numbers.
class TriangularFactor {
 public:
  virtual ~TriangularFactor() = default;

  virtual const EliminationTree& tree() const = 0;
  virtual Index size() const = 0;
  virtual FactorStats stats() const = 0;

  /// x := L^-1 x and x := (D) L^-T x for `columns` vectors (1, 2, 4, 8 or 16) whose row i starts
  /// at x + i * stride. `nodes`: the nodes to visit, ascending (backward goes through them from
  /// the end); empty means all. `threads` may be used; the answer has the same bits with any.
  virtual void forward(double* x, Eigen::Index stride, int columns, std::span<const Index> nodes,
                       int threads) const = 0;
  virtual void backward(double* x, Eigen::Index stride, int columns, std::span<const Index> nodes,
                        int threads) const = 0;
};

/// A Factorization over a triangular factor: sparse right sides walk only their path forward,
/// blocks are cut into groups of 16, 8, 4, 2 and 1 columns that each stream the factor once.
std::unique_ptr<Factorization> make_direct_factorization(std::unique_ptr<TriangularFactor> factor);

}  // namespace geotherm
