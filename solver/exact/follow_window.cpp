// SPDX-License-Identifier: MIT
// One window through one face.
#include <algorithm>
#include <cmath>

#include "solver/exact/propagation.h"

namespace geotherm {
namespace {

/// share / whole of the length; all of it where that is more, or no number.
double part_of_length(double length, double share, double whole) {
  return share < whole ? length * (share / whole) : length;
}

}  // namespace

void Propagation::follow(Window window) {
  const auto& frame = mesh_.side(window.side);
  const Index begin = frame.origin, end = mesh_.side(next_side(window.side)).origin;
  const Index apex = mesh_.side(previous_side(window.side)).origin;
  if (!trim_by_ends(window, frame.length, distance_at(begin), distance_at(end))) return;

  const auto apex_is_left_of = [&](double at) {
    return window.ray_x(at) * frame.apex_y - window.ray_y() * (frame.apex_x - at);
  };
  const double left_of_begin = apex_is_left_of(window.begin);
  const double left_of_end = apex_is_left_of(window.end);
  Passage passage{!(left_of_begin > 0), !(left_of_end < 0)};
  const bool meets_apex = passage.left && passage.right;
  if (meets_apex) {
    reach(apex, window.distance_to(frame.apex_x, frame.apex_y), window.group());
  } else {
    // The way along the outermost line, and then straight on from the side, exists as well. It is
    // what finds corners that stand in the gap of rounding between two windows.
    const double at = passage.left ? window.end : window.begin;
    const double rest = std::hypot(frame.apex_x - at, frame.apex_y);
    reach(apex, window.distance_at(at) + rest, window.group());
  }
  if (!yield_to_leader(window, frame.length, frame.apex_x, frame.apex_y,
                       leaders_[static_cast<std::size_t>(window.side)], passage)) {
    return;
  }
  if (passage.left) send_left(window, meets_apex);
  if (passage.right) send_right(window, meets_apex);
}

/// To the side from the apex to the first corner, in the frame from that corner.
void Propagation::send_left(const Window& w, bool from_apex) {
  const auto& frame = mesh_.side(w.side);
  const Side side = previous_side(w.side);
  const auto& target = mesh_.side(side);
  const double ex = frame.apex_x * target.inverse_length;
  const double ey = frame.apex_y * target.inverse_length;
  const auto place = [&](double at) {
    return part_of_length(target.length, w.ray_y() * at,
                          target.length * (w.ray_y() * ex - w.ray_x(at) * ey));
  };
  Window child = w;
  child.begin = place(w.begin);
  child.end = from_apex ? target.length : place(w.end);
  const double x = child.begin * ex, y = child.begin * ey;
  const double from_corner = distance_at(mesh_.side(next_side(w.side)).origin);
  if (from_corner + std::hypot(x - frame.length, y) < w.distance_to(x, y) * (1 - kTie)) return;
  child.x = w.x * ex + w.y * ey;
  child.y = w.y * ex - w.x * ey;
  child.y = w.is_plane() ? std::max(child.y, 0.0) : std::min(child.y, 0.0);
  cross(side, child, true);
}

/// To the side from the second corner to the apex, in its own frame.
void Propagation::send_right(const Window& w, bool from_apex) {
  const auto& frame = mesh_.side(w.side);
  const Side side = next_side(w.side);
  const auto& target = mesh_.side(side);
  const double ex = (frame.apex_x - frame.length) * target.inverse_length;
  const double ey = frame.apex_y * target.inverse_length;
  const auto place = [&](double at) {
    return part_of_length(target.length, w.ray_y() * (frame.length - at),
                          target.length * (w.ray_x(at) * ey - w.ray_y() * ex));
  };
  Window child = w;
  child.begin = place(w.end);
  child.end = from_apex ? target.length : place(w.begin);
  const double x = frame.length + child.begin * ex, y = child.begin * ey;
  const double from_corner = distance_at(frame.origin);
  if (from_corner + std::hypot(x, y) < w.distance_to(x, y) * (1 - kTie)) return;
  const double dx = w.is_plane() ? w.x : w.x - frame.length;
  child.x = dx * ex + w.y * ey;
  child.y = dx * ey - w.y * ex;
  child.y = w.is_plane() ? std::max(child.y, 0.0) : std::min(child.y, 0.0);
  if (w.is_plane()) child.sigma += w.x * frame.length;
  cross(side, child, false);
}

}  // namespace geotherm
