// SPDX-License-Identifier: MIT
#include "solver/path/shorten.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "solver/path/unfolded_strip.h"
#include "solver/path/within_memory.h"

namespace geotherm {
namespace {

/// Alternatives that are estimated to be longer by more than this share are not tried. The estimate
/// considers one vertex; those behind it may make up for so much.
constexpr double kWorthTrying = 0.01;

/// A vertex beside a segment, with the gates of the strip that it is a post of.
struct Passed {
  Index vertex;
  int first_gate, last_gate;
  std::vector<Index> across;  ///< the other ends of the gates that it is a post of
  double estimate;            ///< length of the segment on its other side
};

double total_angle(const PathSurface& surface, Index vertex) {
  double sum = 0;
  for (const Index corner : surface.corners_at(vertex)) {
    sum += surface.corner_angle(corner / 3, corner % 3);
  }
  return sum;
}

double length_across(double a, double b, double angle) {
  return std::sqrt(std::max(0.0, a * a + b * b - 2 * a * b * std::cos(angle)));
}

/// The vertices whose other side is worth a try, the most promising first.
std::vector<Passed> passed_by(const PathSurface& surface, const PathSegment& segment) {
  const UnfoldedStrip strip = unfold(surface, segment.from, segment.to, segment.faces);
  const Vec2& a = strip.points[static_cast<std::size_t>(strip.start())];
  const Vec2& b = strip.points[static_cast<std::size_t>(strip.end())];
  std::vector<Passed> out;
  for (std::size_t i = 0; i < strip.corners.size(); ++i) {
    const UnfoldedStrip::Corner& corner = strip.corners[i];
    if (corner.last_gate < corner.first_gate) continue;
    const Vec2 to_a = a - strip.points[i], to_b = b - strip.points[i];
    const double angle =
        std::atan2(std::abs(to_a.x() * to_b.y() - to_a.y() * to_b.x()), to_a.dot(to_b));
    const double other = total_angle(surface, corner.vertex) - angle;
    if (!(other < std::numbers::pi)) continue;
    const double estimate = length_across(to_a.norm(), to_b.norm(), other);
    if (!(estimate < segment.length * (1 + kWorthTrying))) continue;
    Passed passed{corner.vertex, corner.first_gate, corner.last_gate, {}, estimate};
    for (int k = corner.first_gate; k <= corner.last_gate; ++k) {
      const auto [left, right] = strip.gates[static_cast<std::size_t>(k)];
      const int across = left == static_cast<int>(i) ? right : left;
      passed.across.push_back(strip.corners[static_cast<std::size_t>(across)].vertex);
    }
    out.push_back(std::move(passed));
  }
  std::ranges::stable_sort(out, {}, &Passed::estimate);
  return out;
}

/// The segments of the alternative on the other side of the vertex; empty where there is none.
std::vector<PathSegment> alternative(const PathSurface& surface, const PathSegment& segment,
                                     const Passed& passed) {
  const auto begin = segment.faces.begin();
  const SurfacePoint vertex = SurfacePoint::at_vertex(passed.vertex);
  const std::vector<PathSegment> in =
      pull_tight(surface, segment.from, vertex, {begin, begin + passed.first_gate + 1});
  const std::vector<PathSegment> out =
      pull_tight(surface, vertex, segment.to, {begin + passed.last_gate + 1, segment.faces.end()});
  if (in.empty() || out.empty()) return {};
  auto past = strip_past(surface, in.back(), out.front(), passed.across);
  if (!past) return {};
  std::vector<PathSegment> way(in.begin(), in.end() - 1);
  for (PathSegment& past_segment :
       pull_tight(surface, in.back().from, out.front().to, *std::move(past))) {
    way.push_back(std::move(past_segment));
  }
  way.insert(way.end(), out.begin() + 1, out.end());
  return way;
}

/// Replaces segment i by a shorter alternative on the other side of a vertex; false where there is
/// none.
Result<bool> improve(const PathSurface& surface, std::vector<PathSegment>& segments, std::size_t i,
                     StepBudget& budget) {
  for (const Passed& passed : passed_by(surface, segments[i])) {
    std::vector<PathSegment> way = alternative(surface, segments[i], passed);
    if (way.empty()) continue;
    if (auto straightened = straighten_bends(surface, way, budget); !straightened)
      return straightened.error();
    if (!is_shorter(length_of(way), segments[i].length)) continue;
    const auto at = segments.erase(segments.begin() + static_cast<std::ptrdiff_t>(i));
    segments.insert(at, std::make_move_iterator(way.begin()), std::make_move_iterator(way.end()));
    return true;
  }
  return false;
}

/// Looks for shorter paths among the homotopic alternatives on the other sides of the vertices that
/// a path passes: there is a straight path on each side of a vertex whose faces have less than 2
/// pi, and the current one need not be the shorter. Each such vertex is passed on its other side,
/// the bends are straightened, and what is shorter is kept, until no such change is. Precondition:
/// straighten_bends() has nothing left to do, and has nothing afterwards. Errors: those of the
/// budget.
Result<void> try_homotopic_alternatives(const PathSurface& surface,
                                        std::vector<PathSegment>& segments, StepBudget& budget) {
  std::size_t i = 0;
  while (i < segments.size()) {
    const auto improved = improve(surface, segments, i, budget);
    if (!improved) return improved.error();
    if (!*improved) {
      ++i;
      continue;
    }
    if (auto straightened = straighten_bends(surface, segments, budget); !straightened)
      return straightened;
    i = 0;
  }
  return {};
}

/// A loop shorter than this, in units of the surface (about half its size), is a point.
constexpr double kPoint = 1e-12;

/// Leaves out detours where the row of faces closes.
void cancel_round(const PathSurface& surface, std::vector<Index>& faces) {
  cancel_detours(surface, faces);
  while (faces.size() > 1) {
    const std::size_t n = faces.size();
    if (faces.front() == faces.back()) {
      faces.pop_back();
    } else if (n > 2 && surface.shared_edge(faces[n - 1], faces[0]) ==
                            surface.shared_edge(faces[0], faces[1])) {
      faces.erase(faces.begin());
    } else if (n > 2 && surface.shared_edge(faces[n - 2], faces[n - 1]) ==
                            surface.shared_edge(faces[n - 1], faces[0])) {
      faces.pop_back();
    } else {
      return;
    }
  }
}

/// The shortest loops in a closed row of faces that pass one of its gates at a given place.
class CutLoop {
 public:
  /// The gate is the edge between the last face and the first.
  CutLoop(const PathSurface& surface, std::vector<Index> faces)
      : surface_(surface), faces_(std::move(faces)) {
    const Index edge = surface.shared_edge(faces_.back(), faces_.front());
    low_ = surface.edges().low(edge);
    high_ = surface.edges().high(edge);
  }

