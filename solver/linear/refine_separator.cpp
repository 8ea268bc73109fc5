// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cstdlib>
#include <vector>

#include "solver/core/sorting.h"
#include "solver/linear/separator.h"

namespace geotherm {
namespace {

/// Leave the separator for a half.
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

  /// Whether there is one left: it is taken out.
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

}  // namespace geotherm
