// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <numbers>
#include <span>
#include <vector>

#include "solver/mesh/connectivity.h"
#include "solver/polyhedral/wave_surface.h"

namespace geotherm {

/// Places in the plane of a triangle with these sides: corner 0 at the origin, corner 1 on the x
/// axis.
inline std::array<Eigen::Vector2d, 3> corners_of(const std::array<double, 3>& lengths) {
  return corners_of(lay_out(lengths));
}

/// How the corners at each vertex of a triangulation without flips follow each other, and the
/// directions in which they begin. Immutable. Cost: O(F).
class TangentFans {
 public:
  enum class Kind : char {
    kNone,      ///< in no face
    kInner,     ///< one closed fan
    kBoundary,  ///< one open fan
    kSplit,     ///< several fans, or an edge with three faces or more
  };
  struct Corner {
    double begin = 0, angle = 0;  ///< radians, not scaled
    bool against = false;         ///< the fan runs against the orientation of the face
  };
  struct Vertex {
    Kind kind = Kind::kNone;
    double angle = 0;      ///< of all corners
    Side first = kNoSide;  ///< the corner with which the fan begins
    /// The factor from angles of corners to directions.
    double scale() const { return kind == Kind::kInner ? 2 * std::numbers::pi / angle : 1; }
  };

  explicit TangentFans(const WaveSurface& surface);

  const Corner& corner(Side c) const { return corners_[static_cast<std::size_t>(c)]; }
  const Vertex& vertex(Index v) const { return vertices_[static_cast<std::size_t>(v)]; }
  /// The corners of a vertex, ascending.
  std::span<const Side> corners_at(Index v) const { return table_.at(v); }
  /// The other end of the side with which a corner begins.
  Index first_end(Side c) const;
  /// The corner in which an angle of the fan lies, kNoSide where it is beyond the boundary.
  Side corner_at(Index v, double angle) const;

 private:
  bool walk(Index v, Side start, bool against);
  void find_fan(Index v);

  const WaveSurface& surface_;
  CornerTable table_;
  std::vector<Corner> corners_;
  std::vector<Vertex> vertices_;
};

}  // namespace geotherm