  std::vector<PathSegment> segments_at(double share) const {
    return pull_tight(surface_, place(share, faces_.front()), place(share, faces_.back()), faces_);
  }

  /// The derivative of the length by the place, which never falls since the length is convex.
  double slope(double share) const {
    const std::vector<PathSegment> segments = segments_at(share);
    if (segments.empty()) return 0;
    const Vec3 along = surface_.position(high_) - surface_.position(low_);
    return (arrival(segments.back()) - departure(segments.front())).dot(along);
  }

  /// The shortest of these loops, cut where it passes the gate.
  std::vector<PathSegment> shortest() const {
    double low = 0, high = 1;
    constexpr int kHalvings = 60;
    for (int i = 0; i < kHalvings && low < high; ++i) {
      const double middle = low + (high - low) / 2;
      if (middle == low || middle == high) break;
      (slope(middle) > 0 ? high : low) = middle;
    }
    std::vector<PathSegment> best = segments_at(low);
    for (const double end : {0.0, 1.0}) {  // at a vertex, it can go on with other gates
      constexpr double kNear = 1e-9;
      if (std::abs(low - end) > kNear) continue;
      std::vector<PathSegment> segments = segments_at(end);
      if (length_of(segments) <= length_of(best) * (1 + kNear * kNear)) best = std::move(segments);
    }
    return best;
  }

 private:
  SurfacePoint place(double share, Index face) const {
    if (share <= 0) return SurfacePoint::at_vertex(low_);
    if (share >= 1) return SurfacePoint::at_vertex(high_);
    SurfacePoint point = SurfacePoint::in_face(face, {});
    point.weights[static_cast<std::size_t>(surface_.corner_of_vertex(face, low_))] = 1 - share;
    point.weights[static_cast<std::size_t>(surface_.corner_of_vertex(face, high_))] = share;
    return point;
  }

  Vec3 departure(const PathSegment& segment) const {
    const std::vector<SurfacePoint> points = points_of(segment);
    return (surface_.position(points[1]) - surface_.position(points[0])).normalized();
  }
  Vec3 arrival(const PathSegment& segment) const {
    const std::vector<SurfacePoint> points = points_of(segment);
    const std::size_t n = points.size();
    return (surface_.position(points[n - 1]) - surface_.position(points[n - 2])).normalized();
  }
  std::vector<SurfacePoint> points_of(const PathSegment& segment) const {
    std::vector<SurfacePoint> points = {segment.from};
    std::vector<Index> faces;
    append_points(surface_, segment, points, faces);
    return points;
  }

