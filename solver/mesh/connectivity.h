// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geotherm/error.h"
#include "geotherm/types.h"
#include "solver/core/memory.h"

namespace geotherm {

/// Side k of face f joins its corners k and (k + 1) % 3; it is numbered 3 f + k.
using Side = std::int32_t;
inline constexpr Side kNoSide = -1;

inline Index face_of(Side side) { return side / 3; }
inline int corner_of(Side side) { return side % 3; }

/// Without branches: round a vertex k is anything, and a processor would guess it wrong.
inline int next_corner(int k) { return (1 << k) & 3; }
inline int previous_corner(int k) { return (0b010010 >> (2 * k)) & 3; }

/// Whether two corners of the face are one vertex, so that it has no inside.
inline bool repeats_corner(const Face& f) { return f[0] == f[1] || f[1] == f[2] || f[2] == f[0]; }
inline bool is_one_vertex(const Face& f) { return f[0] == f[1] && f[1] == f[2]; }

/// Whether each vertex belongs to a face that repeats no corner: 1 or 0.
std::vector<char> vertices_in_faces(Index vertex_count, std::span<const Face> faces);

/// The corners of a face list grouped by their vertex, ascending at each. Corner k of face f has
/// the number of the side that begins there, 3 f + k.
///
/// Cost: O(V + F), one counting sort, by all threads.
class CornerTable {
 public:
  CornerTable() = default;
  CornerTable(Index vertex_count, std::span<const Face> faces, int threads = 1);

  Index vertex_count() const { return static_cast<Index>(start_.size()) - 1; }
  std::span<const Side> at(Index vertex) const {
    const auto v = static_cast<std::size_t>(vertex);
    return {corner_.data() + start_[v], corner_.data() + start_[v + 1]};
  }

 private:
  std::vector<std::uint32_t> start_ = {0};
  RawVector<Side> corner_;
};

/// The sides of a face list grouped by the pair of vertices they join. An edge with one side is
/// on the boundary, with two an inner one, with more it is non-manifold.
///
/// Edges are sorted by (low vertex, high vertex); the sides of an edge by number.
/// Precondition: no face repeats a corner. Cost: O(F), by all threads; a counting sort less where
/// the corners at the vertices are known.
class EdgeTable {
 public:
  EdgeTable() = default;
  EdgeTable(Index vertex_count, std::span<const Face> faces, int threads = 1)
      : EdgeTable(CornerTable(vertex_count, faces, threads), faces, threads) {}
  EdgeTable(const CornerTable& corners, std::span<const Face> faces, int threads);

  Index edge_count() const { return static_cast<Index>(low_.size()); }
  Index low(Index edge) const { return low_[static_cast<std::size_t>(edge)]; }
  Index high(Index edge) const { return high_[static_cast<std::size_t>(edge)]; }
  std::span<const Side> sides(Index edge) const {
    const auto e = static_cast<std::size_t>(edge);
    return {sides_.data() + first_[e], sides_.data() + first_[e + 1]};
  }

 private:
  RawVector<Index> low_, high_;
  RawVector<std::uint32_t> first_ = {0};  ///< one more than there are edges
  RawVector<Side> sides_;
};

/// The vertices and edges of a mesh as a graph to walk on. Immutable; keeps a view of `positions`.
class EdgeGraph {
 public:
  EdgeGraph(std::span<const Vec3> positions, const EdgeTable& edges);

  /// True when a mesh edge joins the two.
  bool adjacent(Index a, Index b) const;

  /// The shortest path along edges, both ends included: the vertices in order (one when
  /// from == to). Errors: kBadInput where no path leads from one to the other.
  /// Cost: Dijkstra's, guided by the straight distance to `to`.
  Result<std::vector<Index>> shortest_path(Index from, Index to) const;

 private:
  std::span<const Index> neighbours(Index v) const {
    return {neighbours_.data() + start_[v], neighbours_.data() + start_[v + 1]};
  }

  std::span<const Vec3> positions_;
  std::vector<std::uint32_t> start_;
  RawVector<Index> neighbours_;
};

}  // namespace geotherm
