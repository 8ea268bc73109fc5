// SPDX-License-Identifier: MIT
#include "solver/linear/multifrontal/fill_order.h"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <cassert>
#include <limits>
#include <numeric>
#include <utility>

#include "solver/core/parallel.h"
#include "solver/linear/multifrontal/separator.h"

namespace geotherm {
namespace {

/// Parts of fewer vertices are ordered by one thread, in less time than it takes to begin another.
constexpr Index kMinVerticesForThreads = 2000;

/// Neighbours outside of the part are its halo, the first 64 of them: most parts have fewer.
void order_small(const SymmetricPattern& whole, const GraphPart& part, std::span<Index> out) {
  std::array<NeighborMask, kSmallGraph> neighbors{};
  std::array<Index, kSmallGraph> halo{}, local{};
  std::size_t halo_size = 0;
  const auto n = static_cast<std::size_t>(part.size());
  for (std::size_t i = 0; i < n; ++i) {
    Index k = part.start[i];
    for (const Index j : whole.neighbors(part.vertex[i])) {
      // Both lists ascend.
      if (k < part.start[i + 1] && part.vertex[part.neighbor[k]] == j) {
        neighbors[i].inner |= 1ULL << part.neighbor[k++];
        continue;
      }
      const auto end = halo.begin() + halo_size;
      const auto at = std::find(halo.begin(), end, j);
      if (at == halo.end()) continue;
      if (at == end) halo[halo_size++] = j;
      neighbors[i].halo |= 1ULL << (at - halo.begin());
    }
  }
  minimum_degree_order({neighbors.data(), n}, {local.data(), n});
  for (std::size_t i = 0; i < n; ++i) out[i] = part.vertex[local[i]];
}

/// One half as a part of its own. `local`: numbers of its vertices in it.
GraphPart half_of(const GraphPart& part, const Separator& separator, Half h,
                  const std::vector<Index>& local) {
  GraphPart half;
  const auto n = static_cast<std::size_t>(separator.count[h]);
  half.vertex.reserve(n);
  half.position.reserve(n);
  half.start.reserve(n + 1);
  half.neighbor.reserve(part.neighbor.size() / static_cast<std::size_t>(part.size()) * n + n);
  for (Index i = 0; i < part.size(); ++i) {
    if (separator.half[i] != h) continue;
    half.vertex.push_back(part.vertex[i]);
    half.position.push_back(part.position[i]);
    for (Index k = part.start[i]; k < part.start[i + 1]; ++k) {
      const Index j = part.neighbor[k];
      if (separator.half[j] == h) half.neighbor.push_back(local[j]);
    }
    half.start.push_back(static_cast<Index>(half.neighbor.size()));
  }
  return half;
}

/// The two halves; separator vertices go straight to the end of `out`.
std::array<GraphPart, 2> cut(const GraphPart& part, const Separator& separator,
                             std::span<Index> out, int threads) {
  std::vector<Index> local(static_cast<std::size_t>(part.size()));
  std::array<Index, 2> count{};
  std::size_t end = out.size() - static_cast<std::size_t>(separator.count[kSeparator]);
  for (Index i = 0; i < part.size(); ++i) {
    const int h = separator.half[i];
    if (h == kSeparator) {
      out[end++] = part.vertex[i];
    } else {
      local[i] = count[h]++;
    }
  }
  std::array<GraphPart, 2> halves;
  run_both(
      part.size() >= kMinVerticesForThreads ? threads : 1,
      [&] { halves[0] = half_of(part, separator, kLeft, local); },
      [&] { halves[1] = half_of(part, separator, kRight, local); });
  return halves;
}

/// An order of n vertices by approximate minimum degree (Amestoy, Davis, Duff 1996).
/// neighbors(i): those of vertex i.
template <class Neighbors>
std::vector<Index> minimum_degree(Index n, const Neighbors& neighbors) {
  Eigen::SparseMatrix<double> graph(n, n);
  std::vector<int> counts(static_cast<std::size_t>(n));
  for (Index i = 0; i < n; ++i) counts[i] = static_cast<int>(neighbors(i).size()) + 1;
  graph.reserve(counts);
  for (Index i = 0; i < n; ++i) {
    graph.insert(i, i) = 1;
    for (const Index j : neighbors(i)) graph.insert(j, i) = 1;
  }
  graph.makeCompressed();
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> inverse;
  Eigen::AMDOrdering<int>()(graph.selfadjointView<Eigen::Lower>(), inverse);
  const auto& indices = inverse.indices();
  return {indices.data(), indices.data() + n};
}

void order_part(const SymmetricPattern& whole, GraphPart part, std::span<Index> out, int threads) {
  if (part.size() <= kSmallGraph) {
    order_small(whole, part, out);
    return;
  }
  const Separator separator = find_separator(part, threads);
  if (separator.count[kLeft] == 0 || separator.count[kRight] == 0) {
    // Planes do not cut it: a clique, or two rings far apart of which one is all of the separator.
    const std::vector<Index> order = minimum_degree(part.size(), [&part](Index i) {
      return std::span(part.neighbor).subspan(part.start[i], part.start[i + 1] - part.start[i]);
    });
    for (std::size_t i = 0; i < order.size(); ++i) out[i] = part.vertex[order[i]];
    return;
  }
  std::array<GraphPart, 2> halves = cut(part, separator, out, threads);
  part = {};
  const auto left = static_cast<std::size_t>(separator.count[kLeft]);
  const auto right = static_cast<std::size_t>(separator.count[kRight]);
  run_both(
      left + right >= kMinVerticesForThreads ? threads : 1,
      [&] { order_part(whole, std::move(halves[0]), out.subspan(0, left), threads / 2); },
      [&] {
        order_part(whole, std::move(halves[1]), out.subspan(left, right), threads - threads / 2);
      });
}

}  // namespace

void minimum_degree_order(std::span<NeighborMask> neighbors, std::span<Index> order) {
  const std::size_t n = neighbors.size();
  std::array<int, kSmallGraph> degree{};
  for (std::size_t v = 0; v < n; ++v) degree[v] = neighbors[v].count();
  std::uint64_t alive = n == 64 ? ~0ULL : (1ULL << n) - 1;
  for (std::size_t step = 0; step < n; ++step) {
    int best = std::countr_zero(alive);
    for (std::uint64_t rest = alive; rest != 0; rest &= rest - 1) {
      const int v = std::countr_zero(rest);
      if (degree[v] < degree[best]) best = v;
    }
    order[step] = best;
    const std::uint64_t bit = 1ULL << best;
    alive &= ~bit;
    const NeighborMask clique = neighbors[best];
    for (std::uint64_t rest = clique.inner; rest != 0; rest &= rest - 1) {
      const int v = std::countr_zero(rest);
      neighbors[v].inner = (neighbors[v].inner | clique.inner) & ~bit & ~(1ULL << v);
      neighbors[v].halo |= clique.halo;
      degree[v] = neighbors[v].count();
    }
  }
}

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
  // Halved, since the extent of a model may be more than a double holds.
  const double size = n > 0 ? (high / 2 - low / 2).maxCoeff() : 1.0;
  whole.position.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 p = size > 0 ? Vec3((positions[i] / 2 - low / 2) / size) : Vec3::Zero();
    whole.position[i] = {static_cast<float>(p.x()), static_cast<float>(p.y()),
                         static_cast<float>(p.z())};
  }
  std::vector<Index> order(n);
  order_part(pattern, std::move(whole), order, threads);
  return order;
}

std::vector<Index> fill_reducing_order(const SymmetricPattern& pattern,
                                       std::span<const Vec3> positions, int threads) {
  const bool placed = positions.size() == static_cast<std::size_t>(pattern.size());
  if (placed && pattern.size() >= kDissectFrom) {
    return nested_dissection(pattern, positions, threads);
  }
  return minimum_degree(pattern.size(), [&pattern](Index i) { return pattern.neighbors(i); });
}

}  // namespace geotherm
