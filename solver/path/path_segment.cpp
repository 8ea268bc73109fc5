// SPDX-License-Identifier: MIT
#include "solver/path/shorten.h"

#include <algorithm>
#include <cmath>

#include "solver/geometry/edit.h"
#include "solver/path/unfolded_strip.h"

namespace geotherm {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

double angle_between(const Vec2& a, const Vec2& b) {
  return std::atan2(std::abs(cross(a, b)), a.dot(b));
}

/// Whether the edge between the first two faces holds the point, which makes the first face
/// superfluous.
bool gate_holds(const PathSurface& surface, const SurfacePoint& point, Index first, Index second) {
  const auto in_second = surface.express(point, second);
  return in_second && surface.express(point, first);
}

/// The angle at `corner` of a laid-out face from its next corner to a point.
double angle_at(const UnfoldedStrip& strip, const std::array<int, 3>& face, int corner,
                const Vec2& to) {
  std::size_t k = 0;
  while (face[k] != corner) ++k;
  const Vec2& tip = strip.points[at(corner)];
  const Vec2 next = strip.points[at(face[(k + 1) % 3])] - tip;
  const Vec2 last = strip.points[at(face[(k + 2) % 3])] - tip;
  return std::min(angle_between(next, to - tip), angle_between(next, last));
}

/// The corner of a laid-out face that an end of the strip is, -1 where it is none.
int corner_in_strip(const UnfoldedStrip& strip, const std::array<int, 3>& face,
                    const SurfacePoint& p) {
  for (const int corner : face) {
    if (p.is_vertex() && strip.corners[at(corner)].vertex == p.vertex) return corner;
  }
  return -1;
}

/// The faces that a piece of a shortest path runs through; both ends are numbers of points.
struct Range {
  int low, high;
};

Range faces_between(const UnfoldedStrip& strip, int a, int b) {
  const int last_face = static_cast<int>(strip.faces.size()) - 1;
  const int low = a == strip.start() ? 0 : strip.corners[at(a)].last_gate + 1;
  const int high = b == strip.end() ? last_face : strip.corners[at(b)].first_gate;
  return {std::min(low, high), high};  // two posts of one gate: the face before it has both
}

bool same_point(const SurfacePoint& a, const SurfacePoint& b) {
  return a.vertex == b.vertex && (a.is_vertex() || (a.face == b.face && a.weights == b.weights));
}

}  // namespace

void cancel_detours(const PathSurface& surface, std::vector<Index>& faces) {
  std::vector<Index> kept;
  for (const Index face : faces) {
    while (true) {
      const std::size_t n = kept.size();
      if (n > 0 && kept[n - 1] == face) break;
      if (n > 1 && kept[n - 2] == face) {
        kept.pop_back();
        break;
      }
      if (n > 1 &&
          surface.shared_edge(kept[n - 2], kept[n - 1]) == surface.shared_edge(kept[n - 1], face)) {
        kept.pop_back();  // three faces at one edge
        continue;
      }
      kept.push_back(face);
      break;
    }
  }
  faces = std::move(kept);
}

/// Leaves out detours, and the faces at the ends that only turn about the end point. Precondition:
/// as above; the first face holds `from`, the last one `to`.
static void reduce_strip(const PathSurface& surface, const SurfacePoint& from,
                         const SurfacePoint& to, std::vector<Index>& faces) {
  cancel_detours(surface, faces);
  std::size_t first = 0, last = faces.size() - 1;
  while (first < last && gate_holds(surface, from, faces[first], faces[first + 1])) ++first;
  while (first < last && gate_holds(surface, to, faces[last], faces[last - 1])) --last;
  faces.assign(faces.begin() + static_cast<std::ptrdiff_t>(first),
               faces.begin() + static_cast<std::ptrdiff_t>(last) + 1);
}

