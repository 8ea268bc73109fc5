// SPDX-License-Identifier: MIT
#include "solver/path/shorten.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <queue>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "solver/path/path_surface.h"

namespace geotherm {
namespace {

/// A direction at a vertex: a face there, and the angle to its edge to the next corner.
struct LinkPoint {
  Index face;
  double angle;
};

/// The way round a vertex from one direction to another.
struct LinkRoute {
  double angle = 0;
  std::vector<Index> faces;  ///< from the face of the first direction to that of the second
};

struct Arc {
  Index face;
  Index next, last;  // the other corners
  double angle;
};

Arc arc_of(const PathSurface& surface, Index face, Index vertex) {
  const int k = surface.corner_of_vertex(face, vertex);
  const Face& f = surface.face(face);
  return {face, f[next_corner(k)], f[previous_corner(k)], surface.corner_angle(face, k)};
}

/// A node of the link: an edge at the vertex, by its other end.
struct Node {
  Index vertex;
  double angle = std::numeric_limits<double>::infinity();
  int before = -1;           // the node before on the way
  Index through = kNoIndex;  // the face between
  bool closed = false;
};

class SegmentLink {
 public:
  SegmentLink(const PathSurface& surface, Index vertex) {
    for (const Index corner : surface.corners_at(vertex)) {
      arcs_.push_back(arc_of(surface, corner / 3, vertex));
      nodes_.push_back({arcs_.back().next});
      nodes_.push_back({arcs_.back().last});
    }
    std::ranges::sort(nodes_, {}, &Node::vertex);
    const auto same = [](const Node& a, const Node& b) { return a.vertex == b.vertex; };
    nodes_.erase(std::unique(nodes_.begin(), nodes_.end(), same), nodes_.end());
    at_node_.resize(nodes_.size());
    for (std::size_t i = 0; i < arcs_.size(); ++i) {
      at_node_[node(arcs_[i].next)].push_back(i);
      at_node_[node(arcs_[i].last)].push_back(i);
    }
  }

  /// Leaves a node out of all ways.
  void close(Index neighbour) { nodes_[node(neighbour)].closed = true; }

  /// Angles to all nodes nearer than `limit`.
  void spread(const Arc& from, double angle, double limit) {
    reach(node(from.next), angle, -1, from.face);
    reach(node(from.last), std::max(from.angle - angle, 0.0), -1, from.face);
    while (!queue_.empty()) {
      const auto [reached, at] = queue_.top();
      queue_.pop();
      if (reached >= limit) return;
      if (reached > nodes_[at].angle) continue;
      for (const std::size_t i : at_node_[at]) {
        const Arc& arc = arcs_[i];
        const std::size_t other = node(nodes_[at].vertex == arc.next ? arc.last : arc.next);
        reach(other, reached + arc.angle, static_cast<int>(at), arc.face);
      }
    }
  }

  double angle_to(Index neighbour) const { return nodes_[node(neighbour)].angle; }

  std::vector<Index> faces_to(Index neighbour) const {
    std::vector<Index> out;
    for (int at = static_cast<int>(node(neighbour)); at >= 0;
         at = nodes_[static_cast<std::size_t>(at)].before) {
      out.push_back(nodes_[static_cast<std::size_t>(at)].through);
    }
    std::ranges::reverse(out);
    return out;
  }

 private:
  std::size_t node(Index neighbour) const {
    return static_cast<std::size_t>(std::ranges::lower_bound(nodes_, neighbour, {}, &Node::vertex) -
                                    nodes_.begin());
  }

  void reach(std::size_t at, double angle, int before, Index through) {
    if (nodes_[at].closed || !(angle < nodes_[at].angle)) return;
    nodes_[at] = {nodes_[at].vertex, angle, before, through};
    queue_.emplace(angle, at);
  }

