// SPDX-License-Identifier: MIT
#include "solver/heat/factor_memory.h"

#include <algorithm>
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

}  // namespace geotherm
