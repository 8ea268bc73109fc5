// SPDX-License-Identifier: MIT
#include "solver/polyhedral/near_windows.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "solver/polyhedral/wave_corners.h"

namespace geotherm {
namespace {

using NearPoint = Eigen::Vector2d;

/// How far windows go, in longest sides of the faces that they came through. Four would halve
/// the error, in ten times the time.
constexpr double kNearSides = 1;
/// Angles up to this much above that of a plane count as flat.
constexpr double kFlatNear = 1e-9;
/// A window is trimmed by no more than the latest so many of an edge, which curves of thousands of
/// pieces in one face would fill: one that is wider than it need be lowers nothing.
constexpr std::size_t kMostBeside = 64;
/// No more windows than this many, and one for so many faces, are followed.
constexpr std::size_t kMostNear = 50000, kFacesPerWindow = 2;

/// In the frame of a side a source inside the face is below it.
struct NearAxes : SideAxes {
  using SideAxes::SideAxes;

  /// A window of a source, without its part of the side.
  Window window(const NearPoint& source, double sigma, std::int32_t label) const {
    const NearPoint to = source - origin;
    return {0, 0, to.dot(along), std::min(-to.dot(inward), 0.0), sigma, 0, label};
  }
  /// The same of a plane wave, by its distance at the layout's origin. One with y <= 0 does not
  /// come through the side.
  Window plane(const NearPoint& direction, double at_zero, std::int32_t label) const {
    return {0, 0,    direction.dot(along), -direction.dot(inward), at_zero + direction.dot(origin),
            0, label};
  }
};

/// Where the line to (px, py), py > 0, crosses the side.
double crossing_of(const Window& w, double px, double py) {
  if (w.is_plane()) return px - py * w.x / w.y;
  return w.x + (px - w.x) * w.y / (w.y - py);
}

/// The shortest way through the window to a point: its line, or one that bends at an end of it.
double way_through(const Window& w, const NearPoint& p) {
  const double crossing = crossing_of(w, p.x(), p.y());
  if (crossing >= w.begin && crossing <= w.end) return w.distance_to(p.x(), p.y());
  const double at = crossing < w.begin ? w.begin : w.end;  // no number: where both are as good
  return w.distance_at(at) + (p - NearPoint(at, 0)).norm();
}

/// The share of the way from one corner to another at which the line through (at, 0) meets it.
double meeting(const Window& w, double at, const NearPoint& from, const NearPoint& to) {
  const double rx = w.ray_x(at), ry = w.ray_y();
  const NearPoint side = to - from;
  const double share = ((at - from.x()) * ry + from.y() * rx) / (side.x() * ry - side.y() * rx);
  return share > 0 ? std::min(share, 1.0) : 0;
}

}  // namespace

void WaveValues::lower_face(const WaveFace& face, const SourceSeeds::Piece& piece,
                            double offset) const {
  const auto at = corners_of(lay_out(face.length));
  for (int k = 0; k < 3; ++k) {
    lower_vertex(face.vertex[k], offset + distance_to(piece, at[k]), piece.group);
    const NearPoint side = at[next_corner(k)] - at[k];
    for (int i = 0; i < samples; ++i) {
      const NearPoint p = at[k] + (i + 1.0) / (samples + 1) * side;
      lower_sample(face, k, i, offset + distance_to(piece, p), piece.group);
    }
  }
}

void NearWindows::add_vertex(Index rank, double offset, Index group) {
  for (const SideCode code : tables_.corners_at(rank)) {
    const WaveFace& face = tables_.faces[face_of_code(code)];
    const int k = corner_of_code(code), opposite = next_corner(k);
    const auto corners = corners_of(lay_out(face.length));
    values_.lower_face(face, {kNoIndex, corners[k], corners[k], 0, group}, offset);
    meet(face);
    Window window = NearAxes(corners, opposite, face.length[opposite])
                        .window(corners[k], offset, Window::label_of(group));
    window.end = face.length[opposite];
    leave((code & ~3) | opposite, window);
  }
}

void NearWindows::add_piece(const SourceSeeds::Piece& piece, double offset) {
  const Index rank = tables_.rank_of_face[piece.face];
  const WaveFace& face = tables_.faces[rank];
  const auto corners = corners_of(lay_out(face.length));
  const double length = (piece.to - piece.from).norm();
  meet(face);
  for (int k = 0; k < 3; ++k) {
    const NearAxes axes(corners, k, face.length[k]);
    if (!(length > 0)) {
      Window window = axes.window(piece.from, offset, Window::label_of(piece.group));
      window.end = face.length[k];
      leave(4 * rank + k, window);
      continue;
    }
    const NearPoint along = (piece.to - piece.from) / length, from = axes.origin - piece.from;
    for (const double hand : {1.0, -1.0}) {
      const NearPoint direction = hand * NearPoint(-along.y(), along.x());
      Window window = axes.plane(direction, offset - direction.dot(piece.from),
                                 Window::label_of(piece.group, Window::kPlane));
      if (window.y <= 0) continue;
      window.end = face.length[k];
      // Within the strip, and before the piece.
      const double slope = along.dot(axes.along), start = along.dot(from);
      keep_above_zero(start, slope, window.begin, window.end);
      keep_above_zero(length - start, -slope, window.begin, window.end);
      keep_above_zero(direction.dot(from), window.x, window.begin, window.end);
      if (window.end > window.begin) leave(4 * rank + k, window);
    }
  }
}

double NearWindows::run() {
  const std::size_t most = kMostNear + tables_.faces.size() / kFacesPerWindow;
  for (std::size_t followed = 0; !queue_.empty(); ++followed) {
    const auto [key, number] = queue_.top();
    if (key >= kNearSides * longest_ || followed >= most) return key;
    queue_.pop();
    if (number >= 0) {
      if (!std::exchange(sent_[number].followed, true)) follow(Window(sent_[number].window));
    } else if (values_.distance[~number] == key) {
      add_vertex(~number, key, values_.label != nullptr ? values_.label[~number] : kNoIndex);
    }
  }
  return kUnreached;
}

bool NearWindows::is_waiting(Index edge, double radius) const {
  bool waits = false;
  for_each_side(edge, [&](SideCode side) {
    const WaveFace& face = tables_.faces[face_of_code(side)];
    for (int k = 0; k < 3; ++k) {
      const double* const first = values_.sample + std::ptrdiff_t{values_.samples} * face.edge[k];
      waits = waits || !(values_.distance[face.vertex[k]] < radius) ||
              std::any_of(first, first + values_.samples,
                          [radius](double value) { return !(value < radius); });
    }
  });
  return waits;
}

template <class Visit>
void NearWindows::for_each_side(Index edge, const Visit& visit) const {
  visit(tables_.sides[edge][0]);
  for (const SideCode side : tables_.other_sides(edge)) visit(side);
}

void NearWindows::meet(const WaveFace& face) {
  for (int k = 0; k < 3; ++k) {
    longest_ = std::max(longest_, face.length[k]);
    if (on_edge_.try_emplace(face.edge[k]).second) edges_.push_back(face.edge[k]);
    notice(face.vertex[k]);
  }
}

/// Lets a vertex send windows when its distance comes, if paths may bend there.
void NearWindows::notice(Index vertex) {
  const auto [at, fresh] = bends_.try_emplace(vertex, -kUnreached);
  if (fresh && bends(vertex)) at->second = kUnreached;
  const double value = values_.distance[vertex];
  if (!(value < at->second)) return;
  at->second = value;
  queue_.emplace(value, ~vertex);
}

/// As WindowMesh::sends().
bool NearWindows::bends(Index vertex) const {
  if (fans_touch(tables_, vertex)) return true;
  double angle = 0, straight = 2 * std::numbers::pi;
  for (const SideCode code : tables_.corners_at(vertex)) {
    const WaveFace& face = tables_.faces[face_of_code(code)];
    const int k = corner_of_code(code), before = previous_corner(k);
    for (const int side : {k, before}) {
      const SideCode second = tables_.sides[face.edge[side]][1];
      if (second < kNoSideCode) return true;
      if (second == kNoSideCode) straight = std::numbers::pi;
    }
    const double a = face.length[k], b = face.length[before], c = face.length[next_corner(k)];
    angle += std::atan2(2 * face.twice_area, a * a + (b - c) * (b + c));
  }
  return angle > straight * (1 + kFlatNear);
}

/// Sends a window out of a face through a side; in the frame of that, with its source below.
void NearWindows::leave(SideCode side, Window window) {
  const WaveFace& face = tables_.faces[face_of_code(side)];
  const int k = corner_of_code(side);
  const Index edge = face.edge[k];
  if (tables_.sides[edge][1] == kNoSideCode) return;
  const double length = face.length[k];
  double at_begin = values_.distance[face.vertex[k]];
  double at_end = values_.distance[face.vertex[next_corner(k)]];
  if ((face.reversed >> k & 1U) != 0) {
    window.reverse(length);
    std::swap(at_begin, at_end);
  }
  window.side = side;
  if (!trim_by_ends(window, length, at_begin, at_end)) return;
  std::vector<int>& others = on_edge_[edge];
  const std::size_t latest = others.size() < kMostBeside ? 0 : others.size() - kMostBeside;
  for (const int number : std::span(others).subspan(latest)) {
    const Window& other = sent_[number].window;
    if (other.side == side && other.label == window.label && have_same_source(other, window)) {
      if (is_known(window, number, kOrder * length)) return;
    } else if (!trim_dominated_ends(window, other, length)) {
      return;
    }
  }
  others.push_back(static_cast<int>(sent_.size()));
  queue_.emplace(window.distance_at(window.nearest_place()), others.back());
  sent_.push_back({window});
}

/// Whether a window of the same source, sent before, has all of it or can be made to have it. Two
/// that a flat vertex has split meet again and go on as one.
bool NearWindows::is_known(const Window& window, int number, double margin) {
  Sent& sent = sent_[number];
  Window& known = sent.window;
  if (window.begin >= known.begin - margin && window.end <= known.end + margin) return true;
  if (sent.followed || window.begin > known.end + margin || window.end < known.begin - margin) {
    return false;
  }
  known.begin = std::min(known.begin, window.begin);
  known.end = std::max(known.end, window.end);
  queue_.emplace(known.distance_at(known.nearest_place()), number);
  return true;
}

void NearWindows::follow(const Window& window) {
  const WaveFace& from = tables_.faces[face_of_code(window.side)];
  for_each_side(from.edge[corner_of_code(window.side)], [&](SideCode side) {
    if (side != window.side) enter(side, window);
  });
}

/// Takes a window, in the direction of an edge, through a face beyond.
void NearWindows::enter(SideCode side, Window window) {
  const WaveFace& face = tables_.faces[face_of_code(side)];
  const int k = corner_of_code(side), next = next_corner(k), previous = previous_corner(k);
  const double length = face.length[k];
  if ((face.reversed >> k & 1U) != 0) window.reverse(length);
  const auto layout = corners_of(lay_out({length, face.length[next], face.length[previous]}));
  const NearPoint &a = layout[0], &b = layout[1], &c = layout[2];
  values_.lower_vertex(face.vertex[previous], way_through(window, c), window.group());
  for (int i = 0; i < values_.samples; ++i) {
    const double share = (i + 1.0) / (values_.samples + 1);
    const NearPoint right = b + share * (c - b), left = c + share * (a - c);
    values_.lower_sample(face, next, i, way_through(window, right), window.group());
    values_.lower_sample(face, previous, i, way_through(window, left), window.group());
  }
  meet(face);
  const double crossing = crossing_of(window, c.x(), c.y());
  const auto send = [&](int corner, double begin, double end) {
    // `corner` 1 is the side that begins at b, 2 that which ends at a.
    const double side_length = face.length[corner == 1 ? next : previous];
    const NearAxes axes(layout, corner, side_length);
    Window child;
    if (window.is_plane()) {
      child = axes.plane({window.x, window.y}, window.sigma, window.label);
      if (child.y <= 0) return;
    } else {
      child = axes.window({window.x, window.y}, window.sigma, window.label);
    }
    child.begin = side_length * begin;
    child.end = side_length * end;
    if (child.end > child.begin) leave((side & ~3) | (corner == 1 ? next : previous), child);
  };
  if (!(window.end <= crossing)) {
    send(1, meeting(window, window.end, b, c),
         window.begin <= crossing ? 1 : meeting(window, window.begin, b, c));
  }
  if (!(window.begin >= crossing)) {
    send(2, window.end >= crossing ? 0 : meeting(window, window.end, c, a),
         meeting(window, window.begin, c, a));
  }
}

}  // namespace geotherm