  using Entry = std::pair<double, std::size_t>;
  std::vector<Arc> arcs_;
  std::vector<Node> nodes_;
  std::vector<std::vector<std::size_t>> at_node_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
};

/// The narrowest way round the vertex, through any faces that share edges there: the shortest path
/// in the link, whose nodes are the edges at the vertex and whose arcs are the faces with their
/// angles. Where it is narrower than pi, a path that comes from one direction and leaves in the
/// other can be shortened on that side; where no way is, the path is straight there, whatever
/// number of faces meet. Nothing where every way is `limit` or more. Cost: O(n log n) for n faces.
/// `closed`: neighbours of the vertex; no way leads across the edges to them.
std::optional<LinkRoute> narrowest_way(const PathSurface& surface, Index vertex,
                                       const LinkPoint& from, const LinkPoint& to, double limit,
                                       std::span<const Index> closed) {
  const Arc first = arc_of(surface, from.face, vertex), last = arc_of(surface, to.face, vertex);
  LinkRoute best;
  best.angle = limit;
  if (closed.empty() && from.face == to.face && std::abs(from.angle - to.angle) < limit) {
    best = {std::abs(from.angle - to.angle), {from.face}};
  }
  SegmentLink link(surface, vertex);
  for (const Index neighbour : closed) link.close(neighbour);
  link.spread(first, from.angle, best.angle);
  const auto offer = [&](Index neighbour, double beyond) {
    const double angle = link.angle_to(neighbour) + std::max(beyond, 0.0);
    if (!(angle < best.angle)) return;
    best = {angle, link.faces_to(neighbour)};
    best.faces.push_back(to.face);
  };
  offer(last.next, to.angle);
  offer(last.last, last.angle - to.angle);
  if (best.faces.empty()) return std::nullopt;
  return best;
}

/// A path that turns by less than this (radians) gains less than round-off by being straightened.
constexpr double kStraight = 1e-8;

/// A step must shorten the segments by more than this share of their length, or it is round-off.
constexpr double kMinGain = 1e-14;

Error outside_face(std::size_t piece) {
  return {ErrorCode::kBadInput,
          "piece " + std::to_string(piece) + " of the path does not lie in its face",
          {"give two points of one face each"}};
}

/// The piece's face among the clean ones: the same, or another that holds both points where the
/// file's was left out.
std::optional<Index> clean_piece(const PathSurface& surface, const SurfacePoint& a,
                                 const SurfacePoint& b, Index file_face) {
  std::optional<Index> found;
  for (const Index f : surface.faces_at(a)) {
    if (!surface.express(b, f)) continue;
    if (surface.file_face(f) == file_face) return f;
    if (!found) found = f;
  }
  return found;
}

}  // namespace

StepBudget::StepBudget(const PathSurface& surface, const Progress& progress)
    : progress_(progress), most_(1000 + 4 * surface.faces().size()) {}

Result<void> StepBudget::spend() {
  constexpr std::size_t kAskEvery = 64;
  if (spent_ % kAskEvery == 0 && !report(progress_, "shortening the path", -1)) {
    return cancelled_error();
  }
  if (++spent_ <= most_) return {};
  return Error{ErrorCode::kBudgetEnded,
               "the path was not straight after " + std::to_string(most_) + " steps",
               {"choose nearer points or way-points"}};
}

Result<std::vector<PathSegment>> tight_segments(const PathSurface& surface,
                                                const SurfacePath& path) {
  std::vector<SurfacePoint> points;
  for (const SurfacePoint& point : path.points) {
    const auto inside = surface.into(point);
    if (!inside) return inside.error();
    points.push_back(*inside);
  }
  std::vector<PathSegment> segments;
  std::size_t from = 0;
  std::vector<Index> strip;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const auto face = i < path.faces.size()
                          ? clean_piece(surface, points[i], points[i + 1], path.faces[i])
                          : std::nullopt;
    if (!face) return outside_face(i);
    if (!strip.empty() && strip.back() != *face &&
        surface.shared_edge(strip.back(), *face) == kNoIndex) {
      return outside_face(i);
    }
    strip.push_back(*face);
    if (!points[i + 1].is_vertex() && i + 2 < points.size()) continue;
    for (PathSegment& segment :
         pull_tight(surface, points[from], points[i + 1], std::move(strip))) {
      segments.push_back(std::move(segment));
    }
    from = i + 1;
    strip.clear();
  }
  return segments;
}

std::optional<std::vector<Index>> strip_past(const PathSurface& surface, const PathSegment& in,
                                             const PathSegment& out,
                                             std::span<const Index> closed) {
  const auto way =
      narrowest_way(surface, in.to.vertex, {in.faces.back(), in.to_angle},
                    {out.faces.front(), out.from_angle}, std::numbers::pi - kStraight, closed);
  if (!way) return std::nullopt;
  std::vector<Index> strip = in.faces;
  strip.insert(strip.end(), way->faces.begin(), way->faces.end());
  strip.insert(strip.end(), out.faces.begin(), out.faces.end());
  return strip;
}

bool is_shorter(double length, double before) { return length < before * (1 - kMinGain); }

Result<void> straighten_bends(const PathSurface& surface, std::vector<PathSegment>& segments,
                              StepBudget& budget) {
  std::size_t i = 0;
  while (i + 1 < segments.size()) {
    if (auto spent = budget.spend(); !spent) return spent;
    auto strip = strip_past(surface, segments[i], segments[i + 1]);
    const double before = segments[i].length + segments[i + 1].length;
    std::vector<PathSegment> shorter;
    if (strip)
      shorter = pull_tight(surface, segments[i].from, segments[i + 1].to, *std::move(strip));
    if (!strip || !is_shorter(length_of(shorter), before)) {
      ++i;
      continue;
    }
    const auto first = segments.erase(segments.begin() + static_cast<std::ptrdiff_t>(i),
                                      segments.begin() + static_cast<std::ptrdiff_t>(i) + 2);
    segments.insert(first, std::make_move_iterator(shorter.begin()),
                    std::make_move_iterator(shorter.end()));
    if (i > 0) --i;
  }
  return {};
}

SurfacePath path_of(const PathSurface& surface, const std::vector<PathSegment>& segments,
                    const SurfacePoint& start) {
  std::vector<SurfacePoint> points = {segments.empty() ? start : segments.front().from};
  std::vector<Index> faces;
  for (const PathSegment& segment : segments) append_points(surface, segment, points, faces);
  SurfacePath path;
  for (const SurfacePoint& point : points) path.points.push_back(surface.out_of(point));
  for (const Index face : faces) path.faces.push_back(surface.file_face(face));
  path.length = length_of(*surface.mesh(), path.points);
  return path;
}

}  // namespace geotherm
