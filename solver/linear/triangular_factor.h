// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "geotherm/backend.h"
#include "solver/linear/elimination_tree.h"

namespace geotherm {

/// A Cholesky factor in elimination order, M = L L^T or L D L^T, with the two triangular passes
/// over some or all of its nodes. A direct backend makes one once it, or the library behind it, has
/// computed the numbers.
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

/// A Factorization that solves with a triangular factor. Sparse right sides visit only their path
/// on the way forward; blocks are cut into groups of 16, 8, 4, 2 and 1 columns, each of which reads
/// the factor once.
std::unique_ptr<Factorization> make_direct_factorization(std::unique_ptr<TriangularFactor> factor);

/// The factor of such a one; null for others.
const TriangularFactor* triangular_factor_of(const Factorization& factorization);

/// The columns and rows of each supernode, shared by all factors of a pattern.
struct SupernodalStructure {
  std::vector<Index> first = {0};               ///< S + 1: first column of each supernode
  std::vector<std::int64_t> row_start = {0};    ///< S + 1, into `rows`
  std::vector<Index> rows;                      ///< rows below each supernode's own
  std::vector<std::int64_t> value_start = {0};  ///< S + 1, into a factor's values
  EliminationTree tree;
  Index tallest = 0;  ///< rows of the tallest supernode, its own included

  Index count() const { return static_cast<Index>(first.size()) - 1; }
  /// Fills `tree` and `tallest` from the other members.
  void finish();
};

/// FactorStats::bytes of every factor of this structure.
std::int64_t supernodal_factor_bytes(const SupernodalStructure& structure);

/// M = L L^T stored as dense panels. `owner` keeps `values` alive; `operations` as in FactorStats.
std::unique_ptr<TriangularFactor> make_supernodal_factor(
    std::shared_ptr<const SupernodalStructure> structure, const double* values,
    std::shared_ptr<const void> owner, std::int64_t operations);

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
std::unique_ptr<TriangularFactor> make_column_factor(const ColumnFactorData& data,
                                                     std::int64_t operations);

/// FactorStats::bytes of such a factor with these columns. Cost: O(n).
std::int64_t column_factor_bytes(const ColumnCounts& counts);

}  // namespace geotherm
