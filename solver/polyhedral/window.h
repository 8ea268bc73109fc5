// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "geotherm/types.h"
#include "solver/mesh/connectivity.h"

namespace geotherm {

/// The part of a side through which straight lines from one source enter the side's face, all of
/// them over the same faces. In the frame of the side (its first corner at the origin, its second
/// at (length, 0), the face above) the source, unfolded, stands at (x, y), y <= 0: the distance at
/// p is sigma + |p - (x, y)|. A plane wave has its unit direction (x, y), y >= 0, there instead,
/// and the distance sigma + x p.x + y p.y. Source: Mitchell, Mount, Papadimitriou 1987.
struct Window {
  double begin, end;  ///< 0 <= begin <= end <= length
  double x, y;
  double sigma;
  Side side;           ///< or ~vertex: an event, the vertex sends windows of its own from sigma
  std::int32_t label;  ///< 64 group + flags
  double turn = 0;     ///< start_direction_to(), where start directions are followed

  static constexpr std::int32_t kPlane = 1;
  static constexpr std::int32_t kFromFace = 2;  ///< from a point that is no vertex
  static constexpr std::int32_t kBranched = 4;  ///< over an edge with three faces or more

  static constexpr std::int32_t kMerged = 8;     ///< over flat vertices
  static constexpr std::int32_t kMirrored = 16;  ///< start directions fall as those of lines rise
  static constexpr std::int32_t kBent = 32;      ///< round a vertex: all start as `turn` says

  bool is(std::int32_t flag) const { return (label & flag) != 0; }
  bool is_plane() const { return is(kPlane); }
  Index group() const { return label >> 6; }
  static std::int32_t label_of(Index group, std::int32_t flags = 0) { return 64 * group + flags; }

  double distance_to(double px, double py) const {
    if (is_plane()) return sigma + x * px + y * py;
    const double dx = px - x, dy = py - y;
    return sigma + std::sqrt(dx * dx + dy * dy);
  }
  double distance_at(double px) const { return distance_to(px, 0); }

  /// A multiple of the direction in which the line through (px, 0) enters the face.
  double ray_x(double px) const { return is_plane() ? x : px - x; }
  double ray_y() const { return is_plane() ? y : -y; }

  /// The direction at the source in which the line to a point ahead leaves it, radians: `turn` plus
  /// or minus the angle of the line in this frame. Not of plane waves.
  double start_direction_to(double px, double py) const {
    if (is(kBent)) return turn;
    const double angle = std::atan2(py - y, px - x);
    return is(kMirrored) ? turn - angle : turn + angle;
  }
  /// What is to be done beside a rotation of the frame by `angle`, a reflection of its second axis,
  /// and reverse(), so that start directions stay what they are.
  void rotate_start(double angle) {
    if (!is(kBent)) turn += is(kMirrored) ? -angle : angle;
  }
  void mirror_start() { label ^= kMirrored; }
  void reverse_start() {
    rotate_start(std::numbers::pi);
    mirror_start();
  }

  /// The smallest distance in the window, and where along the side.
  double nearest_place() const {
    if (is_plane()) return x > 0 ? begin : end;
    return x < begin ? begin : (x > end ? end : x);
  }

  /// The same window in the frame that runs the other way.
  void reverse(double length) {
    const double old_begin = begin;
    begin = length - end;
    end = length - old_begin;
    if (is_plane()) {
      sigma += x * length;
      x = -x;
    } else {
      x = length - x;
    }
  }
};

/// Distances closer than this to each other count as equal, relative to themselves: round-off.
inline constexpr double kTie = 1e-13;

/// Places on a side closer than this to each other, relative to its length, count as one.
inline constexpr double kOrder = 1e-9;

/// Whether the places, unfolded, and the distances of two windows' sources are one but for
/// round-off.
bool have_same_source(const Window& a, const Window& b);

/// Trims the parts of a window that its side's ends, at these distances, reach sooner along the
/// side (Xin, Wang 2009, theorem 3.2, applied to parts of windows as well). Returns false when
/// nothing is left. Ties stay.
bool trim_by_ends(Window& window, double length, double at_origin, double at_length);

/// The shortest line so far to the corner opposite to a side, and the window that it lies in.
struct Leader {
  double distance = kUnreached;
  double crossing = 0;  ///< where the line crosses the side
  Window window{};
};

/// On which sides of the corner ahead a window's lines pass.
struct Passage {
  bool left, right;
};

/// Trims the part of a window that crosses a shorter line to the corner at (apex_x, apex_y) (Chen,
/// Han 1990: one angle, one split); a window with a shorter line becomes the leader. `passage`: the
/// sides to which the window goes, both where it has a line to the corner. Returns false when
/// nothing is left.
bool yield_to_leader(Window& window, double length, double apex_x, double apex_y, Leader& leader,
                     Passage& passage);

/// Trims the ends of a window where another window on the same edge gives no larger distances. Both
/// are in one frame of the edge, from any of its faces. Returns false when nothing is left. A
/// dominated part in the middle stays. (Complete trimming: Mitchell, Mount, Papadimitriou 1987.)
bool trim_dominated_ends(Window& window, const Window& other, double length);

/// The frame of a side of a face in its layout.
struct SideAxes {
  Eigen::Vector2d origin, along, inward;
  SideAxes(const std::array<Eigen::Vector2d, 3>& corners, int k, double length)
      : origin(corners[k]),
        along((corners[next_corner(k)] - origin) / length),
        inward(-along.y(), along.x()) {}
};

/// Trims an interval to the places where lower + slope * place >= 0.
inline void keep_above_zero(double lower, double slope, double& begin, double& end) {
  if (slope > 0) begin = std::max(begin, -lower / slope);
  if (slope < 0) end = std::min(end, -lower / slope);
  if (slope == 0 && lower < 0) end = begin;
}

}  // namespace geotherm
