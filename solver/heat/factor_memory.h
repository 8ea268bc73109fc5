// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string_view>

#include "geotherm/backend.h"
#include "geotherm/error.h"
#include "geotherm/options.h"
#include "geotherm/types.h"

namespace geotherm {

/// How the factor of the heat step is kept: the heat falls by hundreds of decades.
inline FactorStorage heat_storage(Precision precision) {
  return precision == Precision::kFull ? FactorStorage::kFull : FactorStorage::kWideExponent;
}

/// How that of the Poisson step is kept: distances are within a few decades of each other.
inline FactorStorage poisson_storage(Precision precision) {
  return precision == Precision::kFull ? FactorStorage::kFull : FactorStorage::kSingle;
}

inline bool same_factors(Precision a, Precision b) {
  return heat_storage(a) == heat_storage(b) && poisson_storage(a) == poisson_storage(b);
}

/// The factors that a method needs.
struct FactorPlan {
  int factors = 2;  ///< that it will hold
  int missing = 2;  ///< of those, that are still to be made
  int at_once = 1;  ///< of the missing, made side by side
};

/// `kept`: the rule whose factors of the heat step are there already. With several threads both
/// steps are set up at once.
FactorPlan plan_factors(BoundaryRule rule, std::optional<BoundaryRule> kept, bool poisson_kept,
                        int threads);

/// Says no before the memory ends. With `limit_mb` > 0 (in 2^20 bytes) all factors and the working
/// space of those that are made must stay below it; otherwise what is still missing must fit into
/// free_memory(). Factors are as large as the precision has the larger kind. What holds no factor
/// always fits. Error kOutOfMemory, with what is needed, what there is, and the remedy.
Result<void> check_factor_memory(const Analysis& analysis, std::string_view backend,
                                 Precision precision, const FactorPlan& plan, double limit_mb);

/// How many faces there are when each has been cut into four so often. More than 16 times count as
/// 16, which makes more faces than can be numbered already.
inline std::int64_t refined_faces(Index faces, int times) {
  return std::int64_t{faces} << (2 * std::clamp(times, 0, 16));
}

/// Memory at the peak of reading a closed surface of so many vertices, setting the heat method up
/// and one query: the power law through what was measured.
double heat_peak_bytes(double vertices);

/// The memory at the peak of the same for a mesh that was refined to so many faces.
double refined_bytes(std::int64_t faces);

/// Whether a mesh whose faces are each cut into four `refine` times fits into the memory that is
/// free. More faces than can be numbered are left to subdivide(), which refuses them. Errors:
/// kOutOfMemory, with the largest `refine` that fits.
Result<void> check_refined_memory(Index faces, int refine);

}  // namespace geotherm
