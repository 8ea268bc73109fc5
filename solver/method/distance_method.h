// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "solver/core/progress.h"
#include "solver/core/result.h"
#include "solver/mesh/surface_point.h"
#include "solver/method/distance_result.h"
#include "solver/method/method_kind.h"

namespace geotherm {

class HeatMethod;

/// What a query computes beside the distances.
struct QueryOptions {
  bool quality = true;   ///< the quality figures; what they cost stands at each method
  bool fields = false;   ///< u of the heat method (DistanceResult::heat and log_heat)
  bool nearest = false;  ///< DistanceResult::nearest_source, by methods that know it
};

/// Geodesic distance on one mesh, ready for sources: what every method has in common. Immutable;
/// queries may run on several threads at once.
class DistanceMethod {
 public:
  virtual ~DistanceMethod() = default;

  virtual MethodKind kind() const = 0;

  /// Distance to the nearest source. Errors: kBadInput (no source, a vertex or face out of range,
  /// weights that are negative or do not sum to 1, offsets that are negative or that the method
  /// does not know), kBudgetEnded, kNumericalFailure, kOutOfMemory, kCancelled.
  Result<DistanceResult> solve(const SourceSet& sources, const QueryOptions& query = {},
                               const Progress& progress = {}) const;

  /// One result per source set. The results do not depend on the number of threads.
  virtual Result<std::vector<DistanceResult>> solve_each(std::span<const SourceSet> sets,
                                                         const QueryOptions& query = {},
                                                         const Progress& progress = {}) const = 0;

  virtual const SetupTiming& timing() const = 0;
  virtual double memory_mb() const = 0;  ///< of factors or tables, in 2^20 bytes
  virtual const std::vector<Warning>& warnings() const = 0;  ///< about mesh and options

  /// The heat method, where it is that.
  virtual const HeatMethod* heat() const { return nullptr; }
};

}  // namespace geotherm
