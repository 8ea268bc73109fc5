// SPDX-License-Identifier: MIT
#include "solver/heat/component_times.h"

#include <algorithm>
#include <cmath>

#include "solver/core/number_text.h"

namespace geotherm {
namespace {

double unit_time(const Surface& surface, const ComponentSize& size, const TimeStep& step) {
  switch (step.rule) {
    case TimeRule::kMeanEdge:
      return step.factor * size.grading * size.mean_edge * size.mean_edge;
    case TimeRule::kMeanFaceArea:
      return step.factor * size.grading * size.area / static_cast<double>(size.faces);
    case TimeRule::kAbsolute:
      break;
  }
  return step.absolute / surface.mean_edge / surface.mean_edge;
}

}  // namespace

Result<DiffusionTimes> diffusion_times(const Surface& surface, const TimeStep& step) {
  std::vector<double> t, relative;
  std::size_t largest = 0;
  for (std::size_t c = 0; c < surface.components.size(); ++c) {
    const ComponentSize& size = surface.components[c];
    if (size.faces > surface.components[largest].faces) largest = c;
    t.push_back(unit_time(surface, size, step));
    relative.push_back(t.back() / size.mean_edge / size.mean_edge);
    const auto usable = [](double each) { return each > 0 && std::isfinite(each); };
    if (usable(t.back()) && usable(relative.back())) continue;
    return Error{ErrorCode::kBadInput,
                 "the diffusion time is " + rounded_text(relative.back()) +
                     " squared mean edges, where an edge is " +
                     rounded_text(size.mean_edge * surface.mean_edge) + " long",
                 {"choose one near 1"}};
  }
  const double edge = surface.mean_edge;
  DiffusionTimes out;
  out.relative_t = relative[largest];
  out.grading = surface.components[largest].grading;
  out.model_t = step.rule == TimeRule::kAbsolute ? step.absolute : t[largest] * edge * edge;
  out.extreme =
      *std::ranges::max_element(relative, {}, [](double each) { return std::abs(std::log(each)); });
  out.t = PerComponent(std::move(t));
  out.relative = PerComponent(std::move(relative));
  return out;
}

/// The expansion behind it holds from t = 0.8 h^2 and fails below; at 0.2 h^2 the lumped mass is
/// better (measured).
PerComponent consistent_share(Variant variant, const PerComponent& relative_t) {
  if (variant == Variant::kClassic) return 0.0;
  return relative_t.map([](double t) { return 0.5 * std::clamp((t - 0.2) / 0.6, 0.0, 1.0); });
}

}  // namespace geotherm
