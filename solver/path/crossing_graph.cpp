// SPDX-License-Identifier: MIT
#include "solver/path/crossing_graph.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <set>
#include <utility>

namespace geotherm {
namespace {

/// Most edges that take part, and most points on them all. All of a coarse mesh take part, on which
/// distances tell least.
constexpr std::size_t kMaxEdges = 3000;
constexpr int kMaxPoints = 15000;

/// Points on an edge, evenly between its vertices: with 5 of them 0.4 % of paths on coarse tori
/// were missed, with 12 less than 0.1 %.
constexpr int kMinOnEdge = 5, kMaxOnEdge = 12;

/// Points of an edge at which the distances are estimated.
constexpr int kEdgeSamples = 5;

/// Edges take part up to this share beyond the length at hand. Values between the vertices are
/// worst where one of these lies in the shadow of a saddle, by a good part of the edge.
constexpr double kBeyond = 0.3;

constexpr int kNone = -1;

/// The distance at a share of an edge of length `edge` > 0, whose vertices have a and b: that of a
/// circular wave through both.
double between(double a, double b, double edge, double share) {
  const double along = (a - b) * (a + b) / (2 * edge) + edge / 2;
  const double height2 = (a - along) * (a + along);
  const double over_vertices = std::min(a + share * edge, b + (1 - share) * edge);
  if (!(height2 >= 0)) return over_vertices;
  return std::min(std::hypot(along - share * edge, std::sqrt(height2)), over_vertices);
}

/// A point of an edge, in one of its faces.
SurfacePoint on_edge(const PathSurface& surface, Index edge, double share) {
  const Index face = face_of(surface.edges().sides(edge).front());
  SurfacePoint point = SurfacePoint::in_face(face, {});
  const int low = surface.corner_of_vertex(face, surface.edges().low(edge));
  const int high = surface.corner_of_vertex(face, surface.edges().high(edge));
  point.weights[static_cast<std::size_t>(low)] = 1 - share;
  point.weights[static_cast<std::size_t>(high)] = share;
  return point;
}

/// True for two points of one edge, whose connection would only follow the edge.
bool on_same_edge(const PathSurface& surface, const SurfacePoint& a, const SurfacePoint& b,
                  Index face) {
  const auto p = surface.express(a, face), q = surface.express(b, face);
  if (p->is_vertex() && q->is_vertex()) return false;
  for (int k = 0; k < 3; ++k) {
    const auto away = [&](const SurfacePoint& x) {
      return x.is_vertex() ? surface.face(face)[k] != x.vertex
                           : x.weights[static_cast<std::size_t>(k)] == 0;
    };
    if (away(*p) && away(*q)) return true;
  }
  return false;
}

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
    for (int i = 1; i <= kEdgeSamples && edge > 0; ++i) {
      const double share = i / (kEdgeSamples + 1.0);
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

}  // namespace geotherm
