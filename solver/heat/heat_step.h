// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "geotherm/error.h"
#include "solver/heat/diffuse.h"
#include "solver/heat/domain.h"
#include "solver/heat/linear_system.h"

namespace geotherm {

/// The diffusion times of a domain's components: h and A/F of a rule are those of each.
struct DiffusionTimes {
  PerComponent t = 0;         ///< in squares of the unit
  PerComponent relative = 0;  ///< in squares of the component's own mean edge
  double model_t = 0;         ///< of the component with most cells, model units squared
  double relative_t = 0;      ///< of the same, in squares of its mean edge
  double grading = 1;         ///< of the same, ComponentSize::grading
  double extreme = 1;         ///< that member of `relative` whose logarithm is farthest from 0

  bool operator==(const DiffusionTimes&) const = default;
};

/// The time of one component, in squares of `unit`, in which its size is.
double diffusion_time(const ComponentSize& size, double unit, const TimeStep& step);

/// `unit`: Domain::unit, in which sizes are. Precondition: the step's factor, or its absolute time,
/// is positive and finite. Errors:
/// kBadInput (a time that is 0 or not finite in squares of the mean edge).
Result<DiffusionTimes> diffusion_times(std::span<const ComponentSize> components, double unit,
                                       const TimeStep& step);

/// The share c of the mass that is consistent, FemOperator: half where the mesh resolves the
/// diffusion length, none for Variant::kClassic.
PerComponent consistent_share(Variant variant, const PerComponent& relative_t);

/// Held vertices up to this many are reached through the shared factor (HeatMode::kHold).
inline constexpr std::size_t kMaxHeldRows = 128;

/// Sources on a Dirichlet boundary up to this many are reached through the shared factor.
inline constexpr std::size_t kMaxFreedRows = 15;

/// The heat step under a boundary rule: (A + t L) u = u0 with the heat modes of options.h.
class HeatStep {
 public:
  /// The result of diffuse().
  struct Answer {
    HeatField field;
    std::vector<double> residual;  ///< |M u - b| / |b| of each column; empty unless asked for
    double residual_ms = 0;        ///< what that took: no part of the query
    std::vector<Warning> warnings;
  };

  /// `t` in squares of the unit. Systems are taken over from `previous` where it has them with this
  /// t, share and storage; of a domain from which this one has moved, what has not changed.
  /// `progress` is asked before each factorisation. Errors: the backend's, kCancelled.
  static Result<std::shared_ptr<const HeatStep>> build(std::shared_ptr<const Domain> domain,
                                                       PerComponent t, BoundaryRule boundary,
                                                       PerComponent consistent_share,
                                                       bool iterative, Precision precision,
                                                       const HeatStep* previous, int threads,
                                                       const Progress& progress = {});

  /// Whether its systems are those of this t, share and storage.
  bool is_of(const PerComponent& t, const PerComponent& consistent_share, bool iterative,
             Precision precision) const;

  BoundaryRule boundary() const { return boundary_; }  ///< never kAuto

  /// True when these sources change the matrix, so that they cannot share a block with others:
  /// many sources on a Dirichlet boundary, and u held on many vertices.
  bool needs_own_system(const SourceAnchors& anchors, HeatMode mode) const;

  /// u for every source set. Precondition: one set only, where it needs its own system.
  /// `progress` is asked before each factorisation and solve, and by an iterative backend within.
  /// Errors: the backend's, kCancelled.
  Result<Answer> diffuse(std::span<const SourceAnchors> anchors, HeatMode mode, bool residuals,
                         const Workspace& work, const Progress& progress = {}) const;

  FactorStats stats() const;

 private:
  HeatStep() = default;
  std::vector<Index> boundary_without(const SourceAnchors* anchors) const;
  std::vector<SourceAnchors::Anchor> on_boundary(const SourceAnchors& anchors) const;
  Result<Answer> solve_rule(bool dirichlet, std::span<const SourceAnchors> anchors, HeatMode mode,
                            bool residuals, const Workspace& work, const Progress& progress) const;
  /// The system of this rule for one source set, and its right side with held values in place.
  Result<std::shared_ptr<const LinearSystem>> own_system(bool dirichlet,
                                                         const SourceAnchors& anchors,
                                                         HeatMode mode, int threads,
                                                         Block& b) const;
  Result<void> free_by_schur(const SourceAnchors& anchors, Eigen::Index column,
                             const Workspace& work, Block& b) const;
  Result<void> hold_by_schur(const LinearSystem& system, std::span<const SourceAnchors> anchors,
                             const Workspace& work, Block& b) const;
  bool refines() const { return precision_ == Precision::kRefined && !iterative_; }
  double held_value(const SourceAnchors::Anchor& anchor) const;

  std::shared_ptr<const Domain> domain_;
  std::shared_ptr<const LinearSystem> neumann_, dirichlet_;  ///< those the rule needs
  PerComponent t_ = 0, consistent_share_ = 0;
  BoundaryRule boundary_ = BoundaryRule::kNeumann;
  bool iterative_ = false;
  Precision precision_ = Precision::kCompact;
};

}  // namespace geotherm
