// SPDX-License-Identifier: MIT
#include "solver/linear/triangular_factor.h"
#include "solver/core/processor.h"

#include <algorithm>

namespace geotherm {
namespace {

class DirectFactorization final : public Factorization {
 public:
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

}  // namespace

std::unique_ptr<Factorization> make_direct_factorization(std::unique_ptr<TriangularFactor> factor) {
  return std::make_unique<DirectFactorization>(std::move(factor));
}

}  // namespace geotherm
