// SPDX-License-Identifier: MIT
#include <algorithm>

#include "solver/core/parallel.h"
#include "solver/core/processor.h"
#include "solver/geometry/cell_mesh.h"

namespace geotherm {
namespace {

/// Minimum rows per thread.
constexpr std::int64_t kCellRowGrain = 1 << 12;

}  // namespace

void apply_stiffness(const CellMatrix& matrix, std::span<const double> x, std::span<double> y,
                     int threads) {
  const double* const entries = matrix.entry.data();
  parallel_each<Index>(threads, matrix.size(), kCellRowGrain, [&](Index i) {
    double sum = 0;
    for (std::int64_t e = matrix.row_start[i]; e < matrix.row_start[i + 1]; ++e) {
      sum += entries[e] * (x[matrix.column[e]] - x[i]);
    }
    y[i] = sum;
  });
}

CellOperator::CellOperator(std::shared_ptr<const CellMatrix> mesh, double mass_factor,
                           PerComponent stiffness_factor, PerComponent consistent_share,
                           std::vector<Index> held, int threads)
    : DomainOperator(mesh->size(), std::move(held)),
      mesh_(std::move(mesh)),
      mass_factor_(mass_factor),
      stiffness_factor_(std::move(stiffness_factor)),
      consistent_share_(std::move(consistent_share)),
      shares_mass_(mass_factor != 0 && !mesh_->shared_mass.empty()),
      threads_(threads) {
  diagonal_.resize(static_cast<std::size_t>(size()));
  parallel_each<Index>(threads, size(), kCellRowGrain, [&](Index i) {
    double sum = 0;
    for (std::int64_t e = mesh_->row_start[i]; e < mesh_->row_start[i + 1]; ++e) {
      sum += weight(i, e);
    }
    diagonal_[i] = mass_factor_ * mesh_->mass[i] + sum;
  });
  for (const Index i : this->held()) diagonal_[i] = 1;
}

Kernel CellOperator::kernel() const {
  if (mass_factor_ != 0 || !held().empty()) return {};
  return {mesh_->components.of, mesh_->components.count};
}

void CellOperator::apply_free(std::span<const double> x, std::span<double> y) const {
  for (Index i = 0; i < size(); ++i) {
    double sum = 0;
    for (std::int64_t e = mesh_->row_start[i]; e < mesh_->row_start[i + 1]; ++e) {
      sum += weight(i, e) * (x[i] - x[mesh_->column[e]]);
    }
    y[i] = mass_factor_ * mesh_->mass[i] * x[i] + sum;
  }
}

double CellOperator::product_at(Index i, const std::function<double(Index)>& x) const {
  const double own = x(i);
  if (is_held(i)) return own;
  double sum = 0;
  for (std::int64_t e = mesh_->row_start[i]; e < mesh_->row_start[i + 1]; ++e) {
    const Index j = mesh_->column[e];
    sum += weight(i, e) * (own - (is_held(j) ? 0.0 : x(j)));
  }
  return mass_factor_ * mesh_->mass[i] * own + sum;
}

void CellOperator::residual(const Block& b, const Block& x, Block& r, int threads) const {
  parallel_for(threads, size(), kCellRowGrain, [&](std::int64_t begin, std::int64_t end) {
    const FlushDenormals flush;
    for (auto i = static_cast<Index>(begin); i < static_cast<Index>(end); ++i) {
      if (is_held(i)) {
        r.row(i) = b.row(i) - x.row(i);
        continue;
      }
      r.row(i) = b.row(i) - mass_factor_ * mesh_->mass[i] * x.row(i);
      for (std::int64_t e = mesh_->row_start[i]; e < mesh_->row_start[i + 1]; ++e) {
        const Index j = mesh_->column[e];
        const double flow = weight(i, e);
        for (Eigen::Index c = 0; c < x.cols(); ++c) {
          r(i, c) -= flow * (x(i, c) - (is_held(j) ? 0.0 : x(j, c)));
        }
      }
    }
  });
}

void CellOperator::list_neighbors(Index i, std::vector<Index>& rows) const {
  rows.push_back(i);
  rows.insert(rows.end(), mesh_->column.begin() + mesh_->row_start[i],
              mesh_->column.begin() + mesh_->row_start[i + 1]);
}

std::vector<ColumnSet> CellOperator::columns_beside(std::span<const ColumnSet> sets, int threads,
                                                    std::vector<Index>& listed) const {
  std::vector<ColumnSet> out(sets.size());
  parallel_each<Index>(threads, size(), kCellRowGrain, [&](Index i) {
    unsigned some = 0;
    for (std::int64_t e = mesh_->row_start[i]; e < mesh_->row_start[i + 1]; ++e) {
      some |= sets[mesh_->column[e]];
    }
    out[i] = static_cast<ColumnSet>(some & ~unsigned{sets[i]});
  });
  for (Index i = 0; i < size(); ++i) {
    if (out[i] != 0) listed.push_back(i);
  }
  return out;
}

void CellOperator::list_row(Index i, std::vector<Index>& columns,
                            std::vector<double>& values) const {
  const std::int64_t begin = mesh_->row_start[i];
  const std::int64_t end = is_held(i) ? begin : mesh_->row_start[i + 1];
  std::size_t at = columns.size();
  columns.resize(at + static_cast<std::size_t>(end - begin) + 1);
  values.resize(columns.size());
  columns[at] = i;
  values[at++] = diagonal_[i];
  for (std::int64_t e = begin; e < end; ++e) {
    const Index j = mesh_->column[e];
    if (is_held(j)) continue;
    columns[at] = j;
    values[at++] = -weight(i, e);
  }
  columns.resize(at);
  values.resize(at);
}

const LowerMatrix& CellOperator::assembled() const {
  if (!assembled_.value.empty()) return assembled_;
  // What stands behind the diagonal of a row are the entries below it of the column.
  const auto behind = [this](Index j) {
    const Index* const end = mesh_->column.data() + mesh_->row_start[j + 1];
    return end - std::upper_bound(mesh_->column.data() + mesh_->row_start[j], end, j);
  };
  assembled_.start.assign(static_cast<std::size_t>(size()) + 1, 0);
  for (Index j = 0; j < size(); ++j) {
    assembled_.start[j + 1] = assembled_.start[j] + 1 + behind(j);
  }
  assembled_.row.resize(static_cast<std::size_t>(assembled_.start.back()));
  assembled_.value.resize(assembled_.row.size());
  parallel_each<Index>(threads_, size(), kCellRowGrain, [&](Index j) {
    std::int64_t at = assembled_.start[j];
    assembled_.row[at] = j;
    assembled_.value[at++] = diagonal_[j];
    for (std::int64_t e = mesh_->row_start[j + 1] - behind(j); e < mesh_->row_start[j + 1]; ++e) {
      const Index i = mesh_->column[e];
      const bool free = !is_held(i) && !is_held(j);
      assembled_.row[at] = i;
      assembled_.value[at++] = free ? -weight(j, e) : 0.0;
    }
  });
  return assembled_;
}

}  // namespace geotherm
