// SPDX-License-Identifier: MIT
#include "solver/linear/triangular_factor.h"
#include "solver/core/processor.h"

#include <algorithm>
#include <cmath>

#include "solver/linear/solve_kernels.h"

namespace geotherm {
namespace {

class DirectFactorization final : public Factorization {
 public:
  const TriangularFactor& factor() const { return *factor_; }

  explicit DirectFactorization(std::unique_ptr<TriangularFactor> factor)
      : factor_(std::move(factor)) {}

  Result<SolveReport> solve(Block& x, std::span<const Index> support, const Progress& /*progress*/,
                            int threads) const override {
    solve_nodes(x, factor_->tree().path(support), {}, threads);
    return SolveReport{};
  }

  Result<SolveReport> solve_where(Block& x, std::span<const Index> support,
                                  std::span<const char> wanted, const Progress& /*progress*/,
                                  int threads) const override {
    const EliminationTree& tree = factor_->tree();
    solve_nodes(x, tree.path(support), tree.path_of_flags(wanted), threads);
    return SolveReport{};
  }

  Result<Eigen::MatrixXd> inverse_entries(std::span<const Index> rows) const override {
    const std::vector<Index> path = factor_->tree().path(rows);
    const auto count = static_cast<Eigen::Index>(rows.size());
    Eigen::MatrixXd entries(count, count);
    for (Eigen::Index first = 0; first < count;) {
      const int width = column_group(count - first);
      Block x = Block::Zero(factor_->size(), width);
      for (int c = 0; c < width; ++c) x(rows[static_cast<std::size_t>(first + c)], c) = 1;
      factor_->forward(x.data(), width, width, path, 1);
      factor_->backward(x.data(), width, width, path, 1);
      for (Eigen::Index r = 0; r < count; ++r) {
        entries.block(r, first, 1, width) = x.row(rows[static_cast<std::size_t>(r)]);
      }
      first += width;
    }
    return entries;
  }

  FactorStats stats() const override { return factor_->stats(); }
  Index size() const override { return factor_->size(); }

 private:
  /// Forward over one set of nodes, backward over another; all where it is empty.
  void solve_nodes(Block& x, std::span<const Index> up, std::span<const Index> down,
                   int threads) const {
    for (Eigen::Index first = 0; first < x.cols();) {
      const int width = column_group(x.cols() - first);
      factor_->forward(x.data() + first, x.cols(), width, up, threads);
      factor_->backward(x.data() + first, x.cols(), width, down, threads);
      first += width;
    }
  }

  std::unique_ptr<TriangularFactor> factor_;
};

class SupernodalFactor final : public TriangularFactor {
 public:
  SupernodalFactor(std::shared_ptr<const SupernodalStructure> structure, const double* values,
                   std::shared_ptr<const void> owner, std::int64_t operations)
      : structure_(std::move(structure)),
        values_(values),
        owner_(std::move(owner)),
        operations_(operations) {
    inverse_diagonal_.reserve(static_cast<std::size_t>(size()));
    for (Index s = 0; s < structure_->count(); ++s) {
      const Index width = structure_->first[s + 1] - structure_->first[s];
      const std::int64_t height = width + structure_->row_start[s + 1] - structure_->row_start[s];
      const double* diagonal = values_ + structure_->value_start[s];
      for (Index c = 0; c < width; ++c) inverse_diagonal_.push_back(1 / diagonal[c * (height + 1)]);
    }
  }

  const EliminationTree& tree() const override { return structure_->tree; }
  Index size() const override { return structure_->first.back(); }
  FactorStats stats() const override {
    return {structure_->value_start.back(), supernodal_factor_bytes(*structure_), operations_};
  }

  void forward(double* x, Eigen::Index stride, int columns, std::span<const Index> nodes,
               int /*threads*/) const override {
    run_panels(solve_kernels(columns).panel_forward, false, x, stride, columns, nodes);
  }

  void backward(double* x, Eigen::Index stride, int columns, std::span<const Index> nodes,
                int /*threads*/) const override {
    run_panels(solve_kernels(columns).panel_backward, true, x, stride, columns, nodes);
  }

 private:
  void run_panels(decltype(SolveKernels::panel_forward) run, bool backwards, double* x,
                  Eigen::Index stride, int columns, std::span<const Index> nodes) const {
    std::vector<double> scratch(static_cast<std::size_t>(structure_->tallest) * columns +
                                kPanelPadding);
    const Index count = nodes.empty() ? structure_->count() : static_cast<Index>(nodes.size());
    for (Index k = 0; k < count; ++k) {
      const Index at = backwards ? count - 1 - k : k;
      run(panel(nodes.empty() ? at : nodes[at]), x, stride, scratch.data());
    }
  }

  Panel panel(Index s) const {
    const SupernodalStructure& t = *structure_;
    const Index width = t.first[s + 1] - t.first[s];
    const auto under = static_cast<Index>(t.row_start[s + 1] - t.row_start[s]);
    return {t.first[s],
            width,
            width + under,
            t.rows.data() + t.row_start[s],
            values_ + t.value_start[s],
            inverse_diagonal_.data() + t.first[s],
            t.value_start[s + 1] + kPanelPadding <= t.value_start.back()};
  }

