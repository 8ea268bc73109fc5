// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "solver/core/progress.h"
#include "solver/core/result.h"
#include "solver/heat/distance_result.h"
#include "solver/heat/heat_options.h"
#include "solver/mesh/surface_point.h"
#include "solver/mesh/triangle_mesh.h"

namespace geotherm {

/// What a query computes beside the distances.
struct QueryOptions {
  bool quality = true;  ///< the quality figures: two matrix products and a pass over the faces
  bool fields = false;  ///< u (DistanceResult::heat and log_heat)
};

/// Geodesic distance by the heat method (Crane, Weischedel, Wardetzky 2013): solve
/// (A + t L) u = u0, take X = -grad u / |grad u| on each face, solve L phi = div-form of X.
///
/// build() does everything that does not depend on the sources; solve() then costs two pairs of
/// triangular solves and one pass over the faces. Immutable: solve() may be called from several
/// threads at once. with() gives a method with other options that shares whatever stays the same:
/// the symbolic analysis always (unless backend or Laplacian change), a factor where its matrix is
/// the same.
///
/// Progress: set-up asks between operators, flips, analysis and factorisations, but a numeric
/// factorisation (the backend's library) cannot be interrupted: up to some seconds at a million
/// faces. A query asks between its steps, and within an iterative backend every few milliseconds.
/// Calls come from any thread of the work, one at a time, and none after the first that returned
/// false. What was cancelled leaves no trace: the method answers as before.
class HeatMethod {
 public:
  /// Errors: kNotAvailable (backend), kBadInput (options, a mesh without area), kNumericalFailure
  /// (with the column or residual), kOutOfMemory, kCancelled.
  static Result<HeatMethod> build(std::shared_ptr<const TriangleMesh> mesh,
                                  const HeatOptions& options = {}, const Progress& progress = {});

  /// The same mesh with other options. Cost: what the change needs, nothing for sources' sake.
  Result<HeatMethod> with(const HeatOptions& options, const Progress& progress = {}) const;

  /// Distance to the nearest source. Errors: kBadInput (no source, a vertex or face out of range,
  /// weights that are negative or do not sum to 1), kBudgetEnded, kNumericalFailure, kCancelled.
  Result<DistanceResult> solve(const SourceSet& sources, const QueryOptions& query = {},
                               const Progress& progress = {}) const;

  /// One result per source set, as one blocked solve.
  Result<std::vector<DistanceResult>> solve_each(std::span<const SourceSet> sets,
                                                 const QueryOptions& query = {},
                                                 const Progress& progress = {}) const;

  const HeatOptions& options() const;
  double t() const;                                  ///< diffusion time, model units squared
  LaplacianKind laplacian() const;                   ///< what kAuto became
  Index flips() const;                               ///< Delaunay edge flips made
  const SetupTiming& timing() const;                 ///< of build() or of the with() that made this
  double factor_mb() const;                          ///< memory of all factors, in 2^20 bytes
  const std::vector<std::string>& warnings() const;  ///< about mesh and options, one sentence each

 private:
  struct State;
  explicit HeatMethod(std::shared_ptr<const State> state) : state_(std::move(state)) {}
  std::shared_ptr<const State> state_;
};

}  // namespace geotherm
