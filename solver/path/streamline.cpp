// SPDX-License-Identifier: MIT
#include "solver/path/streamline.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace geotherm {
namespace {

/// Least height of a face, as a share of its longest side, that has a gradient.
constexpr double kFlatField = 1e-14;

/// Finds the steepest descent around one point.
class Choice {
 public:
  Choice(const PathSurface& surface, const DescentField& field, std::span<const Index> faces)
      : surface_(surface), field_(field) {
    if (!field.log_heat) return;
    log_largest_ = -std::numeric_limits<double>::infinity();
    for (const Index f : faces) {
      for (const Index v : surface.face(f)) log_largest_ = std::max(log_largest_, field.values[v]);
    }
    if (!std::isfinite(log_largest_)) log_largest_ = 0;
  }

  /// Offers the descent across the face, if it leads into the face: no weight that is 0 may become
  /// less.
  void offer_face(Index f, const std::array<double, 3>& weights) {
    const Descent fall = fall_of(f);
    if (!(fall.slope > 0 && fall.slope >= best.slope)) return;
    for (std::size_t k = 0; k < 3; ++k) {
      if (weights[k] == 0 && fall.rates[k] < 0) return;
    }
    best = fall;
  }

  /// Offers the descent along an edge of `face` to a vertex that is lower than the other.
  void offer_edge(Index from, Index to, Index face) {
    if (!is_lower(to, from)) return;
    const double length = (surface_.position(to) - surface_.position(from)).norm();
    const double slope =
        length > 0 ? (height(from) - height(to)) / length : std::numeric_limits<double>::max();
    // A difference that underflows still leads down.
    offer_vertex(to, face, std::max(slope, std::numeric_limits<double>::min()));
  }

  /// Offers the lowest corner of a face without a gradient, where any descent will do.
  void offer_lowest_corner(Index f) {
    const Face& face = surface_.face(f);
    Index lowest = face[0], highest = face[0];
    for (const Index v : face) {
      if (is_lower(v, lowest)) lowest = v;
      if (is_lower(highest, v)) highest = v;
    }
    if (is_lower(lowest, highest)) offer_vertex(lowest, f, std::numeric_limits<double>::min());
  }

  Descent best;

 private:
  void offer_vertex(Index vertex, Index face, double slope) {
    if (slope > best.slope) best = {slope, face, vertex, {}};
  }

  /// The height of a vertex: -u over the largest u nearby, or the value itself, in units of the
  /// surface.
  double height(Index v) const {
    return field_.log_heat ? -std::exp(field_.values[v] - log_largest_)
                           : field_.values[v] / surface_.unit();
  }
  bool is_lower(Index a, Index b) const {
    return field_.log_heat ? field_.values[a] > field_.values[b]
                           : field_.values[a] < field_.values[b];
  }

  Descent fall_of(Index f) const {
    const Face& face = surface_.face(f);
    const std::array<Vec3, 3> side = {surface_.position(face[2]) - surface_.position(face[1]),
                                      surface_.position(face[0]) - surface_.position(face[2]),
                                      surface_.position(face[1]) - surface_.position(face[0])};
    const double area2 = side[0].cross(side[1]).norm();
    const double longest = std::max({side[0].norm(), side[1].norm(), side[2].norm()});
    if (!(area2 > kFlatField * longest * longest)) return {};
    // The gradient, turned by a right angle, times twice the area. Sides add up to 0, so that any
    // height may be taken for 0.
    const Vec3 turned = (height(face[1]) - height(face[0])) * side[1] +
                        (height(face[2]) - height(face[0])) * side[2];
    const double steepness = turned.norm();
    if (!(steepness > 0) || !std::isfinite(steepness / area2)) return {};
    Descent fall{steepness / area2, f, kNoIndex, {}};
    for (std::size_t k = 0; k < 3; ++k) fall.rates[k] = -side[k].dot(turned / steepness);
    return fall;
  }

  const PathSurface& surface_;
  const DescentField& field_;
  double log_largest_ = 0;
};

std::array<double, 3> one_at(int corner) {
  std::array<double, 3> weights{};
  weights[static_cast<std::size_t>(corner)] = 1;
  return weights;
}

}  // namespace

Descent steepest_descent(const PathSurface& surface, const DescentField& field,
                         const SurfacePoint& point) {
  const std::vector<Index> faces = surface.faces_at(point);
  Choice choice(surface, field, faces);
  if (point.is_vertex()) {
    for (const Index f : faces) {
      const int k = surface.corner_of_vertex(f, point.vertex);
      choice.offer_face(f, one_at(k));
      choice.offer_edge(point.vertex, surface.face(f)[next_corner(k)], f);
      choice.offer_edge(point.vertex, surface.face(f)[previous_corner(k)], f);
    }
    return choice.best;
  }
  for (const Index f : faces) choice.offer_face(f, surface.express(point, f)->weights);
  for (int k = 0; k < 3; ++k) {
    if (point.weights[static_cast<std::size_t>(k)] != 0) continue;
    const Index a = surface.face(point.face)[next_corner(k)];
    const Index b = surface.face(point.face)[previous_corner(k)];
    choice.offer_edge(a, b, point.face);
    choice.offer_edge(b, a, point.face);
  }
  if (!(choice.best.slope > 0)) choice.offer_lowest_corner(point.face);
  return choice.best;
}

