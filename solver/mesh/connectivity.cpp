// SPDX-License-Identifier: MIT
#include "solver/mesh/connectivity.h"

#include <algorithm>
#include <array>
#include <limits>
#include <queue>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "solver/core/parallel.h"
#include "solver/core/sorting.h"

namespace geotherm {

std::vector<char> vertices_in_faces(Index vertex_count, std::span<const Face> faces) {
  std::vector<char> used(static_cast<std::size_t>(vertex_count), 0);
  for (const Face& face : faces) {
    if (repeats_corner(face)) continue;
    for (const Index corner : face) used[corner] = 1;
  }
  return used;
}

CornerTable::CornerTable(Index vertex_count, std::span<const Face> faces, int threads) {
  const auto emit = [&faces](std::size_t f, const auto& put) {
    for (int k = 0; k < 3; ++k) put(faces[f][k], static_cast<Side>(3 * f + k));
  };
  corner_ = counting_sort<Side>(faces.size(), static_cast<std::size_t>(vertex_count), threads, emit,
                                start_);
}

namespace {

/// Vertices a thread must have to be worth starting.
constexpr std::int64_t kMinVerticesPerThread = 1 << 13;

/// The edges whose lower ends lie in one range of vertices.
struct Part {
  RawVector<Index> low, high;
  RawVector<std::uint32_t> first;  ///< within `sides`
  RawVector<Side> sides;
};

/// The sides whose lower end is one vertex, by their higher ends; sides of one edge by number.
class Bucket {
 public:
  /// Puts in those at vertex v. A face has two sides there, which lead to different vertices, so
  /// that those to the same vertex come by number.
  void fill(Index v, std::span<const Side> corners, std::span<const Face> faces) {
    if (high_.size() < 2 * corners.size()) {
      high_.resize(2 * corners.size());
      side_.resize(2 * corners.size());
    }
    count_ = 0;
    for (const Side corner : corners) {
      const Face& face = faces[static_cast<std::size_t>(face_of(corner))];
      const int k = corner_of(corner);
      put(v, face[next_corner(k)], corner);
      put(v, face[previous_corner(k)], corner - k + previous_corner(k));
    }
    if (count_ <= 8) {
      sort_few<8>();
    } else if (count_ <= 16) {
      sort_few<16>();
    } else {
      sort_many();
    }
  }

  std::size_t size() const { return count_; }
  Index high(std::size_t i) const { return high_[i]; }
  Side side(std::size_t i) const { return side_[i]; }

 private:
  /// Written always, counted where it belongs here: no branch to guess.
  void put(Index low, Index high, Side side) {
    high_[count_] = high;
    side_[count_] = side;
    count_ += high > low;
  }

  template <std::size_t kSize>
  void sort_few() {
    std::array<Index, kSize> keys;
    std::array<Side, kSize> sides;
    keys.fill(kLastKey);
    std::copy_n(high_.begin(), count_, keys.begin());
    std::copy_n(side_.begin(), count_, sides.begin());
    const auto rank = ranks(keys);
    for (std::size_t i = 0; i < count_; ++i) {
      high_[rank[i]] = keys[i];
      side_[rank[i]] = sides[i];
    }
  }

  void sort_many() {
    many_.clear();
    for (std::size_t i = 0; i < count_; ++i) many_.emplace_back(high_[i], side_[i]);
    std::ranges::sort(many_);
    for (std::size_t i = 0; i < count_; ++i) std::tie(high_[i], side_[i]) = many_[i];
  }

