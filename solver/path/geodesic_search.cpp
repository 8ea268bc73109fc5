// SPDX-License-Identifier: MIT
#include "solver/path/geodesic_search.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <set>
#include <utility>
#include <vector>

#include "solver/path/crossing_graph.h"
#include "solver/path/edge_points.h"
#include "solver/path/shorten.h"
#include "solver/path/trace.h"
#include "solver/path/within_memory.h"

namespace geotherm {
namespace {

/// Vertices are tried while the distances to both ends say that a path through them is longer than
/// the best so far by less than this share, which is more than the error of such distances.
constexpr double kDistanceError = 1e-3;

/// Most vertices tried; of hundreds of paths on rough scans none gained by more.
constexpr int kMaxTries = 16;

/// Paths of the crossing graph are tried while they are longer than the best so far by less than
/// this share, which is more than they lose by their few points on each edge.
constexpr double kGraphError = 0.04;

/// Most of them tried, and most faces that these may run through in all beyond the first: many
/// short ones on coarse meshes, a few long ones on fine meshes.
constexpr std::size_t kMaxRoutes = 300, kMaxFaces = 20000;

/// Most edges that take part, and most points on them all. All of a coarse mesh take part, on which
/// distances tell least.
constexpr std::size_t kMaxEdges = 3000;
constexpr int kMaxPoints = 15000;

/// Points on an edge, evenly between its vertices: with 5 of them 0.4 % of paths on coarse tori
/// were missed, with 12 less than 0.1 %.
constexpr int kMinOnEdge = 5, kMaxOnEdge = 12;

/// Points of an edge at which the distances are estimated.
constexpr int kSamples = 5;

/// Edges take part up to this share beyond the length at hand. Values between the vertices are
/// worst where one of these lies in the shadow of a saddle, by a good part of the edge.
constexpr double kBeyond = 0.3;

constexpr int kNone = -1;

class Search {
 public:
  Search(const PathSurface& surface, const GeodesicEnds& ends, const Progress& progress)
      : surface_(surface),
        ends_(ends),
        progress_(progress),
        seen_(static_cast<std::size_t>(surface.mesh()->vertex_count()), 0) {}

  Result<SurfacePath> run() {
    auto along_edges = edge_path(surface_, ends_.from, ends_.to);
    if (!along_edges) return along_edges.error();
    if (auto tried = shorten_from(*along_edges); !tried) return tried.error();
    auto down = streamline(ends_.to, ends_.from, ends_.from_distances);
    if (!down) return down.error();
    if (auto tried = shorten_from(reversed(*std::move(down))); !tried) return tried.error();
    auto up = streamline(ends_.from, ends_.to, ends_.to_distances);
    if (!up) return up.error();
    if (auto tried = shorten_from(*up); !tried) return tried.error();
    if (auto tried = through_vertices(); !tried) return tried.error();
    if (auto tried = through_edges(); !tried) return tried.error();
    return best_;
  }

 private:
  Result<SurfacePath> streamline(const SurfacePoint& from, const SurfacePoint& to,
                                 std::span<const double> distances) const {
    auto line = trace_streamline(surface_, {distances}, from, to);
    if (!line) return line.error();
    return std::move(line->path);
  }

  Result<void> shorten_from(const SurfacePath& start) {
    auto path = shorten(surface_, start, true, progress_);
    if (!path) return path.error();
    mark(start);
    mark(*path);
    if (best_.points.empty() || path->length < best_.length) best_ = *std::move(path);
    return {};
  }

  /// Vertices beside a path have nothing new to offer.
  void mark(const SurfacePath& path) {
    for (const Index f : path.faces) {
      for (const Index v : surface_.mesh()->faces()[f]) seen_[v] = 1;
    }
  }

  double length_through(Index v) const { return ends_.from_distances[v] + ends_.to_distances[v]; }

