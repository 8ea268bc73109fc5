// SPDX-License-Identifier: MIT
// The first windows of sources that are not vertices.
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

#include "solver/polyhedral/propagation.h"

namespace geotherm {
namespace {

using Point2 = Eigen::Vector2d;

/// The corners of a face in its layout.
std::array<Point2, 3> window_corners_of(const WindowMesh& mesh, Index face) {
  const auto& frame = mesh.side(3 * face);
  return {Point2(0, 0), Point2(frame.length, 0), Point2(frame.apex_x, frame.apex_y)};
}

}  // namespace

void Propagation::seed_point(const SourceSeeds::Piece& piece, const StartDirections::Turn* turn) {
  const auto corners = window_corners_of(mesh_, piece.face);
  for (int k = 0; k < 3; ++k) {
    const Side side = 3 * piece.face + k;
    const auto& frame = mesh_.side(side);
    const SideAxes axes(corners, k, frame.length);
    const Point2 to = piece.from - axes.origin;
    Window window{0,
                  frame.length,
                  to.dot(axes.along),
                  std::min(-to.dot(axes.inward), 0.0),
                  piece.offset,
                  side,
                  Window::label_of(piece.group, Window::kFromFace)};
    if (turn) {
      window.turn = turn->turn;
      if (turn->mirrored) window.mirror_start();
      window.rotate_start(std::atan2(axes.along.y(), axes.along.x()));
      window.mirror_start();
    }
    reach_by(window, frame.origin, 0, 0, piece.offset + (piece.from - corners[k]).norm());
    cross(side, window, false);
  }
}

/// The segment sends a plane wave to both of its sides, as wide as itself. Its ends are sources of
/// their own, or go on in the next face.
void Propagation::seed_segment(const SourceSeeds::Piece& piece) {
  const auto corners = window_corners_of(mesh_, piece.face);
  const double length = (piece.to - piece.from).norm();
  if (!(length > 0)) return seed_point(piece);
  const Point2 along = (piece.to - piece.from) / length;
  for (int k = 0; k < 3; ++k) {
    const Side side = 3 * piece.face + k;
    const auto& frame = mesh_.side(side);
    const double t = std::clamp(along.dot(corners[k] - piece.from), 0.0, length);
    reach(frame.origin, piece.offset + (corners[k] - piece.from - t * along).norm(), piece.group);
    const SideAxes axes(corners, k, frame.length);
    const Point2 from = axes.origin - piece.from;
    for (const double hand : {1.0, -1.0}) {
      const Point2 direction = hand * Point2(-along.y(), along.x());
      const double outward = -direction.dot(axes.inward);
      if (outward <= 0) continue;
      Window window{0,
                    frame.length,
                    direction.dot(axes.along),
                    outward,
                    piece.offset + direction.dot(from),
                    side,
                    Window::label_of(piece.group, Window::kPlane)};
      // Within the strip, and before the segment.
      const double slope = along.dot(axes.along), start = along.dot(from);
      keep_above_zero(start, slope, window.begin, window.end);
      keep_above_zero(length - start, -slope, window.begin, window.end);
      keep_above_zero(direction.dot(from), window.x, window.begin, window.end);
      if (window.end > window.begin) cross(side, window, false);
    }
  }
}

}  // namespace geotherm
