// SPDX-License-Identifier: MIT
#include "solver/heat/heat_step.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "solver/accuracy/check_heat.h"
#include "solver/core/stopwatch.h"
#include "solver/core/text.h"
#include "solver/heat/factor_memory.h"

namespace geotherm {

double diffusion_time(const ComponentSize& size, double unit, const TimeStep& step) {
  switch (step.rule) {
    case TimeRule::kMeanEdge:
      return step.factor * size.grading * size.mean_edge * size.mean_edge;
    case TimeRule::kMeanFaceArea:
      return step.factor * size.grading * size.area / static_cast<double>(size.cells);
    case TimeRule::kAbsolute:
      break;
  }
  return step.absolute / unit / unit;
}

Result<DiffusionTimes> diffusion_times(std::span<const ComponentSize> components, double unit,
                                       const TimeStep& step) {
  std::vector<double> t, relative;
  std::size_t largest = 0;
  for (std::size_t c = 0; c < components.size(); ++c) {
    const ComponentSize& size = components[c];
    if (size.cells > components[largest].cells) largest = c;
    t.push_back(diffusion_time(size, unit, step));
    relative.push_back(t.back() / size.mean_edge / size.mean_edge);
    const auto usable = [](double each) { return each > 0 && std::isfinite(each); };
    if (usable(t.back()) && usable(relative.back())) continue;
    return Error{ErrorCode::kBadInput,
                 "the diffusion time is " + rounded_text(relative.back()) +
                     " squared mean edges, where an edge is " +
                     rounded_text(size.mean_edge * unit) + " long",
                 {"choose one near 1"}};
  }
  DiffusionTimes out;
  out.relative_t = relative[largest];
  out.grading = components[largest].grading;
  out.model_t = step.rule == TimeRule::kAbsolute ? step.absolute : t[largest] * unit * unit;
  out.extreme =
      *std::ranges::max_element(relative, {}, [](double each) { return std::abs(std::log(each)); });
  out.t = PerComponent(std::move(t));
  out.relative = PerComponent(std::move(relative));
  return out;
}

/// The expansion behind it holds from t = 0.8 h^2 and fails below; at 0.2 h^2 the lumped mass is
/// better (measured).
PerComponent consistent_share(Variant variant, const PerComponent& relative_t) {
  if (variant == Variant::kClassic) return 0.0;
  return relative_t.map([](double t) { return 0.5 * std::clamp((t - 0.2) / 0.6, 0.0, 1.0); });
}

namespace {

/// What brings the right sides of all components to one size, as their systems see them: they are
/// lengths squared, and iterations end by one norm over all components.
std::vector<double> even_out(const std::vector<ComponentSize>& sizes, HeatMode mode) {
  std::vector<double> factors;
  for (const ComponentSize& size : sizes) {
    factors.push_back(mode == HeatMode::kUnit ? size.mean_edge : 1 / size.mean_edge);
  }
  return factors;
}

void scale_rows(const Components& components, const std::vector<double>& factors, Block& x) {
  for (Eigen::Index i = 0; i < x.rows(); ++i) x.row(i) *= factors[components.of[i]];
}

}  // namespace

bool HeatStep::is_of(const PerComponent& t, const PerComponent& consistent_share, bool iterative,
                     Precision precision) const {
  return t_ == t && consistent_share_ == consistent_share &&
         (iterative || same_factors(precision_, precision));
}

Result<std::shared_ptr<const HeatStep>> HeatStep::build(std::shared_ptr<const Domain> domain,
                                                        PerComponent t, BoundaryRule boundary,
                                                        PerComponent consistent_share,
                                                        bool iterative, Precision precision,
                                                        const HeatStep* previous, int threads,
                                                        const Progress& progress) {
  std::shared_ptr<HeatStep> out(new HeatStep);
  out->domain_ = std::move(domain);
  out->t_ = std::move(t);
  out->consistent_share_ = std::move(consistent_share);
  out->boundary_ = boundary;
  out->iterative_ = iterative;
  out->precision_ = precision;
  if (previous != nullptr &&
      !previous->is_of(out->t_, out->consistent_share_, iterative, precision)) {
    previous = nullptr;
  }
  const bool moved = previous != nullptr && previous->domain_ != out->domain_;
  if (previous != nullptr && !moved) {
    if (previous->neumann_) out->neumann_ = previous->neumann_->refined(out->refines());
    if (previous->dirichlet_) out->dirichlet_ = previous->dirichlet_->refined(out->refines());
  }
  const auto factor = [&](std::vector<Index> held, std::shared_ptr<const LinearSystem>& target) {
    const double share = out->neumann_ ? 0.5 : 0.0;
    if (!report(progress, "factorize", share)) return Result<void>(cancelled_error());
    EarlierSystem earlier;
    if (moved) {
      const auto& same = &target == &out->neumann_ ? previous->neumann_ : previous->dirichlet_;
      earlier = {previous->domain_.get(), same.get()};
    }
    auto built =
        LinearSystem::build(*out->domain_, 1.0, out->t_, std::move(held),
                            {threads, heat_storage(precision)}, out->consistent_share_, earlier);
    if (!built) return Result<void>(built.error());
    target = (*built)->refined(out->refines());
    return Result<void>();
  };
  if (boundary != BoundaryRule::kDirichlet && !out->neumann_) {
    if (const auto done = factor({}, out->neumann_); !done) return done.error();
  }
  if (boundary != BoundaryRule::kNeumann && !out->dirichlet_) {
    if (const auto done = factor(out->boundary_without(nullptr), out->dirichlet_); !done) {
      return done.error();
    }
  }
  return std::shared_ptr<const HeatStep>(std::move(out));
}

std::vector<Index> HeatStep::boundary_without(const SourceAnchors* anchors) const {
  std::vector<Index> sources;
  if (anchors != nullptr) sources = anchors->rows();
  std::vector<Index> boundary;
  for (Index row = 0; row < domain_->size(); ++row) {
    if (!domain_->on_boundary[row]) continue;
    if (!std::binary_search(sources.begin(), sources.end(), row)) boundary.push_back(row);
  }
  return boundary;
}

std::vector<SourceAnchors::Anchor> HeatStep::on_boundary(const SourceAnchors& anchors) const {
  std::vector<SourceAnchors::Anchor> out;
  std::ranges::copy_if(anchors.anchors, std::back_inserter(out),
                       [this](const auto& a) { return domain_->on_boundary[a.row] != 0; });
  return out;
}

bool HeatStep::needs_own_system(const SourceAnchors& anchors, HeatMode mode) const {
  if (boundary_ != BoundaryRule::kNeumann) {
    const std::size_t freed = on_boundary(anchors).size();
    if (freed > kMaxFreedRows || (freed > 0 && (iterative_ || mode == HeatMode::kHold))) {
      return true;
    }
  }
  return mode == HeatMode::kHold && (iterative_ || anchors.anchors.size() > kMaxHeldRows);
}

double HeatStep::held_value(const SourceAnchors::Anchor& anchor) const {
  const double t = t_.of(domain_->parts_of_rows().of[anchor.row]);
  return std::exp(-anchor.offset / std::sqrt(t));  // 1 on a source, Varadhan's decay beside it
}

Result<std::shared_ptr<const LinearSystem>> HeatStep::own_system(bool dirichlet,
                                                                 const SourceAnchors& anchors,
                                                                 HeatMode mode, int threads,
                                                                 Block& b) const {
  std::vector<Index> held;
  if (dirichlet) held = boundary_without(&anchors);
  if (mode == HeatMode::kHold) {
    const std::vector<Index> rows = anchors.rows();
    held.insert(held.end(), rows.begin(), rows.end());
    for (const auto& anchor : anchors.anchors) b(anchor.row, 0) = held_value(anchor);
  }
  const auto built = LinearSystem::build(*domain_, 1.0, t_, std::move(held),
                                         {threads, heat_storage(precision_)}, consistent_share_);
  if (!built) return built;
  return (*built)->refined(refines());
}

/// Sources on a boundary that is held at 0 have no heat unless their own rows are free. The factor
/// with the whole boundary held gives the solutions with u = 1 on one of these rows each, and that
/// of the heat of all other rows; the values that fulfil the equations of the freed rows go into
/// `b`, where the held rows have their values.
Result<void> HeatStep::free_by_schur(const SourceAnchors& anchors, Eigen::Index column,
                                     const Workspace& work, Block& b) const {
  const auto freed = on_boundary(anchors);
  const auto count = static_cast<Eigen::Index>(freed.size());
  Block u = work.take_zero(b.rows(), count + 1);
  u.col(count) = b.col(column);
  for (Eigen::Index k = 0; k < count; ++k) {
    u(freed[k].row, k) = 1;
    u(freed[k].row, count) = 0;
  }
  if (const auto solved = dirichlet_->solve(u, {}, work); !solved) return solved.error();
  Eigen::MatrixXd reaction(count, count + 1);
  std::vector<double> values(static_cast<std::size_t>(b.rows())), product(values.size());
  for (Eigen::Index k = 0; k <= count; ++k) {
    Eigen::Map<Eigen::VectorXd>(values.data(), b.rows()) = u.col(k);
    dirichlet_->matrix().apply_free(values, product);
    for (Eigen::Index i = 0; i < count; ++i) reaction(i, k) = product[freed[i].row];
  }
  work.pool.give(std::move(u));
  Eigen::VectorXd missing(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    missing(i) = b(freed[i].row, column) - reaction(i, count);
  }
  const Eigen::VectorXd held = reaction.leftCols(count).partialPivLu().solve(missing);
  for (Eigen::Index i = 0; i < count; ++i) b(freed[i].row, column) = held(i);
  return {};
}

/// u = M^-1 E lambda with u = 1 on the sources: one small dense system a source set. The entries of
/// the inverse are as accurate as the factor; refined, lambda is, too, and takes one solve more.
Result<void> HeatStep::hold_by_schur(const LinearSystem& system,
                                     std::span<const SourceAnchors> anchors, const Workspace& work,
                                     Block& b) const {
  std::vector<Eigen::PartialPivLU<Eigen::MatrixXd>> inverse;
  std::vector<Index> support;
  for (const SourceAnchors& set : anchors) {
    const std::vector<Index> rows = set.rows();
    support.insert(support.end(), rows.begin(), rows.end());
    const auto entries = system.factor().inverse_entries(rows);
    if (!entries) return entries.error();
    inverse.emplace_back(*entries);
  }
  Block u;  // of the lambda so far
  for (int round = 0; round < (system.refines() ? 2 : 1); ++round) {
    for (std::size_t c = 0; c < anchors.size(); ++c) {
      const auto& held = anchors[c].anchors;
      const auto column = static_cast<Eigen::Index>(c);
      Eigen::VectorXd missing(static_cast<Eigen::Index>(held.size()));
      for (std::size_t i = 0; i < held.size(); ++i) {
        missing(static_cast<Eigen::Index>(i)) =
            held_value(held[i]) - (round > 0 ? u(held[i].row, column) : 0.0);
      }
      const Eigen::VectorXd lambda = inverse[c].solve(missing);
      for (std::size_t i = 0; i < held.size(); ++i) {
        b(held[i].row, column) += lambda(static_cast<Eigen::Index>(i));
      }
    }
    if (round > 0 || !system.refines()) break;
    u = b;
    if (const auto solved = system.invert(u, support, work); !solved) return solved.error();
  }
  return {};
}

Result<HeatStep::Answer> HeatStep::solve_rule(bool dirichlet,
                                              std::span<const SourceAnchors> anchors, HeatMode mode,
                                              bool residuals, const Workspace& work,
                                              const Progress& progress) const {
  const Components& components = domain_->parts_of_rows();
  const std::span<const double> mass = domain_->mass();
  const auto columns = static_cast<Eigen::Index>(anchors.size());
  Block b = work.take_zero(domain_->size(), columns);
  std::vector<Index> support;
  std::vector<std::vector<char>> reached;
  for (std::size_t c = 0; c < anchors.size(); ++c) {
    reached.emplace_back(static_cast<std::size_t>(components.count), 0);
    for (const Index component : anchors[c].components) reached.back()[component] = 1;
    for (const auto& anchor : anchors[c].anchors) {
      support.push_back(anchor.row);
      if (mode == HeatMode::kHold) continue;
      b(anchor.row, static_cast<Eigen::Index>(c)) =
          anchor.heat * (mode == HeatMode::kDiffuse ? mass[anchor.row] : 1.0);
    }
  }
  std::shared_ptr<const LinearSystem> system = dirichlet ? dirichlet_ : neumann_;
  const bool of_boundary = dirichlet && !on_boundary(anchors.front()).empty();
  const bool own =
      needs_own_system(anchors.front(), mode) && (of_boundary || mode == HeatMode::kHold);
  if (own) {
    if (!report(progress, "solve", 0.0)) return cancelled_error();
    auto built = own_system(dirichlet, anchors.front(), mode, work.threads, b);
    if (!built) return built.error();
    system = std::move(*built);
  } else if (mode == HeatMode::kHold) {
    if (const auto held = hold_by_schur(*system, anchors, work, b); !held) return held.error();
  } else if (dirichlet) {
    for (std::size_t c = 0; c < anchors.size(); ++c) {
      if (on_boundary(anchors[c]).empty()) continue;
      const auto freed = free_by_schur(anchors[c], static_cast<Eigen::Index>(c), work, b);
      if (!freed) return freed.error();
    }
  }
  std::vector<double> factors;
  if (iterative_ && components.count > 1) {
    factors = even_out(domain_->component_sizes, mode);
    scale_rows(components, factors, b);
  }
  Block right;  // kept only where it is looked at again
  if (residuals) right = b;
  auto field = geotherm::diffuse(*system, components, std::move(b), support, reached,
                                 iterative_ ? kIterativeFloor : kDirectFloor, work, progress);
  if (!field) return field.error();
  Answer answer{std::move(*field), {}, 0.0, {}};
  const Stopwatch watch;
  for (Eigen::Index c = 0; residuals && c < columns; ++c) {
    answer.residual.push_back(heat_residual(system->matrix(), answer.field, right, c));
  }
  answer.residual_ms = watch.milliseconds();
  if (!factors.empty()) {
    for (double& factor : factors) factor = 1 / factor;
    scale_rows(components, factors, answer.field.u);
  }
  if (of_boundary && boundary_ == BoundaryRule::kDirichlet) {
    answer.warnings.emplace_back().message =
        "sources on the boundary are left free under the Dirichlet rule; the rest of the boundary "
        "is held at 0";
  }
  return answer;
}

Result<HeatStep::Answer> HeatStep::diffuse(std::span<const SourceAnchors> anchors, HeatMode mode,
                                           bool residuals, const Workspace& work,
                                           const Progress& progress) const {
  if (precision_ == Precision::kCompact && !iterative_ && has_many(anchors)) {
    HeatStep refined(*this);
    refined.precision_ = Precision::kRefined;
    if (neumann_) refined.neumann_ = neumann_->refined(true);
    if (dirichlet_) refined.dirichlet_ = dirichlet_->refined(true);
    return refined.diffuse(anchors, mode, residuals, work, progress);
  }
  if (boundary_ != BoundaryRule::kAverage) {
    return solve_rule(boundary_ == BoundaryRule::kDirichlet, anchors, mode, residuals, work,
                      progress);
  }
  auto neumann = solve_rule(false, anchors, mode, residuals, work, part_of(progress, 0.0, 0.5));
  if (!neumann) return neumann;
  auto dirichlet = solve_rule(true, anchors, mode, residuals, work, part_of(progress, 0.5, 1.0));
  if (!dirichlet) return dirichlet;
  neumann->field = average(std::move(neumann->field), dirichlet->field);
  work.pool.give(std::move(dirichlet->field.u));
  neumann->warnings = dirichlet->warnings;
  neumann->residual_ms += dirichlet->residual_ms;
  for (std::size_t c = 0; c < neumann->residual.size(); ++c) {
    neumann->residual[c] = std::max(neumann->residual[c], dirichlet->residual[c]);
  }
  return neumann;
}

FactorStats HeatStep::stats() const {
  FactorStats sum;
  for (const auto& system : {neumann_, dirichlet_}) {
    if (!system) continue;
    sum.nonzeros += system->factor().stats().nonzeros;
    sum.bytes += system->factor().stats().bytes;
    sum.operations += system->factor().stats().operations;
    sum.fronts += system->factor().stats().fronts;
    sum.fronts_factored += system->factor().stats().fronts_factored;
  }
  return sum;
}

}  // namespace geotherm
