// SPDX-License-Identifier: MIT
// The Poisson step under every constraint mode. Sources are held at their distances through the one
// pinned factor: phi = z + G_S lambda + c 1 on each
// component, z the pinned solution and G the pinned inverse. phi = g on the anchors and
// 1' lambda = 0 (so that the right side stays consistent) make a small dense system for lambda and
// c.
#include "solver/heat/poisson.h"

#include <Eigen/LU>
#include <algorithm>
#include <vector>

#include "solver/heat/factor_memory.h"

namespace geotherm {
namespace {

/// One held vertex a component: the last eliminated (the pivot that suffers least), the last of
/// the file for the penalty mode, or the one asked for.
Result<std::vector<Index>> choose_pins(const Domain& domain, const Constraint& constraint) {
  const Components& components = domain.parts_of_rows();
  std::vector<Index> pins(static_cast<std::size_t>(components.count), kNoIndex);
  const bool last_of_file = constraint.mode == ConstraintMode::kPenalty;
  for (Index row = 0; row < domain.size(); ++row) {
    Index& pin = pins[components.of[row]];
    const Index v = domain.vertex_of_row[row];
    if (v >= domain.input_vertices) continue;  // inserted
    if (pin == kNoIndex || !last_of_file || v > domain.vertex_of_row[pin]) pin = row;
  }
  if (constraint.mode == ConstraintMode::kPinVertex && constraint.pin_vertex != kNoIndex) {
    const Index v = constraint.pin_vertex;
    const Index count = domain.input_vertices;
    if (v < 0 || v >= count || domain.row_of_vertex[v] == kNoIndex) {
      return Error{ErrorCode::kBadInput, "vertex " + std::to_string(v) +
                                             " cannot be pinned: it is not on the surface (0 to " +
                                             std::to_string(count - 1) + ")"};
    }
    const Index row = domain.row_of_vertex[v];
    pins[components.of[row]] = row;
  }
  return pins;
}

bool solves_singular(const Constraint& constraint, bool iterative) {
  return iterative && constraint.mode != ConstraintMode::kPinVertex &&
         constraint.mode != ConstraintMode::kPenalty;
}

/// Subtracts from every component of x the multiple of `direction` that makes its inner product
/// with `weight` zero: x -= direction (weight' x) / (weight' direction).
void remove(const Components& components, std::span<const double> direction,
            std::span<const double> weight, Block& x) {
  const auto at = [](std::span<const double> v, Eigen::Index i) { return v.empty() ? 1.0 : v[i]; };
  Block sum = Block::Zero(components.count, x.cols());
  std::vector<double> norm(static_cast<std::size_t>(components.count), 0.0);
  for (Eigen::Index i = 0; i < x.rows(); ++i) {
    sum.row(components.of[i]) += at(weight, i) * x.row(i);
    norm[components.of[i]] += at(weight, i) * at(direction, i);
  }
  for (Eigen::Index i = 0; i < x.rows(); ++i) {
    x.row(i) -= at(direction, i) / norm[components.of[i]] * sum.row(components.of[i]);
  }
}

}  // namespace

Result<std::shared_ptr<const PoissonSolver>> PoissonSolver::build(
    std::shared_ptr<const Domain> domain, const Constraint& constraint, bool iterative,
    Precision precision, const PoissonSolver* earlier, int threads, const Progress& progress) {
  std::shared_ptr<PoissonSolver> out(new PoissonSolver);
  std::vector<Index> pins;
  auto chosen = choose_pins(*domain, constraint);
  if (!chosen) return chosen.error();
  if (!solves_singular(constraint, iterative)) pins = std::move(*chosen);
  if (!report(progress, "factorize", 0.0)) return cancelled_error();
  EarlierSystem before;
  if (earlier != nullptr && same_factors(earlier->precision_, precision)) {
    before = {earlier->domain_.get(), earlier->system_.get()};
  }
  auto system = LinearSystem::build(*domain, 0.0, 1.0, std::move(pins),
                                    {threads, poisson_storage(precision)}, 0.0, before);
  if (!system) return system.error();
  out->system_ = (*system)->refined(precision == Precision::kRefined && !iterative);
  out->precision_ = precision;
  out->domain_ = std::move(domain);
  out->constraint_ = constraint;
  out->iterative_ = iterative;
  return std::shared_ptr<const PoissonSolver>(std::move(out));
}

std::shared_ptr<const PoissonSolver> PoissonSolver::with(const Constraint& constraint,
                                                         Precision precision) const {
  if (!iterative_ && !same_factors(precision, precision_)) return nullptr;
  const auto wanted = choose_pins(*domain_, constraint);
  const auto held = system_->matrix().held();
  if (!wanted) return nullptr;
  const bool same = solves_singular(constraint, iterative_)
                        ? held.empty()
                        : std::equal(held.begin(), held.end(), wanted->begin(), wanted->end());
  if (!same) return nullptr;
  std::shared_ptr<PoissonSolver> out(new PoissonSolver(*this));
  out->constraint_ = constraint;
  out->precision_ = precision;
  out->system_ = system_->refined(precision == Precision::kRefined && !iterative_);
  return out;
}

Result<PoissonAnswer> PoissonSolver::solve_pinned(Block b, const Workspace& work,
                                                  const Progress& progress) const {
  if (!report(progress, "solve", 0.0)) return cancelled_error();
  for (const Index pin : system_->matrix().held()) b.row(pin).setZero();
  const auto solved = system_->invert(b, {}, work, progress);
  if (!solved) return solved.error();
  return PoissonAnswer{std::move(b), {}, solved->iterations};
}

Result<PoissonAnswer> PoissonSolver::solve(Block b, std::span<const SourceAnchors> anchors,
                                           const Workspace& work, const Progress& progress) const {
  if (precision_ == Precision::kCompact && !iterative_ && has_many(anchors)) {
    PoissonSolver refined(*this);
    refined.precision_ = Precision::kRefined;
    refined.system_ = system_->refined(true);
    return refined.solve(std::move(b), anchors, work, progress);
  }
  const std::vector<ComponentSize>& sizes = domain_->component_sizes;
  if (!iterative_ || sizes.size() == 1)
    return solve_as_given(std::move(b), anchors, work, progress);
  // Iterations end by one norm over all components: each comes in its own unit of length, else
  // those with short edges would hardly count.
  const std::vector<Index>& component = domain_->parts_of_rows().of;
  for (Eigen::Index i = 0; i < b.rows(); ++i) b.row(i) /= sizes[component[i]].mean_edge;
  std::vector<SourceAnchors> scaled(anchors.begin(), anchors.end());
  for (SourceAnchors& set : scaled) {
    for (auto& anchor : set.anchors) anchor.offset /= sizes[component[anchor.row]].mean_edge;
  }
  auto answer = solve_as_given(std::move(b), scaled, work, progress);
  if (!answer) return answer;
  Block& phi = answer->phi;
  for (Eigen::Index i = 0; i < phi.rows(); ++i) phi.row(i) *= sizes[component[i]].mean_edge;
  return answer;
}

Result<PoissonAnswer> PoissonSolver::solve_as_given(Block b, std::span<const SourceAnchors> anchors,
                                                    const Workspace& work,
                                                    const Progress& progress) const {
  const Components& components = domain_->parts_of_rows();
  const std::span<const double> mass = domain_->mass();
  switch (constraint_.mode) {
    case ConstraintMode::kPinSources: {
      std::size_t most = 0;
      for (const SourceAnchors& a : anchors) most = std::max(most, a.anchors.size());
      return iterative_ || most > kMaxSchurRows
                 ? solve_held(b, anchors, work, progress)
                 : solve_schur(std::move(b), anchors, work, progress);
    }
    case ConstraintMode::kPinVertex:
      return solve_pinned(std::move(b), work, progress);
    case ConstraintMode::kPenalty: {
      std::vector<Index> rows(system_->matrix().held().begin(), system_->matrix().held().end());
      Block ends(static_cast<Eigen::Index>(rows.size()), b.cols());
      for (std::size_t i = 0; i < rows.size(); ++i) ends.row(i) = b.row(rows[i]);
      auto answer = solve_pinned(std::move(b), work, progress);
      if (!answer) return answer.error();
      for (std::size_t i = 0; i < rows.size(); ++i) {
        answer->phi.row(rows[i]) = ends.row(i) / constraint_.penalty;
      }
      return answer;
    }
    case ConstraintMode::kConserveEnergy: {
      // [L a; a' 0] [phi; lambda] = [b; 0]: lambda = 1'b / 1'a takes the inconsistency along the
      // masses, and phi is the pinned solution shifted to the mass-weighted mean 0.
      remove(components, mass, {}, b);
      auto answer = solve_pinned(std::move(b), work, progress);
      if (answer) remove(components, {}, mass, answer->phi);
      return answer;
    }
    case ConstraintMode::kPseudoInverse: {
      remove(components, {}, {}, b);
      auto answer = solve_pinned(std::move(b), work, progress);
      if (answer) remove(components, {}, {}, answer->phi);
      return answer;
    }
  }
  return Error{ErrorCode::kBadInput, "unknown constraint mode"};
}

Result<PoissonAnswer> PoissonSolver::solve_held(const Block& b,
                                                std::span<const SourceAnchors> anchors,
                                                const Workspace& work,
                                                const Progress& progress) const {
  const Components& components = domain_->parts_of_rows();
  PoissonAnswer answer{b};
  for (Eigen::Index c = 0; c < b.cols(); ++c) {
    const SourceAnchors& a = anchors[static_cast<std::size_t>(c)];
    std::vector<Index> held = a.rows();
    for (const Index pin : system_->matrix().held()) {  // components without a source
      if (!std::binary_search(a.components.begin(), a.components.end(), components.of[pin])) {
        held.push_back(pin);
      }
    }
    const auto columns = static_cast<double>(b.cols());
    const Progress part =
        part_of(progress, static_cast<double>(c) / columns, static_cast<double>(c + 1) / columns);
    if (!report(part, "solve", 0.0)) return cancelled_error();
    const auto system = LinearSystem::build(*domain_, 0.0, 1.0, std::move(held),
                                            {work.threads, poisson_storage(precision_)});
    if (!system) return system.error();
    Block x = b.col(c);
    for (const Index row : (*system)->matrix().held()) x(row, 0) = 0;
    for (const auto& anchor : a.anchors) x(anchor.row, 0) = anchor.offset;
    if (!report(part, "solve", 0.0)) return cancelled_error();
    const auto solved = (*system)->refined(system_->refines())->solve(x, {}, work, part);
    if (!solved) return solved.error();
    answer.phi.col(c) = x;
    answer.iterations = std::max(answer.iterations, solved->iterations);
  }
  return answer;
}

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
  const Components& components = domain_->parts_of_rows();
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
