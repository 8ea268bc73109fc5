// SPDX-License-Identifier: MIT
#include "solver/linear/separator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace geotherm {
namespace {

/// Each half keeps at least this share of the vertices when the plane is chosen.
constexpr double kSmallestShare = 0.25;
constexpr int kMostBins = 512;

struct Plane {
  int axis = -1;
  int bin = 0;        ///< vertices in bins up to this one are left of the plane
  Half from = kLeft;  ///< the half that gives its border vertices to the separator
  double cost = std::numeric_limits<double>::max();
};

/// Bins of all vertices along one axis; false when the part is flat in that direction.
bool bin_along(const GraphPart& part, int axis, int bins, std::vector<std::uint16_t>& bin) {
  float low = std::numeric_limits<float>::max();
  float high = std::numeric_limits<float>::lowest();
  for (const auto& p : part.position) {
    low = std::min(low, p[axis]);
    high = std::max(high, p[axis]);
  }
  if (!(high > low)) return false;
  const float scale = (static_cast<float>(bins) - 0.01F) / (high - low);
  bin.resize(part.position.size());
  for (std::size_t i = 0; i < part.position.size(); ++i) {
    bin[i] = static_cast<std::uint16_t>((part.position[i][axis] - low) * scale);
  }
  return true;
}

/// Sweeps a plane through all bins of an axis, counting both separators it could leave: the left
/// vertices with a neighbour on the right, and the other way round.
void sweep(const GraphPart& part, int axis, int bins, const std::vector<std::uint16_t>& bin,
           Plane& best) {
  std::array<Index, kMostBins + 1> count{}, left_border{}, right_border{};
  for (Index i = 0; i < part.size(); ++i) {
    const int own = bin[i];
    int lowest = own;
    int highest = own;
    for (Index k = part.start[i]; k < part.start[i + 1]; ++k) {
      const int other = bin[part.neighbor[k]];
      lowest = std::min(lowest, other);
      highest = std::max(highest, other);
    }
    ++count[own];
    ++left_border[own], --left_border[highest];
    ++right_border[lowest], --right_border[own];
  }
  Index on_left = 0, left = 0, right = 0;
  for (int b = 0; b < bins - 1; ++b) {
    on_left += count[b];
    left += left_border[b];
    right += right_border[b];
    const double share = static_cast<double>(on_left) / part.size();
    if (share < kSmallestShare || share > 1 - kSmallestShare) continue;
    const double imbalance = 1 + 16 * (share - 0.5) * (share - 0.5);
    if ((left + 1) * imbalance < best.cost) best = {axis, b, kLeft, (left + 1) * imbalance};
    if ((right + 1) * imbalance < best.cost) best = {axis, b, kRight, (right + 1) * imbalance};
  }
}

/// Left and right of the best plane, or of the median along the longest axis when no plane keeps
/// the balance (many vertices in one bin).
std::vector<std::int8_t> split(const GraphPart& part, Half& from) {
  std::array<float, 3> extent{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto [low, high] =
        std::minmax_element(part.position.begin(), part.position.end(),
                            [axis](const auto& a, const auto& b) { return a[axis] < b[axis]; });
    extent[axis] = (*high)[axis] - (*low)[axis];
  }
  const float longest = *std::max_element(extent.begin(), extent.end());
  const int bins = std::clamp(static_cast<int>(4 * std::sqrt(part.size())), 16, kMostBins);
  Plane best;
  std::vector<std::uint16_t> bin;
  for (int axis = 0; axis < 3; ++axis) {
    if (extent[axis] < 0.3F * longest) continue;
    if (bin_along(part, axis, bins, bin)) sweep(part, axis, bins, bin, best);
  }
  std::vector<std::int8_t> half(static_cast<std::size_t>(part.size()));
  from = best.from;
  if (best.axis >= 0) {
    bin_along(part, best.axis, bins, bin);
    for (Index i = 0; i < part.size(); ++i) half[i] = bin[i] > best.bin ? kRight : kLeft;
    return half;
  }
  const auto axis = std::max_element(extent.begin(), extent.end()) - extent.begin();
  std::vector<Index> by_place(static_cast<std::size_t>(part.size()));
  std::iota(by_place.begin(), by_place.end(), 0);
  std::nth_element(by_place.begin(), by_place.begin() + part.size() / 2, by_place.end(),
                   [&](Index a, Index b) {
                     const float pa = part.position[a][axis];
                     const float pb = part.position[b][axis];
                     return pa != pb ? pa < pb : a < b;
                   });
  for (Index i = 0; i < part.size(); ++i) half[by_place[i]] = i < part.size() / 2 ? kLeft : kRight;
  return half;
}

bool touches(const GraphPart& part, const std::vector<std::int8_t>& half, Index i, int other) {
  for (Index k = part.start[i]; k < part.start[i + 1]; ++k) {
    if (half[part.neighbor[k]] == other) return true;
  }
  return false;
}

}  // namespace

