// SPDX-License-Identifier: MIT
#include "solver/polyhedral/wave_sides.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

#include "solver/core/parallel.h"
#include "solver/core/sorting.h"
#include "solver/polyhedral/wave_order.h"

namespace geotherm {
namespace {

/// Minimum faces or edges per thread.
constexpr std::int64_t kSideGrain = 1 << 14;

class SideJoiner {
 public:
  SideJoiner(const IntrinsicSurface& base, WaveTables& tables)
      : base_(base),
        mesh_(base.intrinsic),
        tables_(tables),
        x_(static_cast<std::size_t>(tables.vertex_count())) {
    for (std::size_t rank = 0; rank < x_.size(); ++rank) {
      x_[rank] = base.position(tables.vertex_of_rank[rank])[0];
    }
  }

  void run(int threads) {
    const auto join = [this](std::int64_t begin, std::int64_t end, std::vector<SideCode>& alone) {
      join_twins(begin, end, alone);
    };
    const std::int64_t faces = std::ssize(tables_.faces);
    join_others(list_in_parallel<SideCode>(threads, faces, kSideGrain, join));
  }

  void run_again(const std::vector<char>& changed, int threads) {
    const auto find = [&](std::int64_t begin, std::int64_t end, std::vector<Index>& turned) {
      find_turned(changed, begin, end, turned);
    };
    const std::int64_t edges = std::ssize(tables_.sides);
    std::vector<SideCode> alone;
    for (const Index edge : list_in_parallel<Index>(threads, edges, kSideGrain, find)) {
      const auto [first, second] = tables_.sides[edge];
      if (second >= 0) {
        join_pair(side_of(first));
      } else {
        list_again(first, second, changed, alone);
      }
    }
    tables_.more.clear();
    for_each_with_value(changed, char{1}, [&](Index face) {
      for (SideCode code = 4 * face; code < 4 * face + 3; ++code) {
        if (mesh_.twin[side_of(code)] == kNoSide) {
          alone.push_back(code);
        } else {
          join_pair(side_of(code));
        }
      }
    });
    join_others(alone);
  }

 private:
  SideCode code_of(Side side) const {
    return static_cast<SideCode>(4 * tables_.rank_of_face[face_of(side)] + corner_of(side));
  }
  Side side_of(SideCode code) const {
    return 3 * tables_.intrinsic_face[face_of_code(code)] + corner_of_code(code);
  }
  Index edge_of(SideCode code) const {
    return tables_.faces[face_of_code(code)].edge[corner_of_code(code)];
  }
  WaveOrder start(Side side) const {
    return order_of(base_, mesh_.faces[face_of(side)][corner_of(side)]);
  }
  Index beyond(SideCode code) const {
    return tables_.faces[face_of_code(code)].vertex[previous_corner(corner_of_code(code))];
  }

  /// Whether the face of one side of an edge comes before that of another: by the place of its
  /// corner beyond the edge, since they have the others in common.
  bool comes_first(SideCode side, SideCode other) const {
    const Index here = beyond(side), there = beyond(other);
    if (x_[here] != x_[there]) return x_[here] < x_[there];
    if (here != there) {
      return order_of(base_, tables_.vertex_of_rank[here]) <
             order_of(base_, tables_.vertex_of_rank[there]);
    }
    const Side s = side_of(side), t = side_of(other);
    return face_of(s) != face_of(t) ? s < t : place_in_face(s) < place_in_face(t);
  }

  /// Counted from where the smallest of the three rotations of the face begins.
  int place_in_face(Side side) const {
    const Side first = 3 * face_of(side);
    const auto from = [&](int k) {
      return std::array{start(first + k), start(first + next_corner(k)),
                        start(first + previous_corner(k))};
    };
    int best = 0;
    for (const int k : {1, 2}) best = from(k) < from(best) ? k : best;
    return (corner_of(side) + 3 - best) % 3;
  }

  /// `alone`: gets the sides that have no twin.
  void join_twins(std::int64_t begin, std::int64_t end, std::vector<SideCode>& alone) {
    for (std::int64_t i = begin; i < end; ++i) {
      for (int k = 0; k < 3; ++k) {
        const auto code = static_cast<SideCode>(4 * i) + k;
        const Side twin = mesh_.twin[side_of(code)];
        if (twin == kNoSide) {
          alone.push_back(code);
        } else if (comes_first(code, code_of(twin))) {
          tables_.sides[edge_of(code)] = {code, code_of(twin)};
        } else {
          set_reversed(code, true);
        }
      }
    }
  }

