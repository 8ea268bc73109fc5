// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <mutex>
#include <span>

#include "solver/core/parallel.h"
#include "solver/linear/multifrontal/separator.h"

namespace geotherm {
namespace {

constexpr int kMaxBins = 512;
/// A direction along which a part has less than this share of its greatest extent is left out.
constexpr float kThin = 0.3F;
/// The same for a direction with next to no extent, whose inverse would overflow.
constexpr float kShortest = 1e-30F;

constexpr std::int64_t kVerticesAPiece = 20'000;

using Point = std::array<float, 3>;

constexpr float kRootHalf = 0.70710678F;
constexpr std::array<Point, 9> kDirections = {{{1, 0, 0},
                                               {0, 1, 0},
                                               {0, 0, 1},
                                               {kRootHalf, kRootHalf, 0},
                                               {kRootHalf, -kRootHalf, 0},
                                               {kRootHalf, 0, kRootHalf},
                                               {kRootHalf, 0, -kRootHalf},
                                               {0, kRootHalf, kRootHalf},
                                               {0, kRootHalf, -kRootHalf}}};

float along(const Point& p, const Point& direction) {
  return p[0] * direction[0] + p[1] * direction[1] + p[2] * direction[2];
}

/// Directions that are swept together: the 16-bit numbers of the narrowest register.
constexpr std::size_t kLanes = 8;
using PerLane = std::array<float, kLanes>;

/// A bin along each direction.
struct Bins {
  using Register [[gnu::vector_size(16)]] = std::int16_t;
  Register lanes;

