// SPDX-License-Identifier: MIT
#include "solver/linear/multifrontal/separator.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>
#include <utility>
#include <vector>

#include "solver/core/parallel.h"
#include "solver/core/sorting.h"

namespace geotherm {
namespace {

/// A move of a vertex from the separator into a half.
struct Move {
  Index gain, vertex;  ///< gain: by how much the separator shrinks
  std::int8_t to;
};

/// Moves by gain, best first, of the same gain the latest first. A gain below kMin waits with
/// those of kMin.
class MoveQueue {
 public:
  MoveQueue() { first_.fill(kNoIndex); }

  void push(const Move& move) {
    const Index list = std::max(move.gain, kMin) - kMin;
    moves_.push_back({move, first_[list]});
    first_[list] = static_cast<Index>(moves_.size()) - 1;
    best_ = std::max(best_, list);
  }

  /// Takes the best move out of the queue; false where it is empty.
  bool pop(Move& move) {
    while (best_ >= 0 && first_[best_] == kNoIndex) --best_;
    if (best_ < 0) return false;
    const Waiting& waiting = moves_[first_[best_]];
    first_[best_] = waiting.next;
    move = waiting.move;
    return true;
  }

 private:
  static constexpr Index kMin = -14;

  struct Waiting {
    Move move;
    Index next;
  };
  std::vector<Waiting> moves_;
  std::array<Index, 2 - kMin> first_;
  Index best_ = kNoIndex;
};

}  // namespace

void refine_separator(const GraphPart& part, Separator& s) {
  // Moving v out of the separator pulls its neighbours on the opposite half in.
  const auto gain = [&](Index v, int to) {
    Index pulled = 0;
    for (Index k = part.start[v]; k < part.start[v + 1]; ++k) {
      pulled += s.half[part.neighbor[k]] == 1 - to;
    }
    return 1 - pulled;
  };
  MoveQueue queue;
  const auto push = [&](Index v) {
    queue.push({gain(v, kLeft), v, kLeft});
    queue.push({gain(v, kRight), v, kRight});
  };
  for_each_with_value(s.half, std::int8_t{kSeparator}, push);

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
  const Index patience = std::max<Index>(10, s.count[kSeparator] / 2);
  const Index most_moves = 4 * s.count[kSeparator] + 50;
  const auto largest_half = static_cast<Index>(part.size() * (1 - kSmallestShare));
  Index smallest = s.count[kSeparator];
  Index balance = std::abs(s.count[kLeft] - s.count[kRight]);
  std::size_t best_length = 0;
  Index moves = 0, without_gain = 0;
  Move top;
  while (moves < most_moves && without_gain <= patience && queue.pop(top)) {
    if (s.half[top.vertex] != kSeparator || locked[top.vertex]) continue;
    if (const Index now = gain(top.vertex, top.to); now < top.gain) {  // neighbours moved since
      queue.push({now, top.vertex, top.to});
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
      push(u);
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

namespace {

/// The number of planes whose separators are refined; the best of these is taken. By measurement a
/// third gains less than its time costs, and so does a second in parts of few vertices.
constexpr int kCandidates = 2;
constexpr Index kFewRows = 300;
/// The maximum number of passes of moves; a pass without gain ends them earlier.
constexpr int kPasses = 2;

/// Parts of fewer vertices are cut by one thread.
constexpr Index kMinSeparatorVerticesForThreads = 20'000;

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

/// Cuts between the layers of a breadth-first search, half of the vertices on each side.
Separator layer_cut(const GraphPart& part) {
  Separator out;
  out.half.resize(part.vertex.size());
  const std::vector<Index> by_layer = breadth_first(part);
  for (Index i = 0; i < part.size(); ++i) {
    out.half[by_layer[i]] = i < part.size() / 2 ? kLeft : kRight;
  }
  for (Index i = 0; i < part.size(); ++i) {
    if (out.half[i] == kLeft && touches(part, out.half, i, kRight)) out.half[i] = kSeparator;
    ++out.count[out.half[i]];
  }
  return out;
}

void refine(const GraphPart& part, Separator& separator) {
  for (int pass = 0; pass < kPasses; ++pass) {
    const Index before = separator.count[kSeparator];
    refine_separator(part, separator);
    if (separator.count[kSeparator] == before) return;
  }
}

double cost_of(const Separator& s) {
  if (s.count[kLeft] == 0 || s.count[kRight] == 0) return std::numeric_limits<double>::max();
  const Index size = s.count[kLeft] + s.count[kRight] + s.count[kSeparator];
  return s.count[kSeparator] * imbalance(s.count[kLeft] + s.count[kSeparator] / 2, size);
}

/// A separator vertex that touches one half only is not needed.
void drop_unneeded(const GraphPart& part, Separator& s) {
  for_each_with_value(s.half, std::int8_t{kSeparator}, [&](Index i) {
    const bool left = touches(part, s.half, i, kLeft);
    const bool right = touches(part, s.half, i, kRight);
    if (left && right) return;
    const Half to = left ? kLeft : right ? kRight : s.count[0] < s.count[1] ? kLeft : kRight;
    s.half[i] = to;
    --s.count[kSeparator];
    ++s.count[to];
  });
}

}  // namespace

Separator find_separator(const GraphPart& part, int threads) {
  const int most = part.size() < kFewRows ? 1 : kCandidates;
  std::vector<Separator> candidates = plane_cuts(part, most, threads);
  if (candidates.empty()) candidates.push_back(layer_cut(part));
  parallel_each<std::size_t>(part.size() > kMinSeparatorVerticesForThreads ? threads : 1,
                             std::ssize(candidates), 1,
                             [&](std::size_t k) { refine(part, candidates[k]); });
  Separator best = std::move(*std::ranges::min_element(candidates, {}, cost_of));
  drop_unneeded(part, best);
  return best;
}

}  // namespace geotherm