  std::shared_ptr<const SupernodalStructure> structure_;
  const double* values_;
  std::vector<double> inverse_diagonal_;
  std::shared_ptr<const void> owner_;
  std::int64_t operations_;
};

/// The last column of the fundamental supernode that begins with `column`. It goes on while a
/// column has exactly one entry more than the next and the next is its parent: then the rest of
/// both patterns is the same (Liu, Ng, Peyton 1993).
template <class Below, class Parent>
Index last_of_supernode(Index column, Index size, const Below& below, const Parent& parent) {
  for (; column + 1 < size; ++column) {
    const std::int64_t count = below(column);
    if (count == 0 || parent(column) != column + 1 || count - 1 != below(column + 1)) break;
  }
  return column;
}

}  // namespace

std::unique_ptr<Factorization> make_direct_factorization(std::unique_ptr<TriangularFactor> factor) {
  return std::make_unique<DirectFactorization>(std::move(factor));
}

const TriangularFactor* triangular_factor_of(const Factorization& factorization) {
  const auto* const direct = dynamic_cast<const DirectFactorization*>(&factorization);
  return direct != nullptr ? &direct->factor() : nullptr;
}

void SupernodalStructure::finish() {
  const Index nodes = count();
  tree.parent.assign(static_cast<std::size_t>(nodes), kNoIndex);
  tree.node_of_row.resize(static_cast<std::size_t>(first.back()));
  for (Index s = 0; s < nodes; ++s) {
    for (Index column = first[s]; column < first[s + 1]; ++column) tree.node_of_row[column] = s;
  }
  for (Index s = 0; s < nodes; ++s) {
    const auto under = static_cast<Index>(row_start[s + 1] - row_start[s]);
    if (under > 0) tree.parent[s] = tree.node_of_row[rows[row_start[s]]];
    tallest = std::max(tallest, first[s + 1] - first[s] + under);
  }
}

std::int64_t supernodal_factor_bytes(const SupernodalStructure& structure) {
  const std::int64_t numbers = structure.value_start.back() + structure.first.back();
  return numbers * static_cast<std::int64_t>(sizeof(double));
}

std::unique_ptr<TriangularFactor> make_supernodal_factor(
    std::shared_ptr<const SupernodalStructure> structure, const double* values,
    std::shared_ptr<const void> owner, std::int64_t operations) {
  return std::make_unique<SupernodalFactor>(std::move(structure), values, std::move(owner),
                                            operations);
}

std::unique_ptr<TriangularFactor> make_column_factor(const ColumnFactorData& data,
                                                     std::int64_t operations) {
  const auto size = static_cast<Index>(data.inverse_pivot.size());
  auto structure = std::make_shared<SupernodalStructure>();
  auto values = std::make_shared<std::vector<double>>();
  const auto below = [&data](Index c) { return data.start[c + 1] - data.start[c]; };
  const auto parent = [&data](Index c) { return data.row[data.start[c]]; };
  for (Index first = 0; first < size;) {
    const Index last = last_of_supernode(first, size, below, parent);
    const Index width = last - first + 1;
    structure->rows.insert(structure->rows.end(), data.row.begin() + data.start[last],
                           data.row.begin() + data.start[last + 1]);
    structure->first.push_back(last + 1);
    structure->row_start.push_back(static_cast<std::int64_t>(structure->rows.size()));
    structure->value_start.push_back(structure->value_start.back() + width * (width + below(last)));
    first = last + 1;
  }
  values->reserve(static_cast<std::size_t>(structure->value_start.back()));
  for (std::size_t s = 0; s + 1 < structure->first.size(); ++s) {
    for (Index column = structure->first[s]; column < structure->first[s + 1]; ++column) {
      // L L^T from L D L^T; the part above the diagonal is never read.
      const double scale = std::sqrt(1 / data.inverse_pivot[column]);
      values->insert(values->end(), static_cast<std::size_t>(column - structure->first[s]), 0.0);
      values->push_back(scale);
      for (std::int64_t e = data.start[column]; e < data.start[column + 1]; ++e) {
        values->push_back(data.value[e] * scale);
      }
    }
  }
  structure->finish();
  const double* numbers = values->data();
  return make_supernodal_factor(std::move(structure), numbers, std::move(values), operations);
}

std::int64_t column_factor_bytes(const ColumnCounts& counts) {
  const auto size = static_cast<Index>(counts.below.size());
  std::int64_t numbers = size;  // the inverse diagonal
  for (Index first = 0; first < size;) {
    const Index last = last_of_supernode(
        first, size, [&counts](Index c) { return std::int64_t{counts.below[c]}; },
        [&counts](Index c) { return counts.parent[c]; });
    const std::int64_t width = last - first + 1;
    numbers += width * (width + counts.below[last]);
    first = last + 1;
  }
  return numbers * static_cast<std::int64_t>(sizeof(double));
}

}  // namespace geotherm