  int operator[](std::size_t lane) const { return lanes[lane]; }
};

/// The extent of a part along a direction.
struct Extent {
  Point direction{};
  float low = 0, high = 0;
  float length() const { return high - low; }
};

/// The directions that are swept, axes first, at most kLanes: where the part is thin along an axis,
/// a diagonal between this axis and another is as good as the other axis. `thin_share`: kThin, or 0
/// for all directions.
std::vector<Extent> find_extents(const GraphPart& part, float thin_share, int threads) {
  constexpr std::size_t kCount = kDirections.size();
  std::array<float, kCount> low, high;
  const auto clear = [](std::array<float, kCount>& lowest, std::array<float, kCount>& highest) {
    lowest.fill(std::numeric_limits<float>::max());
    highest.fill(-std::numeric_limits<float>::max());
  };
  clear(low, high);
  std::mutex mutex;
  parallel_for(threads, part.size(), kVerticesAPiece, [&](std::int64_t begin, std::int64_t end) {
    std::array<float, kCount> lowest, highest;
    clear(lowest, highest);
    for (std::int64_t i = begin; i < end; ++i) {
      for (std::size_t d = 0; d < kCount; ++d) {
        const float at = along(part.position[i], kDirections[d]);
        lowest[d] = std::min(lowest[d], at);
        highest[d] = std::max(highest[d], at);
      }
    }
    const std::lock_guard lock(mutex);
    for (std::size_t d = 0; d < kCount; ++d) {
      low[d] = std::min(low[d], lowest[d]);
      high[d] = std::max(high[d], highest[d]);
    }
  });
  const float longest = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
  const auto thin = [&](std::size_t d) {
    const float length = high[d] - low[d];
    return !(length > kShortest) || length < thin_share * longest;
  };
  std::vector<Extent> out;
  for (std::size_t d = 0; d < kCount; ++d) {
    bool useful = !thin(d);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      useful = useful && !(kDirections[d][axis] != 0 && thin(axis));
    }
    if (useful) out.push_back({kDirections[d], low[d], high[d]});
  }
  if (out.size() > kLanes)
    out.erase(std::ranges::min_element(out.begin() + 3, out.end(), {}, &Extent::length));
  return out;
}

/// For each vertex and direction the bin that it lies in, and the lowest and highest bin of it and
/// its neighbours.
struct Reaches {
  std::vector<Bins> own, lowest, highest;
  std::size_t size() const { return own.size(); }
};

/// One pass over the edges.
Reaches find_reaches(const GraphPart& part, std::span<const Extent> extents, int bins,
                     int threads) {
  std::array<PerLane, 3> direction{};
  PerLane low{};
  for (std::size_t k = 0; k < extents.size(); ++k) {
    const float scale = (static_cast<float>(bins) - 0.01F) / extents[k].length();
    for (int axis = 0; axis < 3; ++axis) direction[axis][k] = extents[k].direction[axis] * scale;
    low[k] = extents[k].low * scale;
  }
  const auto last = static_cast<float>(bins - 1);  // rounding leads beyond it
  const std::size_t size = part.position.size();
  Reaches out{std::vector<Bins>(size), std::vector<Bins>(size), std::vector<Bins>(size)};
  parallel_each(threads, part.size(), kVerticesAPiece, [&](std::int64_t i) {
    const Point& p = part.position[i];
    for (std::size_t k = 0; k < kLanes; ++k) {
      const float at = p[0] * direction[0][k] + p[1] * direction[1][k] + p[2] * direction[2][k];
      out.own[i].lanes[k] = static_cast<std::int16_t>(std::min(std::max(at - low[k], 0.0F), last));
    }
  });
  parallel_each(threads, part.size(), kVerticesAPiece, [&](std::int64_t i) {
    Bins lowest = out.own[i], highest = lowest;
    for (Index n = part.start[i]; n < part.start[i + 1]; ++n) {
      const auto other = out.own[part.neighbor[n]].lanes;
      lowest.lanes = lowest.lanes < other ? lowest.lanes : other;
      highest.lanes = highest.lanes > other ? highest.lanes : other;
    }
    out.lowest[i] = lowest;
    out.highest[i] = highest;
  });
  return out;
}

struct Plane {
  std::size_t lane = 0;
  int bin = 0;        ///< vertices in bins up to this one are left of the plane
  Half from = kLeft;  ///< the half that gives its boundary vertices to the separator
  double cost = std::numeric_limits<double>::max();
};

/// Sweeps a plane through all bins of a direction, counting both separators it could leave: the
/// left vertices with a neighbour on the right, and the other way round.
Plane sweep(const Reaches& reaches, std::size_t lane, int bins) {
  struct Bin {
    Index own, lowest, highest;  ///< vertices of which this is the bin of that kind
  };
  std::array<Bin, kMaxBins> all;
  std::fill_n(all.begin(), bins, Bin{});
  for (std::size_t i = 0; i < reaches.size(); ++i) {
    ++all[reaches.own[i][lane]].own;
    ++all[reaches.lowest[i][lane]].lowest;
    ++all[reaches.highest[i][lane]].highest;
  }
  Plane best{.lane = lane};
  const auto size = static_cast<Index>(reaches.size());
  Index on_left = 0, reaching_left = 0, only_left = 0;
  for (int b = 0; b < bins - 1; ++b) {
    on_left += all[b].own;
    reaching_left += all[b].lowest;
    only_left += all[b].highest;
    const Index left = on_left - only_left, right = reaching_left - on_left;
    if (std::min(on_left, size - on_left) < kSmallestShare * size) continue;
    const double factor = imbalance(on_left, size);
    if ((left + 1) * factor < best.cost) best = {lane, b, kLeft, (left + 1) * factor};
    if ((right + 1) * factor < best.cost) best = {lane, b, kRight, (right + 1) * factor};
  }
  return best;
}

Separator cut(const Reaches& reaches, const Plane& plane) {
  Separator out;
  out.half.resize(reaches.size());
  for (std::size_t i = 0; i < reaches.size(); ++i) {
    const bool right = reaches.own[i][plane.lane] > plane.bin;
    const bool border = plane.from == kLeft ? !right && reaches.highest[i][plane.lane] > plane.bin
                                            : right && reaches.lowest[i][plane.lane] <= plane.bin;
    out.half[i] = border ? kSeparator : right ? kRight : kLeft;
    ++out.count[out.half[i]];
  }
  return out;
}

std::vector<Separator> cuts_along(std::span<const Extent> extents, const GraphPart& part, int most,
                                  int threads) {
  const int bins = std::clamp(static_cast<int>(4 * std::sqrt(part.size())), 16, kMaxBins);
  const Reaches reaches = find_reaches(part, extents, bins, threads);
  std::vector<Plane> planes(extents.size());
  parallel_each<std::size_t>(part.size() > kVerticesAPiece ? threads : 1, std::ssize(planes), 1,
                             [&](std::size_t lane) { planes[lane] = sweep(reaches, lane, bins); });
  std::erase_if(
      planes, [](const Plane& plane) { return plane.cost == std::numeric_limits<double>::max(); });
  std::ranges::stable_sort(planes, {}, &Plane::cost);
  planes.resize(std::min(planes.size(), static_cast<std::size_t>(most)));
  std::vector<Separator> out(planes.size());
  parallel_each<std::size_t>(part.size() > kVerticesAPiece ? threads : 1, std::ssize(out), 1,
                             [&](std::size_t k) { out[k] = cut(reaches, planes[k]); });
  return out;
}

}  // namespace

std::vector<Separator> plane_cuts(const GraphPart& part, int most, int threads) {
  const std::vector<Extent> extents = find_extents(part, kThin, threads);
  std::vector<Separator> cuts = cuts_along(extents, part, most, threads);
  if (extents.size() == kLanes) return cuts;  // no direction was left out
  // Across needles the shortest cut is along the direction in which the part is thin.
  constexpr double kLarge = 4;  // times sqrt(n), which is what surfaces leave at most
  if (!cuts.empty() && cuts.front().count[kSeparator] <= kLarge * std::sqrt(part.size())) {
    return cuts;
  }
  const std::vector<Extent> all = find_extents(part, 0, threads);
  return all.size() == extents.size() ? cuts : cuts_along(all, part, most, threads);
}

}  // namespace geotherm
