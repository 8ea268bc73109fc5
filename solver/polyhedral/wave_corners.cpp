// SPDX-License-Identifier: MIT
#include "solver/polyhedral/wave_corners.h"

#include <algorithm>
#include <atomic>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "solver/core/parallel.h"
#include "solver/core/sorting.h"
#include "solver/polyhedral/wave_order.h"

namespace geotherm {
namespace {

/// Minimum vertices per thread.
constexpr std::int64_t kMinCornersPerThread = 1 << 13;

/// A vertex whose longest side is longer than its shortest by this factor passes its distance on by
/// itself: its fall may not change the samples far out on a long side, and would not reach the
/// faces beyond.
constexpr double kStretched = 6;

bool is_stretched(const WaveTables& tables, std::span<const SideCode> corners) {
  double longest = 0, shortest = kUnreached;
  for (const SideCode c : corners) {
    const auto& length = tables.faces[face_of_code(c)].length;
    for (const int side : {corner_of_code(c), previous_corner(corner_of_code(c))}) {
      longest = std::max(longest, length[side]);
      shortest = std::min(shortest, length[side]);
    }
  }
  return longest > kStretched * shortest;
}

/// Sets the bits of the corners at a vertex; another vertex of the face may be at it meanwhile.
void set_bits(std::uint16_t WaveFace::*bits, unsigned first, std::span<const SideCode> corners,
              WaveTables& tables) {
  for (const SideCode c : corners) {
    std::atomic_ref(tables.faces[face_of_code(c)].*bits)
        .fetch_or(static_cast<std::uint16_t>(1U << (first + corner_of_code(c))),
                  std::memory_order_relaxed);
  }
}

/// By which the faces at a vertex are put in order: the places of their other two corners, and
/// their numbers in the intrinsic mesh.
auto face_place(const IntrinsicSurface& base, const WaveTables& tables, SideCode corner) {
  const WaveFace& face = tables.faces[face_of_code(corner)];
  const int k = corner_of_code(corner);
  const auto place = [&](int i) { return order_of(base, tables.vertex_of_rank[face.vertex[i]]); };
  return std::tuple(std::minmax({place(next_corner(k)), place(previous_corner(k))}),
                    tables.intrinsic_face[face_of_code(corner)], k);
}

/// Marks the corners at vertices whose faces are not all joined by edges at the vertex, where a
/// wave has to be passed from fan to fan.
class FanMarker {
 public:
  explicit FanMarker(WaveTables& tables) : tables_(tables), fans_(4 * tables.faces.size()) {}

  void run(int threads) {
    for (Index e = 0; e < tables_.edge_count(); ++e) {
      for (const SideCode side : tables_.other_sides(e)) join_ends(tables_.sides[e][0], side);
    }
    fan_ = std::move(fans_).roots();
    parallel_each<Index>(threads, tables_.vertex_count(), kMinCornersPerThread,
                         [this](Index v) { mark(tables_.corners_at(v)); });
  }

 private:
  static SideCode next_code(SideCode code) {
    return (code & ~3) | next_corner(corner_of_code(code));
  }
  bool runs_back(SideCode code) const {
    return (tables_.faces[face_of_code(code)].reversed >> corner_of_code(code) & 1) != 0;
  }
  void join_ends(SideCode first, SideCode other) {
    const SideCode begin = runs_back(other) ? next_code(other) : other;
    const SideCode end = runs_back(other) ? other : next_code(other);
    fans_.join(first, begin);
    fans_.join(next_code(first), end);
  }
  void mark(std::span<const SideCode> corners) {
    const auto elsewhere = [&](SideCode c) { return fan_[c] != fan_[corners.front()]; };
    if (std::ranges::any_of(corners, elsewhere)) {
      set_bits(&WaveFace::reversed, kFanBits, corners, tables_);
    }
  }

  WaveTables& tables_;
  DisjointSets fans_;       ///< of corners
  std::vector<Index> fan_;  ///< of a corner: another one of its fan
};

}  // namespace

void list_corners(WaveTables& tables, int threads) {
  const auto emit = [&tables](std::size_t f, const auto& put) {
    for (int k = 0; k < 3; ++k) put(tables.faces[f].vertex[k], static_cast<SideCode>(4 * f) + k);
  };
  tables.corners = counting_sort<SideCode>(tables.faces.size(), tables.vertex_of_rank.size(),
                                           threads, emit, tables.corner_start);
}

void mark_fans(WaveTables& tables, int threads) { FanMarker(tables).run(threads); }

void mark_touching(WaveTables& tables, int threads, const IntrinsicSurface& base) {
  parallel_each<Index>(threads, tables.vertex_count(), kMinCornersPerThread, [&](Index v) {
    const auto corners = tables.corners_at(v);
    if (!fans_touch(tables, v) && !is_stretched(tables, corners)) return;
    set_bits(&WaveFace::touching, 0, corners, tables);
    SideCode* const first = tables.corners.data() + tables.corner_start[v];
    std::sort(first, first + corners.size(), [&](SideCode a, SideCode b) {
      return face_place(base, tables, a) < face_place(base, tables, b);
    });
  });
}

}  // namespace geotherm