  Result<void> through_vertices() {
    const double most = best_.length * (1 + kDistanceError);
    std::vector<std::pair<double, Index>> near;
    for (Index v = 0; v < surface_.mesh()->vertex_count(); ++v) {
      if (length_through(v) < most) near.emplace_back(length_through(v), v);
    }
    std::ranges::sort(near);
    int tries = 0;
    for (const auto& [length, v] : near) {
      if (tries == kMaxTries || length > best_.length * (1 + kDistanceError)) break;
      if (seen_[v] || surface_.corners_at(v).empty()) continue;
      ++tries;
      const SurfacePoint vertex = SurfacePoint::at_vertex(v);
      auto in = streamline(vertex, ends_.from, ends_.from_distances);
      if (!in) return in.error();
      const auto out = streamline(vertex, ends_.to, ends_.to_distances);
      if (!out) return out.error();
      SurfacePath through = reversed(*std::move(in));
      append(through, *out);
      if (auto tried = shorten_from(through); !tried) return tried;
    }
    return {};
  }

  Result<void> through_edges() {
    if (!(best_.length > 0)) return {};
    const CrossingGraph graph(surface_, ends_, best_.length);
    std::size_t faces = 0;
    for (const SurfacePath& route : graph.routes(best_.length * (1 + kGraphError), kMaxRoutes)) {
      if (faces > kMaxFaces || route.length > best_.length * (1 + kGraphError)) break;
      faces += route.faces.size();
      if (auto tried = shorten_from(route); !tried) return tried;
    }
    return {};
  }

