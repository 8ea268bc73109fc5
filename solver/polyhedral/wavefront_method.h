// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "solver/method/distance_method.h"
#include "solver/polyhedral/wave_surface.h"

namespace geotherm {

/// Near-exact distance by waves over the edges of the intrinsic Delaunay triangulation, each fitted
/// from the distances at an edge's ends and at samples between them (docs/numerics.md,
/// "Wavefront"). Quality figures: max_source_distance (0 but for round-off: a source starts at its
/// offset and can only fall) and eikonal_error_mean alone. A query ends with kBudgetEnded
/// where values would fall for ever.
class WavefrontMethod final : public DistanceMethod {
 public:
  /// Samples inside an edge: its midpoint, or its quarter points.
  enum class Samples { kMidpoint, kQuarters };

  /// Errors: those of build_wave_surface(). Cost: O(F + flips).
  static Result<std::shared_ptr<const WavefrontMethod>> build(
      std::shared_ptr<const WaveSurface> surface, Samples samples, int threads = 0,
      const Progress& progress = {});

  ~WavefrontMethod() override;
  MethodKind kind() const override;
  Result<std::vector<DistanceResult>> solve_each(std::span<const SourceSet> sets,
                                                 const QueryOptions& query = {},
                                                 const Progress& progress = {}) const override;
  const SetupTiming& timing() const override;
  double memory_mb() const override;
  const std::vector<Warning>& warnings() const override;

 private:
  struct State;
  explicit WavefrontMethod(std::unique_ptr<const State> state);
  std::unique_ptr<const State> state_;
};

}  // namespace geotherm
