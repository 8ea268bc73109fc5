// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "solver/method/distance_method.h"
#include "solver/wave/wave_surface.h"

namespace geotherm {

/// Exact polyhedral distance by window propagation.
class ExactMethod final : public DistanceMethod {
 public:
  static Result<std::shared_ptr<const ExactMethod>> build(
      std::shared_ptr<const WaveSurface> surface, int threads = 0, const Progress& progress = {});

  ~ExactMethod() override;
  MethodKind kind() const override { return MethodKind::kExact; }
  Result<std::vector<DistanceResult>> solve_each(std::span<const SourceSet> sets,
                                                 const QueryOptions& query = {},
                                                 const Progress& progress = {}) const override;
  const SetupTiming& timing() const override;
  double memory_mb() const override;
  const std::vector<std::string>& warnings() const override;

 private:
  struct State;
  explicit ExactMethod(std::unique_ptr<const State> state);
  std::unique_ptr<const State> state_;
};

}  // namespace geotherm
