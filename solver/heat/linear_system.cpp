// SPDX-License-Identifier: MIT
#include "solver/heat/linear_system.h"

#include <algorithm>
#include <utility>

namespace geotherm {

namespace {

/// Whether the same vertices are held.
bool holds_same(const EarlierSystem& earlier, const Domain& domain, std::span<const Index> held) {
  return std::ranges::equal(
      earlier.system->matrix().held(), held, {},
      [&](Index row) { return earlier.domain->vertex_of_row[row]; },
      [&](Index row) { return domain.vertex_of_row[row]; });
}

}  // namespace

Result<std::shared_ptr<const LinearSystem>> LinearSystem::build(
    const Domain& domain, double mass_factor, const PerComponent& stiffness_factor,
    std::vector<Index> held, const FactorOptions& options, const PerComponent& consistent_share,
    const EarlierSystem& earlier) {
  EarlierFactor before{nullptr, domain.changed_rows};
  if (earlier.system != nullptr && holds_same(earlier, domain, held)) {
    before.factor = &earlier.system->factor();
  }
  // The factorisation gets an operator of its own, so that a matrix assembled for a direct solver
  // is gone once it is factored; a matrix-free backend keeps it and has nothing assembled.
  auto factored = domain.combine(mass_factor, stiffness_factor, std::move(held), consistent_share,
                                 options.threads);
  std::shared_ptr<LinearSystem> out(new LinearSystem);
  out->matrix_ = factored->copy();
  FactorOptions with_memory = options;
  with_memory.memory = domain.factor_memory;
  if (earlier.domain != nullptr && !domain.changed_rows.empty()) with_memory.earlier = &before;
  auto factor = domain.analysis->factorize(std::move(factored), with_memory);
  if (!factor) return factor.error();
  out->factor_ = std::move(*factor);
  return std::shared_ptr<const LinearSystem>(std::move(out));
}

Result<SolveReport> LinearSystem::solve(Block& x, std::span<const Index> support,
                                        const Workspace& work, const Progress& progress) const {
  const std::span<const Index> held = matrix_->held();
  bool zero = true;
  for (const Index i : held) zero = zero && (x.row(i).array() == 0).all();
  if (zero) return invert(x, support, work, progress);

  const auto n = static_cast<std::size_t>(matrix_->size());
  std::vector<double> known(n), moved(n);
  for (Eigen::Index c = 0; c < x.cols(); ++c) {
    std::fill(known.begin(), known.end(), 0.0);
    for (const Index i : held) known[i] = x(i, c);
    matrix_->apply_free(known, moved);
    for (std::size_t i = 0; i < n; ++i) {
      if (!matrix_->is_held(static_cast<Index>(i))) x(static_cast<Eigen::Index>(i), c) -= moved[i];
    }
  }
  return invert(x, {}, work, progress);
}

Result<SolveReport> LinearSystem::invert(Block& x, std::span<const Index> support,
                                         const Workspace& work, const Progress& progress) const {
  if (!refine_) return factor_->solve(x, support, progress, work.threads);
  Block b = work.pool.take(x.rows(), x.cols());
  work.for_rows(x.size(), 1, [&](std::int64_t begin, std::int64_t end) {
    std::copy(x.data() + begin, x.data() + end, b.data() + begin);
  });
  const auto solved = factor_->solve(x, support, part_of(progress, 0.0, 0.5), work.threads);
  if (!solved) return solved;
  Block r = work.pool.take(x.rows(), x.cols());
  matrix_->residual(b, x, r, work.threads);
  work.pool.give(std::move(b));
  const auto corrected = factor_->solve(r, {}, part_of(progress, 0.5, 1.0), work.threads);
  if (!corrected) return corrected;
  work.for_rows(x.size(), 1, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t e = begin; e < end; ++e) x.data()[e] += r.data()[e];
  });
  work.pool.give(std::move(r));
  return solved;
}

Result<SolveReport> LinearSystem::invert_where(Block& x, std::span<const Index> support,
                                               std::span<const char> wanted, const Workspace& work,
                                               const Progress& progress) const {
  if (refine_) return invert(x, support, work, progress);  // the residual takes all rows
  return factor_->solve_where(x, support, wanted, progress, work.threads);
}

std::shared_ptr<const LinearSystem> LinearSystem::refined(bool refine) const {
  std::shared_ptr<LinearSystem> out(new LinearSystem(*this));
  out->refine_ = refine;
  return out;
}

}  // namespace geotherm
