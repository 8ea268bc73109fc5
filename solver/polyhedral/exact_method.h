// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "solver/method/distance_method.h"
#include "solver/polyhedral/wave_surface.h"

namespace geotherm {

/// Exact polyhedral distance by window propagation, to round-off: all source kinds, offsets, labels
/// (docs/numerics.md, "Exact"). Quality figures: max_source_distance (0 but for round-off: a source
/// starts at its offset and can only fall) and eikonal_error_mean alone. Beside the errors of every
/// method, a query ends with kOutOfMemory or kBudgetEnded where windows multiply without end: where
/// those of one solve_each() fill 1.5 GiB, of which each set that is solved at once has its share.
/// Cost: 15 to 60 windows a face on ordinary models, a few on planes. Sources: Mitchell, Mount,
/// Papadimitriou 1987; Chen, Han 1990; Xin, Wang 2009.
class ExactMethod final : public DistanceMethod {
 public:
  /// Errors: kCancelled, kOutOfMemory. Cost: O(F). Source sets are solved on `threads` threads,
  /// each on one.
  static Result<std::shared_ptr<const ExactMethod>> build(
      std::shared_ptr<const WaveSurface> surface, int threads = 0, const Progress& progress = {});

  ~ExactMethod() override;
  MethodKind kind() const override { return MethodKind::kExact; }
  Result<std::vector<DistanceResult>> solve_each(std::span<const SourceSet> sets,
                                                 const QueryOptions& query = {},
                                                 const Progress& progress = {}) const override;
  const SetupTiming& timing() const override;
  double memory_mb() const override;
  const std::vector<Warning>& warnings() const override;

 private:
  struct State;
  explicit ExactMethod(std::unique_ptr<const State> state);
  std::unique_ptr<const State> state_;
};

}  // namespace geotherm
