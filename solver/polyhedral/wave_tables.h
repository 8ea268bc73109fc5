// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "solver/core/memory.h"
#include "solver/polyhedral/wave_surface.h"

namespace geotherm {

/// One face as a wave reads it: a cache line. Corners as in IntrinsicMesh, side k from corner k to
/// corner k + 1.
struct alignas(64) WaveFace {
  std::array<Index, 3> vertex, edge;  ///< numbers of WaveTables
  std::array<double, 3> length;       ///< of the sides, in units of the intrinsic mesh
  double twice_area;
  std::uint16_t reversed;  ///< bit k: side k runs against the direction of its edge; bit 4 + k: at
                           ///< corner k several fans of faces touch
  std::uint16_t touching;  ///< bit k: at corner k several fans of faces touch, or sides are of very
                           ///< different lengths: the vertex hands its distance on by itself
};

/// Face 4 f + k stands for side k of face f, so that neither needs a division.
using SideCode = std::int32_t;
inline constexpr SideCode kNoSideCode = -1;
inline Index face_of_code(SideCode code) { return code >> 2; }
inline int corner_of_code(SideCode code) { return code & 3; }

/// A WaveSurface laid out for one pass over memory: vertices in Morton order, faces and edges in
/// the order in which that meets them, whatever the order of the file; those of a surface that has
/// moved have the numbers from before. What a wave visits first is told by where vertices are, so
/// that both give the same distances. Immutable. An edge has the direction of its first side.
struct WaveTables {
  RawVector<WaveFace> faces;
  /// Each edge's first side and its twin. The second is kNoSideCode at the boundary; where there
  /// are others that are no twins, -2 - i, and more[i] holds their number and then all of them.
  RawVector<std::array<SideCode, 2>> sides;
  std::vector<SideCode> more;

  std::vector<Index> rank_of_vertex;  ///< V and inserted: number here, kNoIndex when in no face
  std::vector<Index> vertex_of_rank;  ///< n
  std::vector<Index> rank_of_face;    ///< F: number here of a face of the intrinsic mesh
  RawVector<Index> intrinsic_face;    ///< F: the inverse
  std::vector<std::uint32_t> corner_start;  ///< n + 1
  RawVector<SideCode> corners;  ///< at each vertex, as the code of the side that begins there

  double mean_side = 0, longest_side = 0;  ///< the mean to eight digits

  std::span<const SideCode> corners_at(Index rank) const {
    return {corners.data() + corner_start[rank], corners.data() + corner_start[rank + 1]};
  }
  /// The sides of an edge beside its first.
  std::span<const SideCode> other_sides(Index edge) const {
    const SideCode& second = sides[edge][1];
    if (second >= 0) return {&second, 1};
    if (second == kNoSideCode) return {};
    const SideCode* const list = &more[static_cast<std::size_t>(-2 - second)];
    return {list + 1, static_cast<std::size_t>(list[0])};
  }
  Index vertex_count() const { return static_cast<Index>(vertex_of_rank.size()); }
  Index edge_count() const { return static_cast<Index>(sides.size()); }
  std::size_t bytes() const;
};

/// Builds the tables of a surface; they do not depend on the number of threads. Cost:
/// O(F + V log V).
WaveTables build_wave_tables(const WaveSurface& surface, int threads = 1);

/// Whether the tables of one surface can be made from those of another: the same clean faces with
/// nothing but flips, wherever the vertices are.
bool can_move_tables(const IntrinsicSurface& before, const IntrinsicSurface& now);

/// The same, from the tables of `before`: with other numbers, and the same distances. Precondition:
/// can_move_tables(). `memory`: tables that nobody needs any more, or none. Cost: O(F), less than a
/// third of the above.
WaveTables moved_wave_tables(const WaveTables& earlier, const WaveSurface& before,
                             const WaveSurface& surface, int threads = 1, WaveTables memory = {});

}  // namespace geotherm
