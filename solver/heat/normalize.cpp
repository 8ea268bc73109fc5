// SPDX-License-Identifier: MIT
#include "solver/heat/normalize.h"

#include <algorithm>
#include <cmath>

namespace geotherm {
namespace {

/// Of the largest distance: values below 0 by less are what solvers leave of a 0.
constexpr double kRoundOff = 1e-6;

/// What must be added to phi on every component: 0 where no source is.
std::vector<double> shifts(const Surface& surface, std::span<const double> phi,
                           const SourceAnchors& anchors) {
  const Components& components = surface.operators->components;
  std::vector<double> sum(static_cast<std::size_t>(components.count), 0.0);
  std::vector<Index> count(sum.size(), 0);
  for (const auto& anchor : anchors.anchors) {
    sum[components.of[anchor.row]] += anchor.offset - phi[anchor.row];
    ++count[components.of[anchor.row]];
  }
  for (std::size_t c = 0; c < sum.size(); ++c) {
    if (count[c] > 0) sum[c] /= count[c];
  }
  return sum;
}

}  // namespace

Result<void> normalize(const Surface& surface, std::span<double> phi, const SourceAnchors& anchors,
                       ConstraintMode mode, DistanceResult& result) {
  const Components& components = surface.operators->components;
  const double unit = surface.intrinsic.unit;
  const bool pinned = mode == ConstraintMode::kPinSources;
  if (!pinned) {
    const std::vector<double> shift = shifts(surface, phi, anchors);
    for (std::size_t i = 0; i < phi.size(); ++i) phi[i] += shift[components.of[i]];
  }
  for (const auto& anchor : anchors.anchors) {
    const double off = std::abs(phi[anchor.row] - anchor.offset) * unit;
    if (!(off <= result.quality.max_source_distance)) result.quality.max_source_distance = off;
    if (pinned) phi[anchor.row] = anchor.offset;  // held: what was off is the solve's round-off
  }
  std::vector<char> holds(static_cast<std::size_t>(components.count), 0);
  for (const Index c : anchors.components) holds[c] = 1;
  result.distances.assign(static_cast<std::size_t>(surface.mesh->vertex_count()), kUnreached);
  double most = 0;
  for (std::size_t i = 0; i < phi.size(); ++i) {
    if (!holds[components.of[i]]) continue;
    if (!std::isfinite(phi[i] * unit)) {
      return Error{ErrorCode::kNumericalFailure,
                   "the distance of vertex " + std::to_string(surface.vertex_of_row[i]) +
                       " is not finite; try another backend or --laplacian "
                       "intrinsic-delaunay"};
    }
    most = std::max(most, phi[i]);
    result.distances[surface.vertex_of_row[i]] = std::max(phi[i], 0.0) * unit;
  }
  for (std::size_t i = 0; i < phi.size(); ++i) {
    result.quality.clamped_vertices += holds[components.of[i]] && phi[i] < -kRoundOff * most;
  }
  return {};
}

std::vector<double> heat_in_file_order(const Surface& surface, const HeatField& heat,
                                       Eigen::Index column) {
  std::vector<double> out(static_cast<std::size_t>(surface.mesh->vertex_count()), 0.0);
  const double largest = heat.u.col(column).cwiseAbs().maxCoeff();
  for (Eigen::Index i = 0; i < heat.u.rows(); ++i) {
    const bool far =
        !heat.level.empty() && heat.level[static_cast<std::size_t>(i * heat.u.cols() + column)] > 0;
    if (!far && largest > 0) out[surface.vertex_of_row[i]] = heat.u(i, column) / largest;
  }
  return out;
}

std::vector<double> log_heat_in_file_order(const Surface& surface, const HeatField& heat,
                                           Eigen::Index column) {
  std::vector<double> out(static_cast<std::size_t>(surface.mesh->vertex_count()), -kUnreached);
  const double largest = std::log(heat.u.col(column).cwiseAbs().maxCoeff());
  const double step = std::log(heat.step);
  for (Eigen::Index i = 0; i < heat.u.rows(); ++i) {
    if (!(heat.u(i, column) > 0)) continue;
    const int level =
        heat.level.empty() ? 0 : heat.level[static_cast<std::size_t>(i * heat.u.cols() + column)];
    out[surface.vertex_of_row[i]] = std::log(heat.u(i, column)) + level * step - largest;
  }
  return out;
}

}  // namespace geotherm
