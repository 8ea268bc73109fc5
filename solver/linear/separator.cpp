// SPDX-License-Identifier: MIT
#include "solver/linear/separator.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "solver/core/parallel.h"
#include "solver/core/sorting.h"
#include "solver/linear/plane_cuts.h"

namespace geotherm {
namespace {

/// Planes that are refined; the best of the refined separators is taken. Measured: a third is worth
/// less than its time, and so is a second in parts of few vertices.
constexpr int kCandidates = 2;
constexpr Index kFew = 300;
/// Passes of moves at most, as long as they gain.
constexpr int kPasses = 2;

constexpr Index kWorthAThread = 20'000;

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
  const int most = part.size() < kFew ? 1 : kCandidates;
  std::vector<Separator> candidates = plane_cuts(part, most, threads);
  if (candidates.empty()) candidates.push_back(layer_cut(part));
  parallel_for(part.size() > kWorthAThread ? threads : 1, std::ssize(candidates), 1,
               [&](std::int64_t begin, std::int64_t end) {
                 for (; begin < end; ++begin) {
                   refine(part, candidates[static_cast<std::size_t>(begin)]);
                 }
               });
  Separator best = std::move(*std::ranges::min_element(candidates, {}, cost_of));
  drop_unneeded(part, best);
  return best;
}

}  // namespace geotherm
