// SPDX-License-Identifier: MIT
#include "solver/heat/factor_memory.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "solver/core/memory.h"
#include "solver/core/text.h"

namespace geotherm {
namespace {

constexpr double kMegabyte = 1024.0 * 1024.0;
/// As much as goes without asking the system, which takes longer than to factor a small mesh.
constexpr double kUnasked = 16 * kMegabyte;

std::string size_text(double bytes) {
  const double megabytes = bytes / kMegabyte;
  constexpr double kGigabyte = 1024;
  return megabytes < kGigabyte ? rounded_text(megabytes) + " MB"
                               : rounded_text(megabytes / kGigabyte) + " GB";
}

Error too_large(std::string_view backend, double factors, double work, int count,
                const std::string& there_is, Hint hint) {
  return {ErrorCode::kOutOfMemory,
          "needs about " + size_text(factors) + " for " +
              counted_text(static_cast<std::size_t>(count), "factor", "factors") + " and " +
              size_text(work) + " to make them, and " + there_is,
          std::move(hint), std::string(backend)};
}

bool uses_free_boundary(BoundaryRule rule) { return rule != BoundaryRule::kDirichlet; }
bool uses_held_boundary(BoundaryRule rule) { return rule != BoundaryRule::kNeumann; }

}  // namespace

FactorPlan plan_factors(BoundaryRule rule, std::optional<BoundaryRule> kept, bool poisson_kept,
                        int threads) {
  int heat = 0, missing = 0;
  for (const auto uses : {uses_free_boundary, uses_held_boundary}) {
    if (!uses(rule)) continue;
    ++heat;
    missing += !kept || !uses(*kept);
  }
  const bool both = missing > 0 && !poisson_kept;
  return {heat + 1, missing + !poisson_kept, both && threads > 1 ? 2 : 1};
}

Result<void> check_factor_memory(const Analysis& analysis, std::string_view backend,
                                 Precision precision, const FactorPlan& plan, double limit_mb) {
  const auto one = static_cast<double>(std::max(analysis.factor_bytes(heat_storage(precision)),
                                                analysis.factor_bytes(poisson_storage(precision))));
  const double work =
      static_cast<double>(analysis.work_bytes()) * std::min(plan.at_once, plan.missing);
  if (one == 0) return {};
  const bool halves = static_cast<double>(analysis.factor_bytes(FactorStorage::kSingle)) < one;
  const auto hint = [halves](Hint first) {
    if (halves) {
      first.insert(first.end(), {"use ", SettingHint{"precision", {"compact"}}, ", "});
    }
    first.insert(first.end(), {"try ", SettingHint{"backend", {"cg"}},
                               ", which holds no factor, or take a mesh with fewer faces"});
    return first;
  };
  if (limit_mb > 0) {
    const double all = one * plan.factors;
    if (all + work <= limit_mb * kMegabyte) return {};
    return too_large(backend, all, work, plan.factors,
                     "the limit is " + size_text(limit_mb * kMegabyte),
                     hint({"raise ", SettingHint{"memory-limit"}, ", "}));
  }
  const double missing = one * plan.missing;
  if (missing + work <= kUnasked) return {};
  const auto free = free_memory();
  if (!free || missing + work <= static_cast<double>(*free)) return {};
  return too_large(backend, missing, work, plan.missing,
                   size_text(static_cast<double>(*free)) + " are free",
                   hint({"close other programs, "}));
}

double heat_peak_bytes(double vertices) {
  // docs/performance.md, torus of 280k and 4.4M faces, backend native, two threads of a Xeon.
  constexpr double kSmall = 140e3, kLarge = 2.2e6;
  constexpr double kBytesOfSmall = 143 * 1048576.0, kBytesOfLarge = 2.62 * 1073741824.0;
  const double power = std::log(kBytesOfLarge / kBytesOfSmall) / std::log(kLarge / kSmall);
  return kBytesOfSmall * std::pow(vertices / kSmall, power);
}

double refined_bytes(std::int64_t faces) { return heat_peak_bytes(static_cast<double>(faces) / 2); }

Result<void> check_refined_memory(Index faces, int refine) {
  const auto free = free_memory();
  const std::int64_t cut = refined_faces(faces, refine);
  if (!free || cut > std::numeric_limits<Index>::max()) return {};
  const auto bytes_free = static_cast<double>(*free);
  if (refined_bytes(cut) <= bytes_free) return {};
  const auto megabytes = [](double bytes) { return std::to_string(std::llround(bytes / 1e6)); };
  int fits = refine - 1;
  while (fits > 0 && refined_bytes(refined_faces(faces, fits)) > bytes_free) --fits;
  return Error{ErrorCode::kOutOfMemory,
               std::to_string(faces) + " faces, each cut into four " + std::to_string(refine) +
                   " times, are " + std::to_string(cut) + " and take " +
                   megabytes(refined_bytes(cut)) + " MB or so, and " + megabytes(bytes_free) +
                   " MB are free",
               {"set ", SettingHint{"refine", {std::to_string(fits)}}}};
}

}  // namespace geotherm
