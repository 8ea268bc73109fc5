// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "geotherm/domains.h"

namespace geotherm {
namespace {

/// Whether the sample and one beside it pass: whether it is a vertex of a cell.
bool has_neighbor(const Grid& grid, Index sample) {
  if (!(grid.speed(sample) > 0)) return false;
  const auto at = grid.place(sample);
  for (std::size_t e = 0; e < 3; ++e) {
    for (const Index step : {-1, 1}) {
      auto next = at;
      next[e] += step;
      if (next[e] < 0 || next[e] >= grid.size[e]) continue;
      if (grid.speed(grid.number(next)) > 0) return true;
    }
  }
  return false;
}

ClosestGridPoint nearest_sample(const Grid& grid, const Vec3& query) {
  ClosestGridPoint best{kNoIndex, {}, kUnreached};
  for (Index v = 0; v < grid.sample_count(); ++v) {
    const double distance = (grid.position(v) - query).norm();
    if (distance < best.distance && has_neighbor(grid, v)) best = {v, {}, distance};
  }
  return best;
}

}  // namespace

Result<ClosestGridPoint> closest_point(const Grid& grid, const Vec3& query) {
  if (auto valid = check_grid(grid); !valid) return valid.error();
  if (!query.allFinite()) {
    return Error{ErrorCode::kBadInput, "a coordinate of the point is not finite"};
  }
  std::array<Index, 3> lowest{};
  std::array<double, 3> share{};
  double outside = 0;  // the square of the way to the box
  for (int e = 0; e < 3; ++e) {
    const double last = grid.size[e] - 1;
    const double along = (query[e] - grid.origin[e]) / grid.spacing[e];
    const double inside = std::clamp(along, 0.0, last);
    outside += std::pow((along - inside) * grid.spacing[e], 2);
    lowest[e] = static_cast<Index>(std::min(std::floor(inside), std::max(0.0, last - 1)));
    share[e] = inside - lowest[e];
  }
  ClosestGridPoint out{kNoIndex, {grid.number(lowest), {}}, std::sqrt(outside)};
  for (int k = 0; k < 8; ++k) {
    auto corner = lowest;
    double weight = 1;
    bool there = true;
    for (int e = 0; e < 3; ++e) {
      const bool far = (k >> e & 1) != 0;
      there = there && !(far && grid.size[e] == 1);
      corner[e] += far ? 1 : 0;
      weight *= far ? share[e] : 1 - share[e];
    }
    if (!there) continue;
    const Index sample = grid.number(corner);
    if (weight == 1 && has_neighbor(grid, sample))
      return ClosestGridPoint{sample, {}, out.distance};
    if (!(grid.speed(sample) > 0)) return nearest_sample(grid, query);
    out.in_cell.weights.push_back(weight);
  }
  return out;
}

}  // namespace geotherm
