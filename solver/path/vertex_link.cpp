// SPDX-License-Identifier: MIT
#include "solver/path/vertex_link.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>

namespace geotherm {
namespace {

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

class Link {
 public:
  Link(const PathSurface& surface, Index vertex) {
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

}  // namespace

std::optional<LinkRoute> narrowest_way(const PathSurface& surface, Index vertex,
                                       const LinkPoint& from, const LinkPoint& to, double limit,
                                       std::span<const Index> closed) {
  const Arc first = arc_of(surface, from.face, vertex), last = arc_of(surface, to.face, vertex);
  LinkRoute best;
  best.angle = limit;
  if (closed.empty() && from.face == to.face && std::abs(from.angle - to.angle) < limit) {
    best = {std::abs(from.angle - to.angle), {from.face}};
  }
  Link link(surface, vertex);
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

}  // namespace geotherm