  /// Edges between faces that are not changed whose first side comes after the second now, and all
  /// with several sides that are no twins.
  void find_turned(const std::vector<char>& changed, std::int64_t begin, std::int64_t end,
                   std::vector<Index>& turned) const {
    for (std::int64_t edge = begin; edge < end; ++edge) {
      fetch_faces_of(std::min(edge + kFetchedAhead, end - 1));
      const auto [first, second] = tables_.sides[edge];
      const bool stays = second < 0
                             ? second == kNoSideCode
                             : changed[face_of_code(first)] != 0 ||
                                   changed[face_of_code(second)] != 0 || comes_first(first, second);
      if (!stays) turned.push_back(static_cast<Index>(edge));
    }
  }

  void fetch_faces_of(std::int64_t edge) const {
    const auto [first, second] = tables_.sides[edge];
    __builtin_prefetch(&tables_.faces[face_of_code(first)].vertex);
    if (second >= 0) __builtin_prefetch(&tables_.faces[face_of_code(second)].vertex);
  }

  void join_pair(Side side) {
    SideCode first = code_of(side), second = code_of(mesh_.twin[side]);
    if (!comes_first(first, second)) std::swap(first, second);
    tables_.sides[edge_of(first)] = {first, second};
    set_reversed(first, false);
    set_reversed(second, true);
  }

  /// Adds the sides of an edge with several of them that are those from before.
  void list_again(SideCode first, SideCode second, const std::vector<char>& changed,
                  std::vector<SideCode>& alone) const {
    const SideCode* const list = &tables_.more[static_cast<std::size_t>(-2 - second)];
    std::vector<SideCode> sides(list + 1, list + 1 + list[0]);
    sides.push_back(first);
    std::ranges::copy_if(sides, std::back_inserter(alone),
                         [&](SideCode side) { return changed[face_of_code(side)] == 0; });
  }

  /// The boundary, and edges whose sides are no twins.
  void join_others(const std::vector<SideCode>& alone) {
    for (const SideCode side : alone) tables_.sides[edge_of(side)] = {kNoSideCode, kNoSideCode};
    std::vector<SideCode> further;
    for (const SideCode side : alone) {
      SideCode& first = tables_.sides[edge_of(side)][0];
      if (first == kNoSideCode) {
        first = side;
        set_reversed(side, false);
      } else {
        further.push_back(side);
      }
    }
    std::ranges::stable_sort(further, {}, [this](SideCode side) { return edge_of(side); });
    for (auto at = further.begin(); at != further.end();) {
      const Index edge = edge_of(*at);
      std::vector<SideCode> sides = {tables_.sides[edge][0]};
      for (; at != further.end() && edge_of(*at) == edge; ++at) sides.push_back(*at);
      list(sides, tables_.sides[edge]);
    }
  }

  void list(std::vector<SideCode>& sides, std::array<SideCode, 2>& out) {
    std::ranges::sort(sides, [this](SideCode a, SideCode b) { return comes_first(a, b); });
    out = {sides[0], -2 - static_cast<SideCode>(tables_.more.size())};
    tables_.more.push_back(static_cast<SideCode>(sides.size()) - 1);
    tables_.more.insert(tables_.more.end(), sides.begin() + 1, sides.end());
    for (const SideCode side : sides) {
      set_reversed(side, start(side_of(side)) != start(side_of(sides[0])));
    }
  }

  void set_reversed(SideCode code, bool reversed) {
    std::uint16_t& bits = tables_.faces[face_of_code(code)].reversed;
    const unsigned bit = 1U << corner_of_code(code);
    bits = static_cast<std::uint16_t>(reversed ? bits | bit : bits & ~bit);
  }

  const IntrinsicSurface& base_;
  const IntrinsicMesh& mesh_;
  WaveTables& tables_;
  RawVector<double> x_;  ///< of each vertex in the tables: nearly always tells which comes first
};

}  // namespace

void set_lengths(const std::array<double, 3>& lengths, WaveFace& face, SideLengths& block) {
  const FaceLayout layout = lay_out(lengths);
  face.length = lengths;
  face.twice_area = layout.base * layout.height;
  for (const double length : lengths) {
    block.sum += length;
    block.longest = std::max(block.longest, length);
  }
}

void sum_up(std::span<const SideLengths> blocks, WaveTables& tables) {
  double sum = 0;
  tables.longest_side = 0;
  for (const SideLengths& block : blocks) {
    sum += block.sum;
    tables.longest_side = std::max(tables.longest_side, block.longest);
  }
  // In whatever order it was added: it says where one bucket of a wave ends and the next begins.
  constexpr double kDigits = 1 << 24;
  int exponent = 0;
  const double mean = std::frexp(sum / (3.0 * static_cast<double>(tables.faces.size())), &exponent);
  tables.mean_side = std::ldexp(std::round(mean * kDigits) / kDigits, exponent);
}

void join_sides(const IntrinsicSurface& base, int threads, WaveTables& tables) {
  SideJoiner(base, tables).run(threads);
}

void rejoin_sides(const IntrinsicSurface& base, const std::vector<char>& changed, int threads,
                  WaveTables& tables) {
  SideJoiner(base, tables).run_again(changed, threads);
}

}  // namespace geotherm
