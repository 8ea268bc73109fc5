// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "geotherm/backend.h"
#include "geotherm/domains.h"
#include "solver/core/memory.h"
#include "solver/core/sorting.h"
#include "solver/geometry/domain_operator.h"
#include "solver/geometry/row_ranges.h"
#include "solver/linear/symmetric_pattern.h"

namespace geotherm {

/// The cells at each vertex, ascending.
class CellTable {
 public:
  CellTable() = default;
  /// corners_of(c): the vertices of cell c, below `vertices`.
  template <class CornersOf>
  CellTable(Index vertices, Index cells, int threads, const CornersOf& corners_of) {
    const auto emit = [&](std::size_t c, const auto& put) {
      for (const Index v : corners_of(static_cast<Index>(c))) put(v, static_cast<Index>(c));
    };
    cell_ = counting_sort<Index>(static_cast<std::size_t>(cells),
                                 static_cast<std::size_t>(vertices), threads, emit, start_);
  }
  std::span<const Index> at(Index vertex) const {
    return {cell_.data() + start_[vertex], cell_.data() + start_[vertex + 1]};
  }

 private:
  std::vector<std::uint32_t> start_;
  RawVector<Index> cell_;
};

/// The inverse (Moore, Penrose) of the symmetric product G' G of gradients, along those directions
/// in which it is not 0.
Eigen::Matrix3d inverse_along(const Eigen::Matrix3d& square);

/// The vertices that cells use, and which of them share one: the pattern of every matrix.
struct CellPattern {
  std::vector<Index> vertices;  ///< those in a cell, ascending
  std::vector<Index> local;     ///< V: number among them, or kNoIndex
  SymmetricPattern pattern;
  Components parts;
};
CellPattern pattern_of_cells(const CellComplex& cells, int threads);

/// Mass and stiffness of cells, rows in elimination order.
struct CellMatrix {
  std::vector<double> mass;   ///< n, > 0
  Components components;      ///< of the rows
  std::uint64_t pattern = 0;  ///< the hash of that of the matrices

  /// L, all entries of each row, ascending, but the diagonal's, which is minus their sum.
  std::vector<std::int64_t> row_start;  ///< n + 1
  RawVector<Index> column;
  RawVector<double> entry;
  /// The consistent mass of each pair: measure / (k (k + 1)) from each cell of k corners that has
  /// both, as simplices have it, less on cells much wider than others; empty where all mass is
  /// lumped.
  RawVector<double> shared_mass;

  Index size() const { return static_cast<Index>(mass.size()); }
};

/// y = L x. The same bits with any number of threads.
void apply_stiffness(const CellMatrix& matrix, std::span<const double> x, std::span<double> y,
                     int threads);

/// A CellComplex as the solvers walk it: vertices in elimination order, cells sorted to follow
/// them. Lengths are in units of `unit`, measures relative to their mean: a and s of a A + s L
/// scale alike, so that no answer depends on it.
struct CellMesh : CellMatrix {
  int dimension = 0;
  bool is_of_tets = false;          ///< three dimensions, four corners everywhere
  std::vector<std::int64_t> start;  ///< C + 1
  RawVector<Index> corners;         ///< rows
  RawVector<double> gradients;      ///< D to a corner
  RawVector<double> measures;       ///< C
  RawVector<double> widths;         ///< C
  RawVector<double> shares;         ///< of the measure, to each corner; empty: all are equal
  std::vector<double> mean_width;   ///< of each component's cells
  RawVector<Index> given_cell;      ///< C: number in the CellComplex
  std::vector<RowRange> ranges;     ///< all rows, in order; the same for every thread count
  Index crossing = 0;               ///< cells from here on have corners in several ranges
  CellTable cells_at;               ///< of each row

  Index cell_count() const { return static_cast<Index>(measures.size()); }
  std::span<const Index> corners_of(Index cell) const {
    return {corners.data() + start[cell], corners.data() + start[cell + 1]};
  }
  const double* gradients_of(Index cell) const {
    return gradients.data() + start[cell] * dimension;
  }
};

/// `order`: the elimination order of `pattern`. Cost: the entries of all cells' matrices.
std::shared_ptr<const CellMesh> build_cell_mesh(const CellComplex& cells,
                                                const CellPattern& pattern,
                                                std::span<const Index> order, double unit,
                                                int threads);

/// a A + s L, A the lumped mass but for `consistent_share` of it, where there is a shared mass.
/// Entries of L above 0, which on tets come from obtuse dihedral angles, stay: without them u would
/// be positive everywhere, but L no Laplacian any more, and distances on irregular tets would not
/// converge (measured; docs/domains.md).
class CellOperator final : public DomainOperator {
 public:
  CellOperator(std::shared_ptr<const CellMatrix> mesh, double mass_factor,
               PerComponent stiffness_factor, PerComponent consistent_share,
               std::vector<Index> held, int threads);

  Index size() const override { return mesh_->size(); }
  std::span<const double> diagonal() const override { return diagonal_; }
  Kernel kernel() const override;
  std::uint64_t pattern() const override { return mesh_->pattern; }
  const LowerMatrix& assembled() const override;
  void drop_assembled() const override { assembled_ = {}; }
  void list_row(Index i, std::vector<Index>& columns, std::vector<double>& values) const override;
  std::shared_ptr<const DomainOperator> copy() const override {
    return std::make_shared<const CellOperator>(*this);
  }
  void apply_free(std::span<const double> x, std::span<double> y) const override;
  double product_at(Index i, const std::function<double(Index)>& x) const override;
  void residual(const Block& b, const Block& x, Block& r, int threads) const override;
  void list_neighbors(Index i, std::vector<Index>& rows) const override;
  std::vector<ColumnSet> columns_beside(std::span<const ColumnSet> sets, int threads,
                                        std::vector<Index>& listed) const override;

 private:
  /// The weight of an entry of a row: M is its row sums plus, for each pair, weight times the
  /// squared difference.
  double weight(Index row, std::int64_t entry) const {
    const Index component = mesh_->components.of[row];
    const double stiffness = stiffness_factor_.of(component) * mesh_->entry[entry];
    if (!shares_mass_) return -stiffness;
    return -stiffness - mass_factor_ * consistent_share_.of(component) * mesh_->shared_mass[entry];
  }

  std::shared_ptr<const CellMatrix> mesh_;
  double mass_factor_;
  PerComponent stiffness_factor_, consistent_share_;
  bool shares_mass_;
  int threads_;
  std::vector<double> diagonal_;
  mutable LowerMatrix assembled_;
};

}  // namespace geotherm