  const PathSurface& surface_;
  const GeodesicEnds& ends_;
  const Progress& progress_;
  std::vector<char> seen_;
  SurfacePath best_;
};

}  // namespace

CrossingGraph::CrossingGraph(const PathSurface& surface, const GeodesicEnds& ends, double length)
    : surface_(surface),
      longest_(length / surface.unit() * (1 + kBeyond)),
      row_of_face_(surface.faces().size(), kNoIndex),
      node_of_vertex_(static_cast<std::size_t>(surface.mesh()->vertex_count()), kNone) {
  choose_edges(ends);
  from_ = add_end(*surface_.into(ends.from));
  to_ = add_end(*surface_.into(ends.to));
  to_from_ = tree_to(from_);
  to_to_ = tree_to(to_);
}

void CrossingGraph::choose_edges(const GeodesicEnds& ends) {
  const bool all = static_cast<std::size_t>(surface_.edges().edge_count()) <= kMaxEdges;
  std::vector<std::pair<double, Index>> chosen;
  const double unit = surface_.unit();
  for (Index e = 0; e < surface_.edges().edge_count(); ++e) {
    const Index low = surface_.edges().low(e), high = surface_.edges().high(e);
    const double edge = (surface_.position(high) - surface_.position(low)).norm();
    const double a = ends.from_distances[low] / unit, b = ends.from_distances[high] / unit;
    const double c = ends.to_distances[low] / unit, d = ends.to_distances[high] / unit;
    double least = std::min(a + c, b + d);
    if (!all && least - 2 * edge > longest_) continue;
    for (int i = 1; i <= kSamples && edge > 0; ++i) {
      const double share = i / (kSamples + 1.0);
      least = std::min(least, between(a, b, edge, share) + between(c, d, edge, share));
    }
    if (all || least <= longest_) chosen.emplace_back(least, e);
  }
  if (chosen.size() > kMaxEdges) {
    std::ranges::nth_element(chosen, chosen.begin() + kMaxEdges);
    chosen.resize(kMaxEdges);
    std::ranges::sort(chosen);
  }
  const int points =
      std::clamp(kMaxPoints / std::max(static_cast<int>(chosen.size()), 1), kMinOnEdge, kMaxOnEdge);
  for (const auto& [least, e] : chosen) {
    for (const Index v : {surface_.edges().low(e), surface_.edges().high(e)}) {
      if (node_of_vertex_[v] == kNone) node_of_vertex_[v] = add_node(SurfacePoint::at_vertex(v));
    }
    for (int i = 1; i <= points; ++i) {
      add_node(on_edge(surface_, e, i / (points + 1.0)));
    }
  }
}

int CrossingGraph::add_node(const SurfacePoint& point) {
  const int node = static_cast<int>(nodes_.size());
  nodes_.push_back({point, surface_.position(point), surface_.faces_at(point)});
  for (const Index f : nodes_.back().faces) {
    if (row_of_face_[f] == kNoIndex) {
      row_of_face_[f] = static_cast<Index>(nodes_in_.size());
      nodes_in_.emplace_back();
    }
    nodes_in_[row_of_face_[f]].push_back(node);
  }
  return node;
}

int CrossingGraph::add_end(const SurfacePoint& point) {
  if (!point.is_vertex()) return add_node(point);
  int& node = node_of_vertex_[point.vertex];
  if (node == kNone) node = add_node(point);
  return node;
}

CrossingGraph::Tree CrossingGraph::tree_to(int end) const {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Tree tree{std::vector<double>(nodes_.size(), kFar), std::vector<int>(nodes_.size(), kNone),
            std::vector<Index>(nodes_.size(), kNoIndex)};
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  tree.length[end] = 0;
  queue.emplace(0.0, end);
  while (!queue.empty()) {
    const auto [length, here] = queue.top();
    queue.pop();
    if (length > tree.length[here]) continue;
    for (const Index f : nodes_[here].faces) {
      for (const int other : nodes_in_[row_of_face_[f]]) {
        const double through = length + (nodes_[other].position - nodes_[here].position).norm();
        if (!(through < tree.length[other]) || through > longest_) continue;
        const bool ends = here == from_ || here == to_ || other == from_ || other == to_;
        if (!ends && on_same_edge(surface_, nodes_[here].point, nodes_[other].point, f)) continue;
        tree.length[other] = through;
        tree.next[other] = here;
        tree.face[other] = f;
        queue.emplace(through, other);
      }
    }
  }
  return tree;
}

SurfacePath CrossingGraph::route_through(int node, std::vector<char>& used) const {
  SurfacePath path;
  const auto walk = [&](const Tree& tree) {
    for (int i = node; tree.next[i] != kNone; i = tree.next[i]) {
      used[i] = 1;
      path.faces.push_back(surface_.file_face(tree.face[i]));
      path.points.push_back(surface_.out_of(nodes_[tree.next[i]].point));
    }
  };
  walk(to_from_);
  std::ranges::reverse(path.faces);
  std::ranges::reverse(path.points);
  path.points.push_back(surface_.out_of(nodes_[node].point));
  walk(to_to_);
  used[node] = 1;
  path.length = (to_from_.length[node] + to_to_.length[node]) * surface_.unit();
  return path;
}

std::vector<SurfacePath> CrossingGraph::routes(double longest, std::size_t most) const {
  std::vector<std::pair<double, int>> order;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const double length = to_from_.length[i] + to_to_.length[i];
    if (length <= longest / surface_.unit()) order.emplace_back(length, static_cast<int>(i));
  }
  std::ranges::sort(order);
  std::vector<SurfacePath> out;
  std::set<std::vector<Index>> strips;
  std::vector<char> used(nodes_.size(), 0);
  for (const auto& [length, node] : order) {
    if (out.size() == most) break;
    if (used[node]) continue;
    SurfacePath path = route_through(node, used);
    if (strips.insert(path.faces).second) out.push_back(std::move(path));
  }
  return out;
}

Result<SurfacePath> search_geodesic(const PathSurface& surface, const GeodesicEnds& ends,
                                    const Progress& progress) {
  return within_memory("a geodesic", *surface.mesh(), progress, [&](const Progress& watched) {
    return Search(surface, ends, watched).run();
  });
}

}  // namespace geotherm
