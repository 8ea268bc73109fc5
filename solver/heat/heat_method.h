// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "solver/core/progress.h"
#include "solver/core/result.h"
#include "solver/heat/heat_options.h"
#include "solver/mesh/surface_point.h"
#include "solver/mesh/triangle_mesh.h"
#include "solver/method/distance_method.h"

namespace geotherm {

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
class HeatMethod final : public DistanceMethod {
 public:
  /// Errors: kNotAvailable (backend), kBadInput (options, a mesh without area), kNumericalFailure
  /// (with the column or residual), kOutOfMemory, kCancelled.
  static Result<HeatMethod> build(std::shared_ptr<const TriangleMesh> mesh,
                                  const HeatOptions& options = {}, const Progress& progress = {});

  /// The same mesh with other options. Cost: what the change needs, nothing for sources' sake.
  Result<HeatMethod> with(const HeatOptions& options, const Progress& progress = {}) const;

  MethodKind kind() const override { return MethodKind::kHeat; }

  /// As one blocked solve. Quality costs two matrix products and a pass over the faces. Offsets of
  /// sources are refused (kBadInput).
  Result<std::vector<DistanceResult>> solve_each(std::span<const SourceSet> sets,
                                                 const QueryOptions& query = {},
                                                 const Progress& progress = {}) const override;

  const HeatOptions& options() const;
  double t() const;                            ///< diffusion time, model units squared
  LaplacianKind laplacian() const;             ///< what kAuto became
  Index flips() const;                         ///< Delaunay edge flips made
  const SetupTiming& timing() const override;  ///< of build() or of the with() that made this
  double memory_mb() const override;           ///< of all factors
  const std::vector<std::string>& warnings() const override;
  const HeatMethod* heat() const override { return this; }

 private:
  struct State;
  explicit HeatMethod(std::shared_ptr<const State> state) : state_(std::move(state)) {}
  std::shared_ptr<const State> state_;
};

}  // namespace geotherm
