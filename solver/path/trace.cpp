// SPDX-License-Identifier: MIT
#include "solver/path/trace.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace geotherm {
namespace {

/// A line on its way, with points and faces of the surface.
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

/// Goes straight to the goal where a face holds both.
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

/// Where the way across a face leaves it.
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

/// False where it is stuck.
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

/// Goes on along edges.
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