  std::vector<Index> high_ = std::vector<Index>(16);
  std::vector<Side> side_ = std::vector<Side>(16);
  std::size_t count_ = 0;
  std::vector<std::pair<Index, Side>> many_;
};

void list_edges(const CornerTable& corners, std::span<const Face> faces, Index begin, Index end,
                Part& part) {
  std::size_t most = 0;
  for (Index v = begin; v < end; ++v) most += corners.at(v).size();
  // On a closed surface half the corners are worth an edge; a boundary adds to that.
  const std::size_t likely = most / 2 + most / 16;
  part.low.reserve(likely);
  part.high.reserve(likely);
  part.first.reserve(likely);
  part.sides.reserve(most + most / 16);
  Bucket bucket;
  for (Index v = begin; v < end; ++v) {
    bucket.fill(v, corners.at(v), faces);
    for (std::size_t i = 0; i < bucket.size(); ++i) {
      if (i == 0 || bucket.high(i) != bucket.high(i - 1)) {
        part.low.push_back(v);
        part.high.push_back(bucket.high(i));
        part.first.push_back(static_cast<std::uint32_t>(part.sides.size()));
      }
      part.sides.push_back(bucket.side(i));
    }
  }
}

}  // namespace

EdgeTable::EdgeTable(const CornerTable& corners, std::span<const Face> faces, int threads) {
  const Index vertices = corners.vertex_count();
  const int pieces = piece_count(threads, vertices, kMinVerticesPerThread);
  std::vector<Part> parts(static_cast<std::size_t>(pieces));
  for_pieces(pieces, vertices, [&](int piece, std::int64_t begin, std::int64_t end) {
    list_edges(corners, faces, static_cast<Index>(begin), static_cast<Index>(end),
               parts[static_cast<std::size_t>(piece)]);
  });
  if (pieces == 1) {
    Part& whole = parts.front();
    std::tie(low_, high_) = std::tuple(std::move(whole.low), std::move(whole.high));
    first_ = std::move(whole.first);
    sides_ = std::move(whole.sides);
    first_.push_back(static_cast<std::uint32_t>(sides_.size()));
    return;
  }
  std::vector<std::size_t> edges_before(parts.size() + 1), sides_before(parts.size() + 1);
  for (std::size_t p = 0; p < parts.size(); ++p) {
    edges_before[p + 1] = edges_before[p] + parts[p].low.size();
    sides_before[p + 1] = sides_before[p] + parts[p].sides.size();
  }
  low_.resize(edges_before.back());
  high_.resize(edges_before.back());
  first_.resize(edges_before.back() + 1);
  sides_.resize(sides_before.back());
  for_pieces(pieces, pieces, [&](int piece, std::int64_t, std::int64_t) {
    const auto p = static_cast<std::size_t>(piece);
    const Part& part = parts[p];
    std::ranges::copy(part.low, low_.data() + edges_before[p]);
    std::ranges::copy(part.high, high_.data() + edges_before[p]);
    std::ranges::copy(part.sides, sides_.data() + sides_before[p]);
    const auto shift = static_cast<std::uint32_t>(sides_before[p]);
    std::ranges::transform(part.first, first_.data() + edges_before[p],
                           [shift](std::uint32_t first) { return first + shift; });
  });
  first_.back() = static_cast<std::uint32_t>(sides_.size());
}

EdgeGraph::EdgeGraph(std::span<const Vec3> positions, const EdgeTable& edges)
    : positions_(positions) {
  const auto emit = [&edges](std::size_t i, const auto& put) {
    const auto e = static_cast<Index>(i);
    put(edges.low(e), edges.high(e));
    put(edges.high(e), edges.low(e));
  };
  const auto count = static_cast<std::size_t>(edges.edge_count());
  neighbours_ = counting_sort<Index>(count, positions.size(), 1, emit, start_);
}

bool EdgeGraph::adjacent(Index a, Index b) const {
  const auto around = neighbours(a);
  return std::find(around.begin(), around.end(), b) != around.end();
}

Result<std::vector<Index>> EdgeGraph::shortest_path(Index from, Index to) const {
  using Entry = std::pair<double, Index>;  // least possible length through the vertex
  const auto straight = [this](Index a, Index b) {
    return (positions_[a] - positions_[b]).stableNorm();
  };
  std::vector<double> length(positions_.size(), std::numeric_limits<double>::infinity());
  std::vector<Index> before(positions_.size(), kNoIndex);
  std::vector<char> done(positions_.size(), 0);
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  length[from] = 0;
  queue.emplace(straight(from, to), from);
  while (!queue.empty() && !done[to]) {
    const Index v = queue.top().second;
    queue.pop();
    if (std::exchange(done[v], 1)) continue;
    for (const Index w : neighbours(v)) {
      const double through = length[v] + straight(v, w);
      if (done[w] || !(through < length[w])) continue;
      length[w] = through;
      before[w] = v;
      queue.emplace(through + straight(w, to), w);
    }
  }
  if (!done[to]) {
    return Error{ErrorCode::kBadInput, "no edges lead from vertex " + std::to_string(from) +
                                           " to vertex " + std::to_string(to) +
                                           "; they lie in different components"};
  }
  std::vector<Index> path;
  for (Index v = to; v != kNoIndex; v = before[v]) path.push_back(v);
  std::reverse(path.begin(), path.end());
  return path;
}

}  // namespace geotherm