std::vector<PathSegment> pull_tight(const PathSurface& surface, const SurfacePoint& from,
                                    const SurfacePoint& to, std::vector<Index> faces) {
  reduce_strip(surface, from, to, faces);
  const SurfacePoint first = *surface.express(from, faces.front());
  const SurfacePoint last = *surface.express(to, faces.back());
  const UnfoldedStrip strip = unfold(surface, first, last, faces);
  std::vector<int> path = {strip.start(), strip.end()};
  if (!strip.gates.empty()) {
    Funnel funnel(strip.points, strip.start(), strip.gates[0].left, strip.gates[0].right);
    for (std::size_t k = 1; k < strip.gates.size(); ++k) {
      const auto [left, right] = strip.gates[k];
      if (left != strip.gates[k - 1].left) {
        funnel.add_left(left);
      } else {
        funnel.add_right(right);
      }
    }
    path = funnel.path_to(strip.end());
  }
  const auto point = [&](int i) {
    if (i == strip.start()) return first;
    if (i == strip.end()) return last;
    return SurfacePoint::at_vertex(strip.corners[at(i)].vertex);
  };
  std::vector<PathSegment> segments;
  for (std::size_t i = 1; i < path.size(); ++i) {
    PathSegment segment{point(path[i - 1]), point(path[i]), {}};
    const auto [low, high] = faces_between(strip, path[i - 1], path[i]);
    if (low == high && same_point(segment.from, segment.to)) continue;
    segment.faces.assign(faces.begin() + low, faces.begin() + high + 1);
    const Vec2 &a = strip.points[at(path[i - 1])], &b = strip.points[at(path[i])];
    segment.length = (b - a).norm();
    if (segment.from.is_vertex()) {
      const auto& face = strip.faces[at(low)];
      segment.from_angle = angle_at(strip, face, corner_in_strip(strip, face, segment.from), b);
    }
    if (segment.to.is_vertex()) {
      const auto& face = strip.faces[at(high)];
      segment.to_angle = angle_at(strip, face, corner_in_strip(strip, face, segment.to), a);
    }
    segments.push_back(std::move(segment));
  }
  return segments;
}

double length_of(const std::vector<PathSegment>& segments) {
  double length = 0;
  for (const PathSegment& segment : segments) length += segment.length;
  return length;
}

void append_points(const PathSurface& surface, const PathSegment& segment,
                   std::vector<SurfacePoint>& points, std::vector<Index>& faces) {
  /// A crossing nearer than this to an end of the edge, relative to its length, is that end.
  constexpr double kAtVertex = 1e-12;
  const UnfoldedStrip strip = unfold(surface, segment.from, segment.to, segment.faces);
  const Vec2& start = strip.points[at(strip.start())];
  const Vec2 along = strip.points[at(strip.end())] - start;
  const auto append = [&](const SurfacePoint& point, Index face) {
    if (same_point(points.back(), point)) return;
    points.push_back(point);
    faces.push_back(face);
  };
  for (std::size_t k = 0; k < strip.gates.size(); ++k) {
    const auto [left, right] = strip.gates[k];
    const Vec2& from_left = strip.points[at(left)];
    const Vec2 gate = strip.points[at(right)] - from_left;
    const double across = cross(along, gate);
    const double share =
        across != 0 ? std::clamp(cross(along, start - from_left) / across, 0.0, 1.0) : 0;
    if (share < kAtVertex || share > 1 - kAtVertex) {
      const int post = share < 0.5 ? left : right;
      append(SurfacePoint::at_vertex(strip.corners[at(post)].vertex), segment.faces[k]);
      continue;
    }
    SurfacePoint point = SurfacePoint::in_face(segment.faces[k], {});
    for (std::size_t c = 0; c < 3; ++c) {
      if (strip.faces[k][c] == left) point.weights[c] = 1 - share;
      if (strip.faces[k][c] == right) point.weights[c] = share;
    }
    append(point, segment.faces[k]);
  }
  append(segment.to, segment.faces.back());
}

}  // namespace geotherm