  const PathSurface& surface_;
  std::vector<Index> faces_;
  Index low_ = kNoIndex, high_ = kNoIndex;
};

std::vector<Index> strip_of(const std::vector<PathSegment>& segments) {
  std::vector<Index> faces;
  for (const PathSegment& segment : segments)
    faces.insert(faces.end(), segment.faces.begin(), segment.faces.end());
  return faces;
}

/// The shortest loop in a closed row of faces; none where it can shrink to a point.
std::vector<PathSegment> shortest_in(const PathSurface& surface, std::vector<Index> faces) {
  cancel_round(surface, faces);
  if (faces.size() < 3) return {};
  std::vector<PathSegment> segments = CutLoop(surface, std::move(faces)).shortest();
  if (!(length_of(segments) > kPoint)) segments.clear();
  return segments;
}

/// Cuts the loop open at another of its vertices. Where it was cut inside an edge or a face, the
/// two segments that met there become one strip.
void cut_at_first_vertex(const PathSurface& surface, std::vector<PathSegment>& segments) {
  const bool at_vertex = segments.front().from.is_vertex();
  std::rotate(segments.begin(), segments.begin() + 1, segments.end());
  if (at_vertex) return;
  PathSegment first = std::move(segments[segments.size() - 2]), second = std::move(segments.back());
  segments.resize(segments.size() - 2);
  std::vector<Index> strip = std::move(first.faces);
  strip.insert(strip.end(), second.faces.begin(), second.faces.end());
  for (PathSegment& segment : pull_tight(surface, first.from, second.to, std::move(strip))) {
    segments.push_back(std::move(segment));
  }
}

bool is_bend_at_cut(const std::vector<PathSegment>& segments) {
  return segments.front().from.is_vertex();
}

/// Shortens segments that end where they begin, all round; no segments are left of a loop that
/// shrinks to a point. Precondition: straighten_bends() has nothing left to do. Errors: those of
/// the budget.
Result<void> shorten_loop(const PathSurface& surface, std::vector<PathSegment>& segments,
                          StepBudget& budget) {
  while (!segments.empty()) {
    if (auto spent = budget.spend(); !spent) return spent;
    const double before = length_of(segments);
    if (!(before > kPoint)) {
      segments.clear();
      return {};
    }
    std::vector<PathSegment> next = segments;
    if (segments.size() > 1) {
      cut_at_first_vertex(surface, next);
    } else if (is_bend_at_cut(segments)) {
      auto strip = strip_past(surface, segments.front(), segments.front());
      if (!strip) return {};
      // The loop's own strip, closed by the way past the vertex.
      strip->resize(strip->size() - segments.front().faces.size());
      next = shortest_in(surface, *std::move(strip));
    } else {
      next = shortest_in(surface, strip_of(segments));
    }
    if (auto straightened = straighten_bends(surface, next, budget); !straightened)
      return straightened;
    const bool shorter = is_shorter(length_of(next), before);
    if (!shorter && !(segments.size() > 1)) return {};
    segments = std::move(next);
    if (!shorter) return {};
  }
  return {};
}

Result<SurfacePath> shortened(const PathSurface& surface, const SurfacePath& start, bool search,
                              const Progress& progress) {
  if (start.points.empty()) {
    return Error{ErrorCode::kBadInput, "the path has no points", {"give one at least"}};
  }
  const auto first = surface.into(start.points.front());
  if (!first) return first.error();
  auto segments = tight_segments(surface, start);
  if (!segments) return segments.error();
  StepBudget budget(surface, progress);
  auto straightened = straighten_bends(surface, *segments, budget);
  if (straightened && start.closed) straightened = shorten_loop(surface, *segments, budget);
  if (straightened && !start.closed && search)
    straightened = try_homotopic_alternatives(surface, *segments, budget);
  if (!straightened) return straightened.error();
  SurfacePath path = path_of(surface, *segments, *first);
  path.closed = start.closed;
  return path;
}

}  // namespace

Result<SurfacePath> shorten(const PathSurface& surface, const SurfacePath& start, bool search,
                            const Progress& progress) {
  return within_memory("a shorter path", *surface.mesh(), progress, [&](const Progress& watched) {
    return shortened(surface, start, search, watched);
  });
}

}  // namespace geotherm
