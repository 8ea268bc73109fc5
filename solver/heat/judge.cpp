// SPDX-License-Identifier: MIT
#include "solver/heat/judge.h"

#include <algorithm>
#include <cmath>

#include "solver/core/number_text.h"
#include "solver/method/distance_bounds.h"

namespace geotherm {
namespace {

/// Residuals above the first are worth a word: backends reach 1e-9 and better. Above the second
/// there is no solution; the penalty mode, which is wrong by design, comes to some 1e-3.
constexpr double kSuspiciousResidual = 1e-6;
/// Compact factors leave what their rounding times the range of phi in mean edges is: 1e-4 at four
/// million faces, with distances right to 1e-7.
constexpr double kSuspiciousOfCompact = 1e-3;
constexpr double kUselessResidual = 0.1;
/// Times beyond these, in squares of the mean edge, may be why a system could not be solved.
constexpr double kLargeTime = 1e3;
constexpr double kSmallTime = 1e-3;
/// A mean error of the slope that no good distance has: at usual times it is below 0.1, and the
/// smoothest useful distances have some 0.3.
constexpr double kWrongSlope = 0.4;
/// Faces within a Dirichlet border, whose corners are all held, are no loss in a corner or two.
/// Above this share of all faces they are.
constexpr double kBorderShare = 0.1;

/// `words`, and the setting that t follows from.
Hint time_hint(const std::string& words, TimeRule rule) {
  if (rule == TimeRule::kAbsolute) return {words, SettingHint{"time-step"}, " absolute:T"};
  return {words, SettingHint{"time-factor"}};
}

Hint other_border() { return {"use ", SettingHint{"boundary", {"neumann", "average"}}}; }

std::string share(Index count, std::size_t of) {
  return "(" + rounded_text(100.0 * count / static_cast<double>(std::max<std::size_t>(of, 1))) +
         " %)";
}

void add_lost_faces(const HeatOptions& options, const FaceCounts& faces, DistanceResult& result) {
  const bool dirichlet = options.boundary == BoundaryRule::kDirichlet;
  const bool mostly_border = dirichlet && faces.without_direction > kBorderShare * faces.in_reach;
  const Index lost = mostly_border ? faces.without_direction : result.quality.zero_gradient_faces;
  if (lost == 0) return;
  result.warnings.push_back(
      {"the heat has no direction on " + std::to_string(lost) + " of " +
           std::to_string(faces.in_reach) + " faces " +
           share(lost, static_cast<std::size_t>(faces.in_reach)) +
           (dirichlet ? ": the border, held at 0, cuts them off"
                      : ", distances there follow their surroundings"),
       dirichlet ? other_border() : time_hint("raise ", options.time_step.rule)});
}

void add_clamped_vertices(const HeatOptions& options, DistanceResult& result) {
  const Index clamped = result.quality.clamped_vertices;
  if (clamped == 0) return;
  const auto reached =
      std::ranges::count_if(result.distances, [](double d) { return d < kUnreached; });
  Warning warning{counted_text(static_cast<std::size_t>(clamped), "vertex ", "vertices ") +
                  share(clamped, static_cast<std::size_t>(reached)) +
                  " had a distance below 0, which was set to 0"};
  if (options.boundary == BoundaryRule::kDirichlet) {
    warning.hint = other_border();
  } else if (options.constraint.mode != ConstraintMode::kPinSources) {
    warning.hint = {SettingHint{"constraint", {"pin-sources"}}, " holds every source at 0"};
  } else {
    warning.message +=
        ": the heat carries no information there, and distances around them are too short, up to " +
        rounded_text(result.quality.clamped_reach) + " from the sources in a straight line";
    warning.hint = {"use ", SettingHint{"method", {"wavefront"}}};
  }
  result.warnings.push_back(std::move(warning));
}

}  // namespace

bool is_extreme_time(double unit_t) { return unit_t > kLargeTime || unit_t < kSmallTime; }

Error with_time_cure(Error error, double unit_t, TimeRule rule) {
  const bool numerical =
      error.code == ErrorCode::kNumericalFailure || error.code == ErrorCode::kBudgetEnded;
  if (!numerical || !is_extreme_time(unit_t)) return error;
  const std::string words = "t is " + rounded_text(unit_t) + " squared mean edges, so try a " +
                            (unit_t > 1 ? "smaller " : "larger ");
  const Hint time = time_hint((error.hint.empty() ? "" : "; ") + words, rule);
  error.hint.insert(error.hint.end(), time.begin(), time.end());
  error.hint.emplace_back(" first");
  return error;
}

Result<void> judge(const HeatOptions& options, double unit_t, const FaceCounts& faces,
                   DistanceResult& result) {
  const Quality& q = result.quality;
  add_lost_faces(options, faces, result);
  add_clamped_vertices(options, result);
  add_bound_warnings(MethodKind::kHeat, result);
  for (const bool heat : {true, false}) {
    const double residual = heat ? q.heat_residual : q.poisson_residual;
    const bool compact = options.precision == Precision::kCompact && q.iterations_poisson == 0;
    if (residual <= (compact ? kSuspiciousOfCompact : kSuspiciousResidual))
      continue;  // false for what is no number
    const std::string text = std::string("the ") + (heat ? "heat" : "Poisson") +
                             " system was solved to a residual of " + rounded_text(residual) +
                             " only";
    const bool by_design = !heat && options.constraint.mode == ConstraintMode::kPenalty;
    if (!std::isfinite(residual) || (residual > kUselessResidual && !by_design)) {
      const Hint others = {"try another backend or ",
                           SettingHint{"laplacian", {"intrinsic-delaunay"}}};
      return with_time_cure({ErrorCode::kNumericalFailure, text + ", which is no solution",
                             is_extreme_time(unit_t) ? Hint() : others},
                            unit_t, options.time_step.rule);
    }
    result.warnings.push_back({text});
  }
  if (q.eikonal_error_mean > kWrongSlope) {
    result.warnings.push_back(
        {"the slope of the distance is off by " + rounded_text(q.eikonal_error_mean) +
             " on average, where 1 is right (t is " + rounded_text(unit_t) + " squared mean edges)",
         unit_t > 1 ? time_hint("use a smaller ", options.time_step.rule)
                    : Hint{"refine the mesh"}});
  }
  return {};
}

}  // namespace geotherm