namespace {

/// A line that is being traced, with points and faces of the surface.
struct Line {
  std::vector<SurfacePoint> points;
  std::vector<Index> faces;

  void append(const SurfacePoint& point, Index face) {
    points.push_back(point);
    faces.push_back(face);
  }

  SurfacePath of_file(const PathSurface& surface) const {
    SurfacePath out;
    for (const SurfacePoint& point : points) out.points.push_back(surface.out_of(point));
    for (const Index face : faces) out.faces.push_back(surface.file_face(face));
    out.length = length_of(*surface.mesh(), out.points);
    return out;
  }
};

bool same_vertex(const SurfacePoint& a, const SurfacePoint& b) {
  return a.is_vertex() && a.vertex == b.vertex;
}

/// Ends the line with a straight piece where one face holds its last point and the goal.
bool finish(const PathSurface& surface, const SurfacePoint& goal, Line& line) {
  const SurfacePoint& here = line.points.back();
  if (same_vertex(here, goal)) return true;
  for (const Index f : surface.faces_at(here)) {
    const auto end = surface.express(goal, f);
    if (!end) continue;
    line.append(*end, f);
    return true;
  }
  return false;
}

/// The point at which the line across a face leaves it.
SurfacePoint across(const PathSurface& surface, const SurfacePoint& from, const Descent& way) {
  /// A point with a weight below this is on an edge, and with two of them at a vertex.
  constexpr double kOnEdge = 1e-12;
  std::array<double, 3> weights = from.weights;
  if (from.is_vertex()) {
    weights = {};
    weights[static_cast<std::size_t>(surface.corner_of_vertex(way.face, from.vertex))] = 1;
  }
  double time = std::numeric_limits<double>::infinity();
  std::size_t leaves = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    if (!(way.rates[k] < 0) || !(weights[k] / -way.rates[k] < time)) continue;
    time = weights[k] / -way.rates[k];
    leaves = k;
  }
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    weights[k] += time * way.rates[k];
    if (k == leaves || weights[k] < kOnEdge) weights[k] = 0;
    sum += weights[k];
  }
  for (std::size_t k = 0; k < 3; ++k) {
    if (weights[k] == sum) return SurfacePoint::at_vertex(surface.face(way.face)[k]);
    weights[k] /= sum;
  }
  return SurfacePoint::in_face(way.face, weights);
}

/// Follows the field to the goal; false where nothing leads down before it.
bool follow(const PathSurface& surface, const DescentField& field, const SurfacePoint& goal,
            Line& line) {
  const std::size_t most = 100 + 4 * surface.faces().size();
  for (std::size_t step = 0; step < most; ++step) {
    if (finish(surface, goal, line)) return true;
    const SurfacePoint here = line.points.back();
    const Descent way = steepest_descent(surface, field, here);
    if (!(way.slope > 0)) return false;
    if (way.vertex != kNoIndex) {
      line.append(SurfacePoint::at_vertex(way.vertex), way.face);
    } else {
      line.append(across(surface, *surface.express(here, way.face), way), way.face);
    }
  }
  return false;
}

/// The corner that the point is nearest to, by its weights.
Index nearest_corner(const PathSurface& surface, const SurfacePoint& point) {
  if (point.is_vertex()) return point.vertex;
  const auto largest = std::ranges::max_element(point.weights) - point.weights.begin();
  return surface.face(point.face)[static_cast<std::size_t>(largest)];
}

/// Continues the line along edges to the goal.
Result<void> follow_edges(const PathSurface& surface, const SurfacePoint& goal, Line& line) {
  if (finish(surface, goal, line)) return {};
  const auto way = surface.edge_graph().shortest_path(nearest_corner(surface, line.points.back()),
                                                      nearest_corner(surface, goal));
  if (!way) return way.error();
  for (const Index v : *way) {
    finish(surface, SurfacePoint::at_vertex(v), line);  // neighbours share a face
  }
  finish(surface, goal, line);
  return {};
}

struct Ends {
  SurfacePoint start, goal;
};

Result<Ends> ends_on(const PathSurface& surface, const SurfacePoint& start,
                     const SurfacePoint& goal) {
  const auto first = surface.into(start), last = surface.into(goal);
  if (!first) return first.error();
  if (!last) return last.error();
  return Ends{*first, *last};
}

}  // namespace

Result<Streamline> trace_streamline(const PathSurface& surface, const DescentField& field,
                                    const SurfacePoint& start, const SurfacePoint& goal) {
  const auto ends = ends_on(surface, start, goal);
  if (!ends) return ends.error();
  Line line{{ends->start}, {}};
  Streamline out;
  out.stuck = !follow(surface, field, ends->goal, line);
  if (out.stuck) {
    if (auto went = follow_edges(surface, ends->goal, line); !went) return went.error();
  }
  out.path = line.of_file(surface);
  return out;
}

Result<SurfacePath> edge_path(const PathSurface& surface, const SurfacePoint& start,
                              const SurfacePoint& goal) {
  const auto ends = ends_on(surface, start, goal);
  if (!ends) return ends.error();
  Line line{{ends->start}, {}};
  if (auto went = follow_edges(surface, ends->goal, line); !went) return went.error();
  return line.of_file(surface);
}

}  // namespace geotherm
