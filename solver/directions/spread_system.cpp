// SPDX-License-Identifier: MIT
#include "solver/directions/spread_system.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "solver/linear/elimination_tree.h"

namespace geotherm {
namespace {

class AddedUp final : public SymmetricOperator {
 public:
  AddedUp(const LowerPattern& lower, std::uint64_t hash)
      : matrix_{lower.start, lower.row, std::vector<double>(lower.row.size(), 0.0)}, hash_(hash) {}

  void add(Index i, Index j, double value) {
    const auto column = std::min(i, j), row = std::max(i, j);
    const auto begin = matrix_.row.begin() + matrix_.start[column];
    const auto end = matrix_.row.begin() + matrix_.start[column + 1];
    matrix_.value[std::lower_bound(begin, end, row) - matrix_.row.begin()] += value;
  }

  void finish() {
    for (Index i = 0; i < size(); ++i) diagonal_.push_back(matrix_.value[matrix_.start[i]]);
  }

  Index size() const override { return matrix_.size(); }
  void apply(std::span<const double> x, std::span<double> y) const override {
    std::ranges::fill(y, 0.0);
    for (Index column = 0; column < size(); ++column) {
      for (auto e = matrix_.start[column]; e < matrix_.start[column + 1]; ++e) {
        const Index row = matrix_.row[e];
        y[row] += matrix_.value[e] * x[column];
        if (row != column) y[column] += matrix_.value[e] * x[row];
      }
    }
  }
  std::span<const double> diagonal() const override { return diagonal_; }
  std::uint64_t pattern() const override { return hash_; }
  const LowerMatrix& assembled() const override { return matrix_; }

 private:
  LowerMatrix matrix_;
  std::uint64_t hash_;
  std::vector<double> diagonal_;
};

/// Rows 2 i and 2 i + 1 of a pattern's row i.
SymmetricPattern doubled(const SymmetricPattern& pattern) {
  SymmetricPattern out;
  out.neighbor.reserve(4 * pattern.neighbor.size());
  for (Index row = 0; row < 2 * pattern.size(); ++row) {
    for (const Index j : pattern.neighbors(row / 2)) {
      out.neighbor.push_back(2 * j);
      out.neighbor.push_back(2 * j + 1);
    }
    out.start.push_back(static_cast<std::int64_t>(out.neighbor.size()));
  }
  return out;
}

/// The nodes of a tree with two rows for each; rows of a node follow each other.
NodeOrder doubled(const EliminationTree& tree) {
  NodeOrder out;
  out.parent = tree.parent;
  out.order.resize(2 * tree.node_of_row.size());
  std::iota(out.order.begin(), out.order.end(), Index{0});
  out.first.assign(tree.parent.size() + 1, 0);
  for (const Index node : tree.node_of_row) out.first[node + 1] += 2;
  std::partial_sum(out.first.begin(), out.first.end(), out.first.begin());
  return out;
}

}  // namespace

Result<SpreadSystem> SpreadSystem::build_doubled(const Backend& backend, const Analysis& analysis,
                                                 const SymmetricPattern& pattern,
                                                 std::span<const Vec3> positions, int threads) {
  SpreadSystem out;
  const SymmetricPattern twice = doubled(pattern);
  if (const EliminationTree* const tree = analysis.tree()) {
    if (auto followed = analysis.follow(doubled(*tree), twice, threads)) {
      out.analysis_ = *std::move(followed);
    }
  }
  if (!out.analysis_) {
    std::vector<Vec3> at;
    for (const Vec3& position : positions) at.insert(at.end(), 2, position);
    auto fresh = backend.analyze(twice, at, threads);
    if (!fresh) return fresh.error();
    out.analysis_ = *std::move(fresh);
  }
  out.row_ = inverse_permutation(out.analysis_->order(), threads);
  out.lower_ = permuted_lower(twice, out.analysis_->order(), threads);
  out.hash_ = pattern_hash(out.lower_, threads);
  return out;
}

Result<std::shared_ptr<const Factorization>> SpreadSystem::factorize(const Entries& entries,
                                                                     int threads) const {
  auto matrix = std::make_shared<AddedUp>(lower_, hash_);
  entries([&](Index i, Index j, double value) { matrix->add(row_[i], row_[j], value); });
  matrix->finish();
  FactorOptions options;
  options.threads = threads;
  auto factor = analysis_->factorize(std::move(matrix), options);
  if (!factor) return factor.error();
  return std::shared_ptr<const Factorization>(*std::move(factor));
}

Result<std::vector<double>> SpreadSystem::solve(const Factorization& factor,
                                                std::span<const double> right,
                                                const Progress& progress, int threads) const {
  Block block(size(), 1);
  for (Index i = 0; i < size(); ++i) block(row_[i], 0) = right[i];
  if (auto solved = factor.solve(block, {}, progress, threads); !solved) return solved.error();
  std::vector<double> out(right.size());
  for (Index i = 0; i < size(); ++i) out[i] = block(row_[i], 0);
  return out;
}

}  // namespace geotherm
