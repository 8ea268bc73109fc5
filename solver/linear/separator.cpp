// SPDX-License-Identifier: MIT
#include "solver/linear/separator.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/core/parallel.h"

namespace geotherm {
namespace {

/// Each half keeps at least this share of the vertices when the plane is chosen.
constexpr double kSmallestShare = 0.25;
constexpr int kMostBins = 512;

constexpr std::int64_t kVerticesAPiece = 20'000;

/// One number for each axis; the fourth keeps them together in a register.
using PerAxis = std::array<std::int16_t, 4>;

struct Plane {
  int axis = -1;
  int bin = 0;        ///< vertices in bins up to this one are left of the plane
  Half from = kLeft;  ///< the half that gives its border vertices to the separator
  double cost = std::numeric_limits<double>::max();
};

/// Where a vertex and its neighbours lie along each axis.
struct Reach {
  PerAxis own, lowest, highest;
};

struct Box {
  std::array<float, 3> low, high;
  float extent(int axis) const { return high[axis] - low[axis]; }
};

Box box_of(const GraphPart& part) {
  constexpr float kMost = std::numeric_limits<float>::max();
  Box box{{kMost, kMost, kMost}, {-kMost, -kMost, -kMost}};
  for (const auto& p : part.position) {
    for (int axis = 0; axis < 3; ++axis) {
      box.low[axis] = std::min(box.low[axis], p[axis]);
      box.high[axis] = std::max(box.high[axis], p[axis]);
    }
  }
  return box;
}

/// Bins of all vertices along all axes, and those of their neighbours: one pass over the edges.
std::vector<Reach> find_reaches(const GraphPart& part, const Box& box, int bins, int threads) {
  std::array<float, 3> scale{};
  for (int axis = 0; axis < 3; ++axis) {
    if (box.extent(axis) > 0) scale[axis] = (static_cast<float>(bins) - 0.01F) / box.extent(axis);
  }
  std::vector<PerAxis> bin(part.position.size());
  parallel_for(threads, part.size(), kVerticesAPiece, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        bin[i][axis] =
            static_cast<std::int16_t>((part.position[i][axis] - box.low[axis]) * scale[axis]);
      }
    }
  });
  std::vector<Reach> reach(bin.size());
  parallel_for(threads, part.size(), kVerticesAPiece, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) {
      PerAxis low = bin[i], high = bin[i];
      for (Index k = part.start[i]; k < part.start[i + 1]; ++k) {
        const PerAxis other = bin[part.neighbor[k]];
        for (int axis = 0; axis < 4; ++axis) {
          low[axis] = low[axis] < other[axis] ? low[axis] : other[axis];
          high[axis] = high[axis] > other[axis] ? high[axis] : other[axis];
        }
      }
      reach[i] = {bin[i], low, high};
    }
  });
  return reach;
}

/// Sweeps a plane through all bins of an axis, counting both separators it could leave: the left
/// vertices with a neighbour on the right, and the other way round.
Plane sweep(const std::vector<Reach>& reaches, int axis, int bins) {
  std::array<Index, kMostBins + 1> count{}, left_border{}, right_border{};
  for (const Reach& reach : reaches) {
    const int own = reach.own[axis];
    ++count[own];
    ++left_border[own], --left_border[reach.highest[axis]];
    ++right_border[reach.lowest[axis]], --right_border[own];
  }
  Plane best;
  Index on_left = 0, left = 0, right = 0;
  for (int b = 0; b < bins - 1; ++b) {
    on_left += count[b];
    left += left_border[b];
    right += right_border[b];
    const double share = static_cast<double>(on_left) / static_cast<double>(reaches.size());
    if (share < kSmallestShare || share > 1 - kSmallestShare) continue;
    const double imbalance = 1 + 16 * (share - 0.5) * (share - 0.5);
    if ((left + 1) * imbalance < best.cost) best = {axis, b, kLeft, (left + 1) * imbalance};
    if ((right + 1) * imbalance < best.cost) best = {axis, b, kRight, (right + 1) * imbalance};
  }
  return best;
}

/// The best plane of all axes along which the part is not thin.
Plane best_plane(const std::vector<Reach>& reaches, const Box& box, int bins, int threads) {
  const float longest = std::max({box.extent(0), box.extent(1), box.extent(2)});
  std::array<Plane, 3> planes;
  parallel_for(std::ssize(reaches) > kVerticesAPiece ? threads : 1, 3, 1,
               [&](std::int64_t begin, std::int64_t end) {
                 for (auto axis = static_cast<int>(begin); axis < end; ++axis) {
                   if (box.extent(axis) > 0 && box.extent(axis) >= 0.3F * longest) {
                     planes[axis] = sweep(reaches, axis, bins);
                   }
                 }
               });
  return *std::min_element(planes.begin(), planes.end(),
                           [](const Plane& a, const Plane& b) { return a.cost < b.cost; });
}

bool touches(const GraphPart& part, const std::vector<std::int8_t>& half, Index i, int other) {
  for (Index k = part.start[i]; k < part.start[i + 1]; ++k) {
    if (half[part.neighbor[k]] == other) return true;
  }
  return false;
}

/// All vertices by breadth-first search from one far from vertex 0, component after component.
std::vector<Index> breadth_first(const GraphPart& part) {
  std::vector<Index> order;
  order.reserve(part.vertex.size());
  const auto search = [&](Index root, std::vector<char>& seen) {
    std::size_t next = order.size();
    order.push_back(root);
    seen[root] = 1;
    for (; next < order.size(); ++next) {
      for (Index k = part.start[order[next]]; k < part.start[order[next] + 1]; ++k) {
        const Index j = part.neighbor[k];
        if (seen[j] != 0) continue;
        seen[j] = 1;
        order.push_back(j);
      }
    }
  };
  std::vector<char> seen(part.vertex.size(), 0);
  search(0, seen);
  const Index far = order.back();
  order.clear();
  std::fill(seen.begin(), seen.end(), 0);
  search(far, seen);
  for (Index i = 0; i < part.size(); ++i) {
    if (seen[i] == 0) search(i, seen);
  }
  return order;
}

/// Left, right and separator of the best plane, or of half a breadth-first search where no plane
/// keeps the balance: many vertices are in one bin.
std::vector<std::int8_t> split(const GraphPart& part, int threads) {
  const Box box = box_of(part);
  const int bins = std::clamp(static_cast<int>(4 * std::sqrt(part.size())), 16, kMostBins);
  const std::vector<Reach> reaches = find_reaches(part, box, bins, threads);
  const Plane best = best_plane(reaches, box, bins, threads);
  std::vector<std::int8_t> half(static_cast<std::size_t>(part.size()));
  if (best.axis >= 0) {
    for (Index i = 0; i < part.size(); ++i) {
      const Reach& reach = reaches[i];
      const bool right = reach.own[best.axis] > best.bin;
      const bool border = best.from == kLeft ? !right && reach.highest[best.axis] > best.bin
                                             : right && reach.lowest[best.axis] <= best.bin;
      half[i] = border ? kSeparator : right ? kRight : kLeft;
    }
    return half;
  }
  const std::vector<Index> by_layer = breadth_first(part);
  for (Index i = 0; i < part.size(); ++i) half[by_layer[i]] = i < part.size() / 2 ? kLeft : kRight;
  for (Index i = 0; i < part.size(); ++i) {
    if (half[i] == kLeft && touches(part, half, i, kRight)) half[i] = kSeparator;
  }
  return half;
}

}  // namespace

Separator find_separator(const GraphPart& part, int threads) {
  Separator out;
  out.half = split(part, threads);
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
