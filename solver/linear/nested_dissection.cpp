// SPDX-License-Identifier: MIT
#include "solver/linear/nested_dissection.h"

#include <array>
#include <cassert>
#include <cstdint>
#include <numeric>

#include "solver/core/parallel.h"
#include "solver/linear/minimum_degree.h"
#include "solver/linear/separator.h"

namespace geotherm {
namespace {

void order_small(const GraphPart& part, std::span<Index> out) {
  std::array<std::uint64_t, kSmallGraph> adjacency{};
  std::array<Index, kSmallGraph> local{};
  const auto n = static_cast<std::size_t>(part.size());
  for (std::size_t i = 0; i < n; ++i) {
    for (Index k = part.start[i]; k < part.start[i + 1]; ++k) {
      adjacency[i] |= 1ULL << part.neighbor[k];
    }
  }
  minimum_degree_order({adjacency.data(), n}, {local.data(), n});
  for (std::size_t i = 0; i < n; ++i) out[i] = part.vertex[local[i]];
}

/// The two halves as parts of their own; separator vertices go straight to the end of `out`.
std::array<GraphPart, 2> cut(const GraphPart& part, const Separator& separator,
                             std::span<Index> out) {
  std::array<GraphPart, 2> halves;
  std::vector<Index> local(static_cast<std::size_t>(part.size()));
  for (int h = 0; h < 2; ++h) {
    const auto n = static_cast<std::size_t>(separator.count[h]);
    halves[h].vertex.reserve(n);
    halves[h].position.reserve(n);
    halves[h].start.reserve(n + 1);
    halves[h].neighbor.reserve(7 * n);
  }
  std::size_t end = out.size() - static_cast<std::size_t>(separator.count[kSeparator]);
  for (Index i = 0; i < part.size(); ++i) {
    const int h = separator.half[i];
    if (h == kSeparator) {
      out[end++] = part.vertex[i];
      continue;
    }
    local[i] = halves[h].size();
    halves[h].vertex.push_back(part.vertex[i]);
    halves[h].position.push_back(part.position[i]);
  }
  for (Index i = 0; i < part.size(); ++i) {
    const int h = separator.half[i];
    if (h == kSeparator) continue;
    for (Index k = part.start[i]; k < part.start[i + 1]; ++k) {
      const Index j = part.neighbor[k];
      if (separator.half[j] == h) halves[h].neighbor.push_back(local[j]);
    }
    halves[h].start.push_back(static_cast<Index>(halves[h].neighbor.size()));
  }
  return halves;
}

void order_part(GraphPart part, std::span<Index> out, int threads) {
  if (part.size() <= kSmallGraph) {
    order_small(part, out);
    return;
  }
  const Separator separator = find_separator(part);
  if (separator.count[kLeft] == 0 || separator.count[kRight] == 0) {
    // Nothing to gain from cutting (a clique, say): any order is as good.
    std::copy(part.vertex.begin(), part.vertex.end(), out.begin());
    return;
  }
  std::array<GraphPart, 2> halves = cut(part, separator, out);
  part = {};
  const auto left = static_cast<std::size_t>(separator.count[kLeft]);
  const auto right = static_cast<std::size_t>(separator.count[kRight]);
  run_both(
      threads, [&] { order_part(std::move(halves[0]), out.subspan(0, left), threads / 2); },
      [&] { order_part(std::move(halves[1]), out.subspan(left, right), threads - threads / 2); });
}

}  // namespace

std::vector<Index> nested_dissection(const SymmetricPattern& pattern,
                                     std::span<const Vec3> positions, int threads) {
  assert(positions.size() == static_cast<std::size_t>(pattern.size()));
  GraphPart whole;
  const auto n = static_cast<std::size_t>(pattern.size());
  whole.start.assign(pattern.start.begin(), pattern.start.end());
  whole.neighbor = pattern.neighbor;
  whole.vertex.resize(n);
  std::iota(whole.vertex.begin(), whole.vertex.end(), 0);
  // Single precision is enough to place a cut, once the model stands at the origin at size 1.
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::max());
  Vec3 high = -low;
  for (const Vec3& p : positions) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double size = n > 0 ? (high - low).maxCoeff() : 1.0;
  whole.position.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 p = size > 0 ? Vec3((positions[i] - low) / size) : Vec3::Zero();
    whole.position[i] = {static_cast<float>(p.x()), static_cast<float>(p.y()),
                         static_cast<float>(p.z())};
  }
  std::vector<Index> order(n);
  order_part(std::move(whole), order, threads);
  return order;
}

}  // namespace geotherm
