// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/polyhedral/wave_surface.h"

namespace geotherm {

/// A surface as window propagation reads it, with the data of each side in one place. Immutable.
/// Cost of building it: O(F).
class WindowMesh {
 public:
  /// A side in the frame of Window.
  struct SideFrame {
    double length, inverse_length;
    double apex_x, apex_y;  ///< the opposite corner, apex_y > 0
    Index origin;           ///< vertex of the first corner; that of the second is next's
    std::int32_t across;    ///< 2 side + (it runs the other way), kBoundary, or a branch
  };
  static constexpr std::int32_t kBoundary = -1;
  static constexpr std::int32_t kBranch = -2;  ///< kBranch - i: the non-manifold edge i of those

  /// Precondition: no inserted vertices.
  explicit WindowMesh(const WaveSurface& surface);

  const SideFrame& side(Side s) const { return sides_[static_cast<std::size_t>(s)]; }
  Index side_count() const { return static_cast<Index>(sides_.size()); }
  Index vertex_count() const { return static_cast<Index>(sends_.size()); }

  /// Whether shortest paths may bend at the vertex: its angle is more than 2 pi, on the boundary
  /// more than pi, or it is at an edge with three faces or more, or its faces form several fans.
  bool sends(Index vertex) const { return sends_[static_cast<std::size_t>(vertex)] != 0; }

  /// The sides opposite to the vertex's corners.
  std::span<const Side> opposite_sides(Index vertex) const {
    const auto v = static_cast<std::size_t>(vertex);
    return {opposite_.data() + first_opposite_[v], opposite_.data() + first_opposite_[v + 1]};
  }

  /// Calls visit(other side, whether that runs the other way) for each face beyond the side.
  template <class Visit>
  void for_each_across(Side s, Visit&& visit) const {
    const std::int32_t across = side(s).across;
    if (across >= 0) {
      visit(across >> 1, (across & 1) != 0);
    } else if (across <= kBranch) {
      for (const Side other : surface_->sides_of(surface_->edge_of_side(s))) {
        if (other != s) visit(other, side(other).origin != side(s).origin);
      }
    }
  }

  /// Vertices in some face.
  Index vertices_in_use() const { return vertices_in_use_; }
  Index branch_count() const { return branch_count_; }
  double bytes() const;

 private:
  void lay_out_sides();
  void find_corners();
  void find_bends();

  const WaveSurface* surface_;
  std::vector<SideFrame> sides_;
  std::vector<std::uint32_t> first_opposite_;
  RawVector<Side> opposite_;
  std::vector<char> sends_;
  Index vertices_in_use_ = 0;
  Index branch_count_ = 0;
};

inline Side next_side(Side s) { return corner_of(s) == 2 ? s - 2 : s + 1; }
inline Side previous_side(Side s) { return corner_of(s) == 0 ? s + 2 : s - 1; }

}  // namespace geotherm
