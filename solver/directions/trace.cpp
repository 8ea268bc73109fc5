// SPDX-License-Identifier: MIT
// Straightest lines from face to face.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "solver/core/text.h"
#include "solver/directions/directions_state.h"
#include "solver/geometry/edit.h"

namespace geotherm {
namespace {

using Point2 = Eigen::Vector2d;

constexpr std::size_t kMaxTracedPieces = 10'000'000;

Point2 rotated(const Point2& v, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
}

Point2 left_of(const Point2& v) { return {-v.y(), v.x()}; }

/// A line that goes on face by face, in the layout of the face that it is in.
class Tracer {
 public:
  Tracer(const PathSurface& paths, const WaveSurface& surface, const TangentFans& fans,
         double length)
      : paths_(paths), surface_(surface), fans_(fans), rest_(length) {}

  void start_in_face(const SurfacePoint& point, const Point2& direction) {
    enter(point.face);
    place_ = point.weights[0] * at_[0] + point.weights[1] * at_[1] + point.weights[2] * at_[2];
    direction_ = direction;
    add_point(point);
    int exit = -1;
    double way = 0;
    for (int k = 0; k < 3; ++k) {
      const Point2 side = at_[next_corner(k)] - at_[k];
      const double across = cross(direction_, side);
      if (!(across > 0)) continue;
      const double to_side = cross(at_[k] - place_, side) / across;
      if (exit < 0 || to_side < way) exit = k, way = to_side;
    }
    leave_by(exit);
  }

  /// `angle`: of the fan, not scaled. False: no face lies there.
  bool start_at_vertex(Index v, double angle) {
    add_point(SurfacePoint::at_vertex(v));
    return go_from_vertex(v, angle);
  }

  /// The direction of the last piece, as an angle in the layout of its face.
  double direction() const { return std::atan2(direction_.y(), direction_.x()); }
  Index face() const { return face_; }

  Result<TracedLine> run(const Progress& progress) {
    constexpr std::size_t kAskEvery = 1U << 12;
    const double whole = rest_;
    while (going_) {
      if (line_.path.faces.size() % kAskEvery == kAskEvery - 1 &&
          !report(progress, "straightest line", 1 - rest_ / whole)) {
        return cancelled_error();
      }
      if (line_.path.faces.size() >= kMaxTracedPieces) {
        return Error{ErrorCode::kBudgetEnded,
                     "the line has " + std::to_string(kMaxTracedPieces) + " pieces and " +
                         rounded_text(rest_ * unit()) + " of its length to go",
                     {"trace a shorter one"}};
      }
      step();
    }
    return std::move(line_);
  }

 private:
  double unit() const { return surface_.base.length_unit(); }

  void enter(Index face) {
    face_ = face;
    at_ = corners_of(surface_.base.intrinsic.lengths[static_cast<std::size_t>(face)]);
  }

  void add_point(const SurfacePoint& clean) {
    if (!line_.path.points.empty()) line_.path.faces.push_back(paths_.file_face(face_));
    line_.path.points.push_back(paths_.out_of(clean));
  }

  void end(TraceEnd why) {
    line_.end = why;
    going_ = false;
  }

  void leave_by(int side) {
    exit_ = side;
    going_ = true;
  }

  /// Through the face to its side `exit_`, or to the end.
  void step() {
    const int k = exit_, next = next_corner(k);
    const Point2 side = at_[next] - at_[k];
    const double from = -cross(direction_, at_[k] - place_);
    const double to = cross(direction_, at_[next] - place_);
    double share = from + to > 0 ? std::clamp(from / (from + to), 0.0, 1.0) : 0.0;
    if (share < kAtCorner) share = 0;
    if (share > 1 - kAtCorner) share = 1;
    const double way = (at_[k] + share * side - place_).norm();
    if (way > rest_) return stop_inside();
    rest_ -= way;
    line_.path.length += way * unit();
    if (share == 0 || share == 1) return pass_vertex(share == 0 ? k : next);
    if (way > 0) {
      SurfacePoint point = SurfacePoint::in_face(face_, {});
      point.weights[static_cast<std::size_t>(k)] = 1 - share;
      point.weights[static_cast<std::size_t>(next)] = share;
      add_point(point);
    }
    if (!(rest_ > 0)) return end(TraceEnd::kLength);
    cross_side(k, share, side);
  }

  void stop_inside() {
    const Point2 last = place_ + rest_ * direction_;
    line_.path.length += rest_ * unit();
    if (rest_ > 0) {
      add_point(SurfacePoint::in_face(face_, clipped_weights(at_[0], at_[1], at_[2], last)));
    }
    end(TraceEnd::kLength);
  }

  void cross_side(int k, double share, const Point2& side) {
    const Side leave = 3 * face_ + k;
    const auto around = surface_.sides_of(surface_.edge_of_side(leave));
    if (around.size() != 2) {
      return end(around.size() == 1 ? TraceEnd::kBoundary : TraceEnd::kSplit);
    }
    const Side entry = around[0] == leave ? around[1] : around[0];
    const Point2 axis = side.normalized();
    const bool opposite = paths_.face(face_)[k] != paths_.face(face_of(entry))[corner_of(entry)];
    const double along = (opposite ? -1 : 1) * direction_.dot(axis);
    const double inward = std::max(-direction_.dot(left_of(axis)), 0.0);
    enter(face_of(entry));
    const int i = corner_of(entry), apex = previous_corner(i);
    const Point2 next_side = at_[next_corner(i)] - at_[i], next_axis = next_side.normalized();
    place_ = at_[i] + (opposite ? 1 - share : share) * next_side;
    direction_ = (along * next_axis + inward * left_of(next_axis)).normalized();
    leave_by(cross(direction_, at_[apex] - place_) > 0 ? next_corner(i) : apex);
  }

