// SPDX-License-Identifier: MIT
#include "solver/linear/column_factor.h"

#include <numeric>

#include "solver/linear/solve_kernels.h"

namespace geotherm {
namespace {

class ColumnFactor final : public TriangularFactor {
 public:
  explicit ColumnFactor(ColumnFactorData data) : data_(std::move(data)) {
    tree_.node_of_row.resize(static_cast<std::size_t>(size()));
    std::iota(tree_.node_of_row.begin(), tree_.node_of_row.end(), 0);
    tree_.parent.resize(static_cast<std::size_t>(size()));
    for (Index j = 0; j < size(); ++j) {
      const bool root = data_.start[j] == data_.start[j + 1];
      tree_.parent[j] = root ? kNoIndex : data_.row[data_.start[j]];
    }
  }

  const EliminationTree& tree() const override { return tree_; }
  Index size() const override { return static_cast<Index>(data_.inverse_pivot.size()); }
  FactorStats stats() const override {
    const auto entries = static_cast<std::int64_t>(data_.value.size());
    return {entries + size(),
            entries * static_cast<std::int64_t>(sizeof(double) + sizeof(Index)) +
                size() * static_cast<std::int64_t>(sizeof(double) + sizeof(std::int64_t))};
  }

  void forward(double* x, Eigen::Index stride, int columns,
               std::span<const Index> nodes) const override {
    const auto run = solve_kernels(columns).column_forward;
    if (nodes.empty()) {
      for (Index j = 0; j < size(); ++j) run(column(j), x, stride);
    } else {
      for (const Index j : nodes) run(column(j), x, stride);
    }
  }

  void backward(double* x, Eigen::Index stride, int columns,
                std::span<const Index> nodes) const override {
    const auto run = solve_kernels(columns).column_backward;
    if (nodes.empty()) {
      for (Index j = size(); j-- > 0;) run(column(j), x, stride);
    } else {
      for (auto j = nodes.rbegin(); j != nodes.rend(); ++j) run(column(*j), x, stride);
    }
  }

 private:
  Column column(Index j) const {
    const std::int64_t begin = data_.start[j];
    return {j, static_cast<Index>(data_.start[j + 1] - begin), data_.row.data() + begin,
            data_.value.data() + begin, data_.inverse_pivot[j]};
  }

  ColumnFactorData data_;
  EliminationTree tree_;
};

}  // namespace

std::unique_ptr<TriangularFactor> make_column_factor(ColumnFactorData data) {
  return std::make_unique<ColumnFactor>(std::move(data));
}

}  // namespace geotherm