Separator find_separator(const GraphPart& part) {
  Separator out;
  Half from = kLeft;
  out.half = split(part, from);
  for (Index i = 0; i < part.size(); ++i) {
    if (out.half[i] == from && touches(part, out.half, i, 1 - from)) out.half[i] = kSeparator;
  }
  for (const std::int8_t h : out.half) ++out.count[h];
  refine_separator(part, out);
  // A separator vertex that touches one half only is not needed.
  for (Index i = 0; i < part.size(); ++i) {
    if (out.half[i] != kSeparator) continue;
    const bool left = touches(part, out.half, i, kLeft);
    const bool right = touches(part, out.half, i, kRight);
    if (left && right) continue;
    const Half to = left ? kLeft : right ? kRight : out.count[0] < out.count[1] ? kLeft : kRight;
    out.half[i] = to;
    --out.count[kSeparator];
    ++out.count[to];
  }
  return out;
}

void refine_separator(const GraphPart& part, Separator& s) {
  struct Move {
    Index gain, vertex;
    std::int8_t to;
  };
  const auto worse = [](const Move& a, const Move& b) {
    if (a.gain != b.gain) return a.gain < b.gain;
    return a.vertex != b.vertex ? a.vertex < b.vertex : a.to < b.to;
  };
  // Moving v out of the separator pulls its neighbours on the opposite half in.
  const auto gain = [&](Index v, int to) {
    Index pulled = 0;
    for (Index k = part.start[v]; k < part.start[v + 1]; ++k) {
      pulled += s.half[part.neighbor[k]] == 1 - to;
    }
    return 1 - pulled;
  };
  std::vector<Move> heap;
  const auto push = [&](Index v, std::int8_t to) {
    heap.push_back({gain(v, to), v, to});
    std::push_heap(heap.begin(), heap.end(), worse);
  };
  for (Index v = 0; v < part.size(); ++v) {
    if (s.half[v] != kSeparator) continue;
    heap.push_back({gain(v, kLeft), v, kLeft});
    heap.push_back({gain(v, kRight), v, kRight});
  }
  std::make_heap(heap.begin(), heap.end(), worse);

  struct Change {
    Index vertex;
    std::int8_t was, is;
  };
  std::vector<Change> log;
  std::vector<char> locked(static_cast<std::size_t>(part.size()), 0);
  const auto change = [&](Index v, std::int8_t to) {
    log.push_back({v, s.half[v], to});
    --s.count[s.half[v]];
    ++s.count[to];
    s.half[v] = to;
  };
  const Index patience = std::max<Index>(20, s.count[kSeparator] / 8);
  const Index most_moves = 4 * s.count[kSeparator] + 50;
  const auto largest_half = static_cast<Index>(part.size() * (1 - kSmallestShare));
  Index smallest = s.count[kSeparator];
  Index balance = std::abs(s.count[kLeft] - s.count[kRight]);
  std::size_t best_length = 0;
  Index moves = 0, without_gain = 0;
  while (!heap.empty() && moves < most_moves && without_gain <= patience) {
    const Move top = heap.front();
    std::pop_heap(heap.begin(), heap.end(), worse);
    heap.pop_back();
    if (s.half[top.vertex] != kSeparator || locked[top.vertex]) continue;
    if (gain(top.vertex, top.to) < top.gain) {  // stale: neighbours moved since
      push(top.vertex, top.to);
      continue;
    }
    if (s.count[top.to] + 1 > largest_half) continue;
    ++moves;
    locked[top.vertex] = 1;
    change(top.vertex, top.to);
    const auto opposite = static_cast<std::int8_t>(1 - top.to);
    for (Index k = part.start[top.vertex]; k < part.start[top.vertex + 1]; ++k) {
      const Index u = part.neighbor[k];
      if (s.half[u] == opposite) change(u, kSeparator);
    }
    for (Index k = part.start[top.vertex]; k < part.start[top.vertex + 1]; ++k) {
      const Index u = part.neighbor[k];
      if (s.half[u] != kSeparator || locked[u]) continue;
      push(u, kLeft);
      push(u, kRight);
    }
    const Index now = std::abs(s.count[kLeft] - s.count[kRight]);
    if (s.count[kSeparator] < smallest || (s.count[kSeparator] == smallest && now < balance)) {
      smallest = s.count[kSeparator];
      balance = now;
      best_length = log.size();
      without_gain = 0;
    } else {
      ++without_gain;
    }
  }
  while (log.size() > best_length) {
    const Change last = log.back();
    log.pop_back();
    --s.count[last.is];
    ++s.count[last.was];
    s.half[last.vertex] = last.was;
  }
}

}  // namespace geotherm