  void pass_vertex(int corner) {
    const Index v = paths_.face(face_)[corner];
    if (line_.path.points.back() != SurfacePoint::at_vertex(v)) {
      add_point(SurfacePoint::at_vertex(v));
    }
    if (!(rest_ > 0)) return end(TraceEnd::kLength);
    const auto& vertex = fans_.vertex(v);
    const bool inner = vertex.kind == TangentFans::Kind::kInner;
    const bool boundary = vertex.kind == TangentFans::Kind::kBoundary;
    if (!inner && !boundary) return end(TraceEnd::kSplit);
    const auto& here = fans_.corner(3 * face_ + corner);
    const Point2 first = at_[next_corner(corner)] - at_[corner];
    const double back =
        std::clamp(std::atan2(-cross(first, direction_), -first.dot(direction_)), 0.0, here.angle);
    const double angle = here.begin + (here.against ? here.angle - back : back);
    if (inner) {
      go_from_vertex(v, angle + vertex.angle / 2);
    } else if (!go_along_border(v, angle)) {
      end(TraceEnd::kBoundary);
    }
  }

  /// A line that came along the border to a vertex, in this direction of the fan, goes on where the
  /// surface has room for half a turn: along the border where that is straight.
  bool go_along_border(Index v, double angle) {
    constexpr double kRound = 1e-6, kHalfTurn = std::numbers::pi;  // positions may be floats
    const double all = fans_.vertex(v).angle;
    const bool at_begin = angle < kRound;
    if ((!at_begin && angle < all - kRound) || all < kHalfTurn - kRound) return false;
    if (all < kHalfTurn + kRound) return go_from_vertex(v, at_begin ? all : 0.0);
    return go_from_vertex(v, at_begin ? kHalfTurn : all - kHalfTurn);
  }

  bool go_from_vertex(Index v, double angle) {
    const Side corner = fans_.corner_at(v, angle);
    if (corner == kNoSide) return false;
    const auto& vertex = fans_.vertex(v);
    if (vertex.kind == TangentFans::Kind::kInner) {
      angle -= std::floor(angle / vertex.angle) * vertex.angle;
    }
    const auto& at = fans_.corner(corner);
    const double beyond = std::clamp(angle - at.begin, 0.0, at.angle);
    const int k = corner_of(corner);
    enter(face_of(corner));
    place_ = at_[k];
    const Point2 first = (at_[next_corner(k)] - at_[k]).normalized();
    direction_ = rotated(first, at.against ? at.angle - beyond : beyond);
    leave_by(next_corner(k));
    return true;
  }

  const PathSurface& paths_;
  const WaveSurface& surface_;
  const TangentFans& fans_;
  TracedLine line_;
  double rest_;  ///< of the length, in units of the surface
  Index face_ = kNoIndex;
  std::array<Point2, 3> at_;
  Point2 place_, direction_;
  int exit_ = 0;
  bool going_ = false;
};

}  // namespace

Result<TracedLine> Directions::trace(const SurfacePoint& point, double direction, double length,
                                     const Progress& progress) const {
  if (!std::isfinite(direction) || !std::isfinite(length) || length < 0) {
    return Error{ErrorCode::kBadInput,
                 "a line in direction " + number_text(direction) + " of length " +
                     number_text(length) + " cannot be traced",
                 {"give finite numbers, the length at least 0"}};
  }
  const State& state = *state_;
  const auto clean = state.point(point);
  if (!clean) return clean.error();
  Tracer tracer(state.paths, *state.surface, state.fans,
                length / state.surface->base.length_unit());
  if (!clean->is_vertex()) {
    const auto turn = state.face_turn(clean->face);
    const double angle = turn.mirrored ? turn.turn - direction : direction - turn.turn;
    tracer.start_in_face(*clean, {std::cos(angle), std::sin(angle)});
  } else {
    const auto& vertex = state.fans.vertex(clean->vertex);
    if (!tracer.start_at_vertex(clean->vertex, direction / vertex.scale())) {
      return Error{ErrorCode::kBadInput,
                   "direction " + number_text(direction) + " leaves the surface at vertex " +
                       std::to_string(clean->vertex) + " on its boundary",
                   {"choose one from 0 to " + number_text(vertex.angle)}};
    }
  }
  auto line = tracer.run(progress);
  if (!line) return line;
  if (line->end == TraceEnd::kLength) line->path.length = length;  // not what its pieces add up to
  if (line->path.points.back().is_vertex()) {
    line->direction = std::numeric_limits<double>::quiet_NaN();
  } else {
    const auto turn = state.face_turn(tracer.face());
    const double angle = turn.turn + (turn.mirrored ? -1 : 1) * tracer.direction();
    line->direction = std::remainder(angle, 2 * std::numbers::pi);
  }
  return line;
}

}  // namespace geotherm
