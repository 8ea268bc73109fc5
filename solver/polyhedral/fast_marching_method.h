// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "solver/method/distance_method.h"
#include "solver/polyhedral/wave_surface.h"

namespace geotherm {

/// First-order fast marching with planar updates and unfolded supports at obtuse angles (Kimmel,
/// Sethian 1998), on the intrinsic Delaunay triangulation: the classic to compare with. Quality
/// figures: those of WavefrontMethod.
class FastMarchingMethod final : public DistanceMethod {
 public:
  static Result<std::shared_ptr<const FastMarchingMethod>> build(
      std::shared_ptr<const WaveSurface> surface, int threads = 0, const Progress& progress = {});

  ~FastMarchingMethod() override;
  MethodKind kind() const override { return MethodKind::kFastMarching; }
  Result<std::vector<DistanceResult>> solve_each(std::span<const SourceSet> sets,
                                                 const QueryOptions& query = {},
                                                 const Progress& progress = {}) const override;
  const SetupTiming& timing() const override;
  double memory_mb() const override;
  const std::vector<Warning>& warnings() const override;

 private:
  struct State;
  explicit FastMarchingMethod(std::unique_ptr<const State> state);
  std::unique_ptr<const State> state_;
};

}  // namespace geotherm
