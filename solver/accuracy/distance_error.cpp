// SPDX-License-Identifier: MIT
#include "geotherm/accuracy.h"

#include <algorithm>
#include <cmath>

namespace geotherm {
namespace {

/// Distances below this share of the largest one are sources, up to round-off.
constexpr double kAtSource = 1e-12;

}  // namespace

DistanceError distance_error(std::span<const double> d, std::span<const double> e) {
  DistanceError error;
  double range = 0, relative = 0, sum = 0, most = -1;
  Index count = 0, positive = 0;
  for (const double x : e) {
    if (std::isfinite(x)) range = std::max(range, x);
  }
  for (std::size_t i = 0; i < e.size(); ++i) {
    if (std::isfinite(d[i]) != std::isfinite(e[i])) ++error.differently_reached;
    if (!std::isfinite(d[i]) || !std::isfinite(e[i])) continue;
    const double off = d[i] - e[i];
    sum += off;
    ++count;
    if (std::abs(off) > most) {
      most = std::abs(off);
      error.worst = static_cast<Index>(i);
    }
    if (e[i] > kAtSource * range) {
      relative += std::abs(off) / e[i];
      ++positive;
    }
  }
  if (count == 0) return error;
  error.max = most;
  error.mean_signed = sum / count;
  if (positive > 0) error.mean_relative = relative / positive;
  if (range > 0) error.max_of_range = most / range;
  return error;
}

JointError joint_error(std::span<const std::vector<double>> d,
                       std::span<const std::vector<double>> e) {
  JointError joint;
  DistanceError& all = joint.figures;
  double count = 0;
  for (std::size_t i = 0; i < d.size(); ++i) {
    const DistanceError one = distance_error(d[i], e[i]);
    all.differently_reached += one.differently_reached;
    if (one.worst == kNoIndex) continue;
    ++count;
    all.mean_relative += (one.mean_relative - all.mean_relative) / count;
    all.mean_signed += (one.mean_signed - all.mean_signed) / count;
    if (all.worst != kNoIndex && one.max_of_range <= all.max_of_range) continue;
    all.max_of_range = one.max_of_range;
    all.max = one.max;
    all.worst = one.worst;
    joint.worst_set = i;
  }
  return joint;
}

Grade grade_of(const DistanceError& error) {
  if (error.max_of_range > kMaxOfRange || error.differently_reached > 0) return Grade::kPoor;
  if (error.mean_relative <= kNearExactError) return Grade::kNearExact;
  if (error.mean_relative <= kGoodError) return Grade::kGood;
  return error.mean_relative <= kFairError ? Grade::kFair : Grade::kPoor;
}

double badness(const DistanceError& error) {
  return std::max(error.mean_relative / kGoodError, error.max_of_range / kMaxOfRange);
}

std::vector<double> signed_error(std::span<const double> d, std::span<const double> e) {
  std::vector<double> out(e.size(), kUnreached);
  for (std::size_t i = 0; i < e.size(); ++i) {
    if (std::isfinite(d[i]) && std::isfinite(e[i])) out[i] = d[i] - e[i];
  }
  return out;
}

ErrorHistogram error_histogram(std::span<const double> signed_error, int bins) {
  ErrorHistogram histogram;
  histogram.count.assign(static_cast<std::size_t>(bins), 0);
  bool any = false;
  for (const double x : signed_error) {
    if (!std::isfinite(x)) continue;
    histogram.low = any ? std::min(histogram.low, x) : x;
    histogram.high = any ? std::max(histogram.high, x) : x;
    any = true;
  }
  const double width = histogram.high - histogram.low;
  for (const double x : signed_error) {
    if (!std::isfinite(x)) continue;
    const double place = width > 0 ? (x - histogram.low) / width * bins : 0;
    ++histogram.count[static_cast<std::size_t>(std::clamp(static_cast<int>(place), 0, bins - 1))];
  }
  return histogram;
}

MethodKind reference_for(MethodKind kind, Index faces) {
  constexpr Index kMaxFacesOfWindows = 200'000;  // they need some seconds there
  switch (kind) {
    case MethodKind::kExact:
      return MethodKind::kExact;
    case MethodKind::kWavefrontFine:
    case MethodKind::kHeat:
    case MethodKind::kWavefront:
    case MethodKind::kFastMarching:
      break;
  }
  return faces <= kMaxFacesOfWindows ? MethodKind::kExact : MethodKind::kWavefrontFine;
}

MethodKind usual_reference(MethodKind kind, Index faces) {
  constexpr Index kFewFaces = 1'000;
  if (!is_better(MethodKind::kWavefront, kind)) return kind;
  return faces <= kFewFaces ? MethodKind::kExact : MethodKind::kWavefront;
}

bool is_better(MethodKind a, MethodKind b) {
  const auto rank = [](MethodKind kind) {
    switch (kind) {
      case MethodKind::kHeat:
      case MethodKind::kFastMarching:
        return 0;
      case MethodKind::kWavefront:
        return 1;
      case MethodKind::kWavefrontFine:
        return 2;
      case MethodKind::kExact:
        break;
    }
    return 3;
  };
  return rank(a) > rank(b);
}

}  // namespace geotherm
