// SPDX-License-Identifier: MIT
// Sources held at their distances through the one pinned factor: phi = z + G_S lambda + c 1 on each
// component, z the pinned solution and G the pinned inverse. phi = g on the anchors and
// 1' lambda = 0 (so that the right side stays consistent) make a small dense system for lambda and
// c.
#include <Eigen/LU>
#include <vector>

#include "solver/heat/poisson.h"

namespace geotherm {
namespace {

using Anchors = std::vector<SourceAnchors::Anchor>;

/// The anchors of one component and column, and their dense system.
struct Bordered {
  Eigen::Index column;
  Index component;
  Anchors anchors;
  Eigen::PartialPivLU<Eigen::MatrixXd> inverse{};
};

std::vector<Index> rows_of(const Anchors& anchors) {
  std::vector<Index> rows;
  for (const auto& anchor : anchors) rows.push_back(anchor.row);
  return rows;
}

/// [G 1; 1' 0] on the anchors, G zero on pins as the pinned inverse is.
Result<Eigen::PartialPivLU<Eigen::MatrixXd>> factor_bordered(const LinearSystem& system,
                                                             const Anchors& anchors) {
  const std::vector<Index> rows = rows_of(anchors);
  const auto k = static_cast<Eigen::Index>(rows.size());
  const auto entries = system.factor().inverse_entries(rows);
  if (!entries) return entries.error();
  Eigen::MatrixXd bordered = Eigen::MatrixXd::Ones(k + 1, k + 1);
  bordered(k, k) = 0;
  bordered.topLeftCorner(k, k) = *entries;
  for (Eigen::Index i = 0; i < k; ++i) {
    if (!system.matrix().is_held(rows[static_cast<std::size_t>(i)])) continue;
    bordered.row(i).head(k).setZero();
    bordered.col(i).head(k).setZero();
  }
  return Eigen::PartialPivLU<Eigen::MatrixXd>(bordered);
}

}  // namespace

Result<PoissonAnswer> PoissonSolver::solve_schur(Block b, std::span<const SourceAnchors> anchors,
                                                 const Workspace& work,
                                                 const Progress& progress) const {
  const Components& components = surface_->operators->components;
  auto answer = solve_pinned(std::move(b), work, progress);
  if (!answer) return answer.error();
  Block& phi = answer->phi;
  Block shift = Block::Zero(components.count, phi.cols());
  std::vector<Bordered> systems;
  for (Eigen::Index c = 0; c < phi.cols(); ++c) {
    const SourceAnchors& set = anchors[static_cast<std::size_t>(c)];
    for (const Index component : set.components) {
      Anchors here;
      for (const auto& anchor : set.anchors) {
        if (components.of[anchor.row] == component) here.push_back(anchor);
      }
      if (here.size() == 1) {
        shift(component, c) = here[0].offset - phi(here[0].row, c);
        continue;
      }
      auto factor = factor_bordered(*system_, here);
      if (!factor) return factor.error();
      systems.push_back({c, component, std::move(here), std::move(*factor)});
    }
  }
  // The entries of the inverse are as accurate as the factor: refined, what phi still lacks on the
  // anchors is solved for once more.
  const int rounds = systems.empty() ? 0 : system_->refines() ? 2 : 1;
  for (int round = 0; round < rounds; ++round) {
    std::vector<Index> support;
    Block correction = work.take_zero(phi.rows(), phi.cols());
    for (const Bordered& system : systems) {
      const auto k = static_cast<Eigen::Index>(system.anchors.size());
      double& shifted = shift(system.component, system.column);
      Eigen::VectorXd right = Eigen::VectorXd::Zero(k + 1);
      for (Eigen::Index i = 0; i < k; ++i) {
        const auto& anchor = system.anchors[static_cast<std::size_t>(i)];
        right(i) = anchor.offset - (phi(anchor.row, system.column) + shifted);
      }
      const Eigen::VectorXd lambda = system.inverse.solve(right);
      shifted += lambda(k);
      for (Eigen::Index i = 0; i < k; ++i) {
        const Index row = system.anchors[static_cast<std::size_t>(i)].row;
        if (system_->matrix().is_held(row)) continue;
        correction(row, system.column) = lambda(i);
        support.push_back(row);
      }
    }
    if (support.empty()) break;
    if (!report(progress, "solve", 1.0)) return cancelled_error();
    const auto solved = system_->invert(correction, support, work);
    if (!solved) return solved.error();
    work.for_rows(phi.size(), 1, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t e = begin; e < end; ++e) phi.data()[e] += correction.data()[e];
    });
    work.pool.give(std::move(correction));
  }
  answer->shift = std::move(shift);
  return answer;
}

}  // namespace geotherm
