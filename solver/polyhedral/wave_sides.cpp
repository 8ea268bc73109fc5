// SPDX-License-Identifier: MIT
#include "solver/polyhedral/wave_sides.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "solver/core/parallel.h"

namespace geotherm {
namespace {

class SideJoiner {
 public:
  SideJoiner(const IntrinsicMesh& mesh, WaveTables& tables) : mesh_(mesh), tables_(tables) {}

  void run(int threads) {
    join_others(in_blocks(threads, [this](std::int64_t begin, std::int64_t end) {
                  return join_twins(begin, end);
                }).alone);
  }

  void run_again(const std::vector<char>& changed, int threads) {
    Found found = in_blocks(threads, [&](std::int64_t begin, std::int64_t end) {
      return find_changes(changed, begin, end);
    });
    for (const Side side : found.twins) join_pair(side, mesh_.twin[side]);
    join_others(found.alone);
  }

 private:
  struct SideOfEdge {
    Index edge;
    SideCode side;
  };
  using SidesOfEdges = std::vector<SideOfEdge>;
  struct Found {
    SidesOfEdges alone;       ///< sides that have no twin
    std::vector<Side> twins;  ///< whose edges are to be joined anew
  };

  template <class Pass>
  Found in_blocks(int threads, const Pass& pass) const {
    Found all;
    for (const Found& block : sums_of_blocks<Found>(threads, std::ssize(tables_.faces), pass)) {
      all.alone.insert(all.alone.end(), block.alone.begin(), block.alone.end());
      all.twins.insert(all.twins.end(), block.twins.begin(), block.twins.end());
    }
    return all;
  }

  SideCode code_of(Side side) const {
    return static_cast<SideCode>(4 * tables_.rank_of_face[face_of(side)] + corner_of(side));
  }
  Side side_of(SideCode code) const {
    return 3 * tables_.intrinsic_face[face_of_code(code)] + corner_of_code(code);
  }
  Place start(Side side) const {
    return tables_.place(mesh_.faces[face_of(side)][corner_of(side)]);
  }
  Place beyond(Side side) const {
    return tables_.place(mesh_.faces[face_of(side)][previous_corner(corner_of(side))]);
  }

  /// Whether the face of one side of an edge comes before that of another: by its corner beyond the
  /// edge, since they have the others in common.
  bool comes_first(Side side, Side other) const {
    const Place here = beyond(side), there = beyond(other);
    if (here != there) return here < there;
    if (face_of(side) != face_of(other)) return face_of(side) < face_of(other);
    return place_in_face(side) < place_in_face(other);
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

  Found join_twins(std::int64_t begin, std::int64_t end) {
    Found found;
    for (std::int64_t i = begin; i < end; ++i) {
      WaveFace& face = tables_.faces[i];
      for (int k = 0; k < 3; ++k) {
        const Side side = 3 * tables_.intrinsic_face[i] + k;
        const Side twin = mesh_.twin[side];
        if (twin == kNoSide) {
          found.alone.push_back({face.edge[k], code_of(side)});
        } else if (comes_first(side, twin)) {
          tables_.sides[face.edge[k]] = {code_of(side), code_of(twin)};
        } else {
          set_reversed(side, true);
        }
      }
    }
    return found;
  }

  /// Edges with other faces than before, and those whose first side comes after the second now.
  Found find_changes(const std::vector<char>& changed, std::int64_t begin, std::int64_t end) {
    Found found;
    for (std::int64_t i = begin; i < end; ++i) {
      WaveFace& face = tables_.faces[i];
      for (int k = 0; k < 3; ++k) {
        const Side side = 3 * tables_.intrinsic_face[i] + k;
        const Side twin = mesh_.twin[side];
        if (twin == kNoSide) {
          set_reversed(side, false);
          found.alone.push_back({face.edge[k], code_of(side)});
        } else if (changed[i] != 0) {
          found.twins.push_back(side);
        } else if ((face.reversed >> k & 1U) == 0 && !comes_first(side, twin)) {
          found.twins.push_back(side);
        }
      }
    }
    return found;
  }

  void join_pair(Side side, Side twin) {
    if (!comes_first(side, twin)) std::swap(side, twin);
    const Index edge = tables_.faces[tables_.rank_of_face[face_of(side)]].edge[corner_of(side)];
    tables_.sides[edge] = {code_of(side), code_of(twin)};
    set_reversed(side, false);
    set_reversed(twin, true);
  }

  /// The boundary, and edges whose sides are no twins.
  void join_others(const SidesOfEdges& alone) {
    for (const auto& [edge, side] : alone) tables_.sides[edge] = {kNoSideCode, kNoSideCode};
    SidesOfEdges further;
    for (const auto& [edge, side] : alone) {
      if (tables_.sides[edge][0] == kNoSideCode) {
        tables_.sides[edge][0] = side;
      } else {
        further.push_back({edge, side});
      }
    }
    std::ranges::stable_sort(further, {}, &SideOfEdge::edge);
    for (auto at = further.begin(); at != further.end();) {
      const Index edge = at->edge;
      std::vector<SideCode> sides = {tables_.sides[edge][0]};
      for (; at != further.end() && at->edge == edge; ++at) sides.push_back(at->side);
      list(sides, tables_.sides[edge]);
    }
  }

  void list(std::vector<SideCode>& sides, std::array<SideCode, 2>& out) {
    std::ranges::sort(
        sides, [this](SideCode a, SideCode b) { return comes_first(side_of(a), side_of(b)); });
    out[0] = sides[0];
    out[1] = sides.size() == 2 ? sides[1] : -2 - static_cast<SideCode>(tables_.more.size());
    if (sides.size() > 2) {
      tables_.more.push_back(static_cast<SideCode>(sides.size()) - 1);
      tables_.more.insert(tables_.more.end(), sides.begin() + 1, sides.end());
    }
    for (const SideCode side : sides) {
      set_reversed(side_of(side), start(side_of(side)) != start(side_of(sides[0])));
    }
  }

  void set_reversed(Side side, bool reversed) {
    std::uint16_t& bits = tables_.faces[tables_.rank_of_face[face_of(side)]].reversed;
    const unsigned bit = 1U << corner_of(side);
    bits = static_cast<std::uint16_t>(reversed ? bits | bit : bits & ~bit);
  }

  const IntrinsicMesh& mesh_;
  WaveTables& tables_;
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

void join_sides(const IntrinsicMesh& mesh, int threads, WaveTables& tables) {
  SideJoiner(mesh, tables).run(threads);
}

void rejoin_sides(const IntrinsicMesh& mesh, const std::vector<char>& changed, int threads,
                  WaveTables& tables) {
  SideJoiner(mesh, tables).run_again(changed, threads);
}

}  // namespace geotherm
