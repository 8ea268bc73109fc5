// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "solver/heat/linear_system.h"

namespace geotherm {

/// Held vertices beyond this many are solved by a numeric factorisation of their own instead of a
/// dense Schur complement on the shared factor.
inline constexpr std::size_t kMaxSchurRows = 128;

/// What solving for phi did.
struct PoissonAnswer {
  /// n x K, not normalised except under kPinSources: there phi, or phi + shift, is each anchor's
  /// offset.
  Block phi;
  Block shift{};  ///< components x K, still to be added to phi; empty: nothing
  int iterations = 0;
};

/// L phi = b under a constraint mode: the transformations of operator, right side and answer that
/// make the singular system solvable, whatever the backend. docs/numerics.md has the derivations.
class PoissonSolver {
 public:
  /// One pinned factor serves all modes; iterative backends get the singular operator where the
  /// mode allows it, since pinning hurts their convergence. `progress` is asked before the
  /// factorisation. `earlier`: of a domain from which this one has moved, or null. Errors: the
  /// backend's; kBadInput when the pin vertex does not exist; kCancelled.
  static Result<std::shared_ptr<const PoissonSolver>> build(std::shared_ptr<const Domain> domain,
                                                            const Constraint& constraint,
                                                            bool iterative, Precision precision,
                                                            const PoissonSolver* earlier,
                                                            int threads,
                                                            const Progress& progress = {});

  /// The same system under another mode and precision; null when these need another factor.
  std::shared_ptr<const PoissonSolver> with(const Constraint& constraint,
                                            Precision precision) const;

  /// b: n x K, one anchor list a column. `progress` is asked before each factorisation and solve,
  /// and by an iterative backend within. Errors: the backend's, kCancelled.
  Result<PoissonAnswer> solve(Block b, std::span<const SourceAnchors> anchors,
                              const Workspace& work, const Progress& progress = {}) const;

  /// True when a query with these sources makes a factor of its own.
  bool needs_own_system(const SourceAnchors& anchors) const {
    return constraint_.mode == ConstraintMode::kPinSources &&
           (iterative_ || anchors.anchors.size() > kMaxSchurRows);
  }

  FactorStats stats() const { return system_->factor().stats(); }
  const Constraint& constraint() const { return constraint_; }

 private:
  Result<PoissonAnswer> solve_as_given(Block b, std::span<const SourceAnchors> anchors,
                                       const Workspace& work, const Progress& progress) const;
  PoissonSolver() = default;
  Result<PoissonAnswer> solve_pinned(Block b, const Workspace& work,
                                     const Progress& progress) const;
  Result<PoissonAnswer> solve_held(const Block& b, std::span<const SourceAnchors> anchors,
                                   const Workspace& work, const Progress& progress) const;
  Result<PoissonAnswer> solve_schur(Block b, std::span<const SourceAnchors> anchors,
                                    const Workspace& work, const Progress& progress) const;

  std::shared_ptr<const Domain> domain_;
  std::shared_ptr<const LinearSystem> system_;
  Constraint constraint_;
  Precision precision_ = Precision::kCompact;
  bool iterative_ = false;
};

}  // namespace geotherm
