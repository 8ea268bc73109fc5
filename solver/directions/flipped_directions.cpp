// SPDX-License-Identifier: MIT
#include "solver/directions/flipped_directions.h"

#include <cmath>
#include <numbers>

#include "solver/polyhedral/window_mesh.h"

namespace geotherm {
namespace {

using FanCorner = TangentFans::Corner;

double turn_between(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  return std::atan2(cross(from, to), from.dot(to));
}

/// Follows the corners of faces through edits: where they begin at their vertices, and how wide
/// they are. Lengths may have been raised since the fans were made, so that triangles are strict;
/// they say how an angle is cut, but the three of a face remain half a turn and those at a vertex
/// what they were, and a flat surface stays flat.
class CornerCarrier {
 public:
  explicit CornerCarrier(std::vector<FanCorner>& corners) : corners_(corners) {}

  void carry(const Edit& edit) {
    switch (edit.kind) {
      case Edit::Kind::kFlip:
        return carry_flip(edit);
      case Edit::Kind::kSideSplit:
        return carry_side_split(edit);
      case Edit::Kind::kFaceSplit:
        return carry_face_split(edit);
    }
  }

 private:
  static constexpr double kHalfTurn = std::numbers::pi;

  /// The corners of a face from corner `start` on.
  std::array<FanCorner, 3> at(Index face, int start) const {
    return {corners_[3 * face + start], corners_[3 * face + next_corner(start)],
            corners_[3 * face + previous_corner(start)]};
  }
  void set(Index face, const FanCorner& a, const FanCorner& b, const FanCorner& c) {
    corners_[3 * face] = a;
    corners_[3 * face + 1] = b;
    corners_[3 * face + 2] = c;
  }

  /// A triangle with the angles of these corners, of any size.
  static std::array<Eigen::Vector2d, 3> shape(const std::array<FanCorner, 3>& of) {
    const auto& [a, b, c] = of;
    return {Eigen::Vector2d(0, 0), Eigen::Vector2d(std::sin(c.angle), 0),
            std::sin(b.angle) * Eigen::Vector2d(std::cos(a.angle), std::sin(a.angle))};
  }

  void carry_flip(const Edit& flip) {
    const auto [a_f, b_f, c] = at(flip.f, flip.start_f);
    const auto [b_g, a_g, d] = at(flip.g, flip.start_g);
    const FlipDiamond q = unfold(flip.numbers);
    const double a = a_f.angle + a_g.angle, b = b_f.angle + b_g.angle;
    const double c_f = turn_between(q.a - q.c, q.d - q.c);
    const double d_f = kHalfTurn - a - c_f, d_g = d.angle - d_f;
    set(flip.f, {c.begin, c_f}, {a_g.begin, a}, {d.begin + d_g, d_f});
    set(flip.g, {d.begin, d_g}, {b_f.begin, b}, {c.begin + c_f, c.angle - c_f});
  }

  /// At the vertex the side that was split begins the frame, in the sense of the first face.
  void carry_side_split(const Edit& split) {
    const auto before = at(split.f, split.start_f);
    const auto& [a, b, c] = before;
    const auto [p_a, p_b, p_c] = shape(before);
    const Eigen::Vector2d p = p_a + split.numbers[0] * (p_b - p_a);
    const double begin = split.start_g * kHalfTurn, at_g = turn_between(p_b - p, p_c - p);
    const double c_f = at_g - a.angle;
    set(split.f, a, {begin + at_g, kHalfTurn - at_g}, {c.begin, c_f});
    set(split.g, {begin, at_g}, b, {c.begin + c_f, c.angle - c_f});
  }

  /// At the vertex the way to the first corner of the face begins the frame.
  void carry_face_split(const Edit& split) {
    const auto before = at(split.f, 0);
    const auto place = shape(before);
    Eigen::Vector2d p(0, 0);
    for (int k = 0; k < 3; ++k) p += split.numbers[k] * place[k];
    std::array<double, 3> first{};  // of each corner the angle before the way to p
    for (int k = 0; k < 3; ++k) {
      first[k] = turn_between(place[next_corner(k)] - place[k], p - place[k]);
    }
    const std::array<Index, 3> part = {split.f, split.g, split.g + 1};
    double begin = 0;
    for (int k = 0; k < 3; ++k) {
      const FanCorner &a = before[k], &b = before[next_corner(k)];
      const double b_begin = first[next_corner(k)], b_rest = b.angle - b_begin;
      const double at_p = kHalfTurn - first[k] - b_rest;
      set(part[k], {a.begin, first[k]}, {b.begin + b_begin, b_rest}, {begin, at_p});
      begin += at_p;
    }
  }

  std::vector<FanCorner>& corners_;
};

}  // namespace

FlippedDirections flip_directions(const IntrinsicSurface& flipped, const TangentFans& fans) {
  FlippedDirections out;
  const IntrinsicMesh& mesh = flipped.intrinsic;
  std::vector<FanCorner> corners;
  corners.reserve(mesh.twin.size());
  for (Side s = 0; s < 3 * static_cast<Side>(flipped.kept->faces.size()); ++s) {
    const Index v = flipped.kept->faces[face_of(s)][corner_of(s)];
    corners.push_back(fans.corner(s));
    if (corners.back().against || fans.vertex(v).kind == TangentFans::Kind::kSplit) {
      out.broken = v;
      return out;
    }
  }
  corners.resize(mesh.twin.size());
  CornerCarrier carrier(corners);
  for (const Edit& edit : flipped.edits) carrier.carry(edit);
  for (Index v = 0; v < flipped.mesh->vertex_count(); ++v) {
    out.scale.push_back(fans.vertex(v).scale());
  }
  out.scale.resize(static_cast<std::size_t>(flipped.vertex_count()), 1.0);  // the surface is flat
  for (Side s = 0; s < static_cast<Side>(mesh.twin.size()); ++s) {
    const Face& face = mesh.faces[face_of(s)];
    const FanCorner& end = corners[next_side(s)];
    out.at_begin.push_back(out.scale[face[corner_of(s)]] * corners[s].begin);
    out.at_end.push_back(out.scale[face[next_corner(corner_of(s))]] * (end.begin + end.angle));
  }
  return out;
}

}  // namespace geotherm
