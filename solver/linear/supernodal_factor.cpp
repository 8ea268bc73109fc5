// SPDX-License-Identifier: MIT
#include "solver/linear/supernodal_factor.h"

#include <algorithm>

#include "solver/linear/solve_kernels.h"

namespace geotherm {

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

namespace {

class SupernodalFactor final : public TriangularFactor {
 public:
  SupernodalFactor(std::shared_ptr<const SupernodalStructure> structure, const double* values,
                   std::shared_ptr<const void> owner)
      : structure_(std::move(structure)), values_(values), owner_(std::move(owner)) {
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
    return {structure_->value_start.back(), supernodal_factor_bytes(*structure_)};
  }

  void forward(double* x, Eigen::Index stride, int columns, std::span<const Index> nodes,
               int /*threads*/) const override {
    const auto run = solve_kernels(columns).panel_forward;
    std::vector<double> scratch(static_cast<std::size_t>(structure_->tallest) * columns +
                                kPanelPadding);
    if (nodes.empty()) {
      for (Index s = 0; s < structure_->count(); ++s) run(panel(s), x, stride, scratch.data());
    } else {
      for (const Index s : nodes) run(panel(s), x, stride, scratch.data());
    }
  }

  void backward(double* x, Eigen::Index stride, int columns, std::span<const Index> nodes,
                int /*threads*/) const override {
    const auto run = solve_kernels(columns).panel_backward;
    std::vector<double> scratch(static_cast<std::size_t>(structure_->tallest) * columns +
                                kPanelPadding);
    if (nodes.empty()) {
      for (Index s = structure_->count(); s-- > 0;) run(panel(s), x, stride, scratch.data());
    } else {
      for (auto s = nodes.rbegin(); s != nodes.rend(); ++s) {
        run(panel(*s), x, stride, scratch.data());
      }
    }
  }

 private:
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
};

}  // namespace

std::unique_ptr<TriangularFactor> make_supernodal_factor(
    std::shared_ptr<const SupernodalStructure> structure, const double* values,
    std::shared_ptr<const void> owner) {
  return std::make_unique<SupernodalFactor>(std::move(structure), values, std::move(owner));
}

}  // namespace geotherm
