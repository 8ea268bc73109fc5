// SPDX-License-Identifier: MIT
#include "solver/mesh/merge_close.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <numeric>
#include <string>
#include <utility>

#include "geotherm/mesh.h"
#include "solver/core/sorting.h"
#include "solver/core/text.h"
#include "solver/mesh/connectivity.h"

namespace geotherm {
namespace {

constexpr std::size_t kLeaf = 8;

/// A k-d tree whose pairs of nodes are looked at from the whole down to points: nodes that are too
/// far apart, or one already, are passed over, and such as lie close altogether become one at once.
class Merger {
 public:
  Merger(std::span<const Vec3> points, double distance)
      : points_(points), distance_(distance), order_(points.size()), sets_(points.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    nodes_.reserve(4 * (points.size() / kLeaf + 1));
    if (!points.empty()) build(0, points.size());
  }

  std::vector<Index> run() {
    if (!nodes_.empty()) join_within(0);
    std::vector<Index> lowest(points_.size());
    for (std::size_t i = 0; i < lowest.size(); ++i) lowest[i] = sets_.root(static_cast<Index>(i));
    return lowest;
  }

 private:
  struct Node {
    std::size_t begin, end;
    Vec3 low, high;
    std::size_t right = 0;  ///< its left child follows it; 0: a leaf
    bool joined = false;    ///< all its points are one
  };

  const Vec3& at(std::size_t i) const { return points_[order_[i]]; }

  /// Whether so long a way is no longer than the distance. Measured in it, for squares of lengths
  /// may be out of range.
  bool is_close(const Vec3& way) const {
    return distance_ > 0 ? (way / distance_).squaredNorm() <= 1 : (way.array() == 0).all();
  }

  std::size_t build(std::size_t begin, std::size_t end) {
    const std::size_t number = nodes_.size();
    Node node{begin, end, at(begin), at(begin)};
    for (std::size_t i = begin; i < end; ++i) {
      node.low = node.low.cwiseMin(at(i));
      node.high = node.high.cwiseMax(at(i));
    }
    nodes_.push_back(node);
    if (end - begin <= kLeaf) return number;
    Index axis = 0;
    (node.high / 2 - node.low / 2).maxCoeff(&axis);
    const std::size_t middle = begin + (end - begin) / 2;
    const auto place = [this](std::size_t i) {
      return order_.begin() + static_cast<std::ptrdiff_t>(i);
    };
    std::nth_element(place(begin), place(middle), place(end),
                     [&](Index a, Index b) { return points_[a][axis] < points_[b][axis]; });
    build(begin, middle);
    const std::size_t right = build(middle, end);
    nodes_[number].right = right;
    return number;
  }

  bool is_one(const Node& a, const Node& b) {
    return a.joined && b.joined && sets_.root(order_[a.begin]) == sets_.root(order_[b.begin]);
  }

  void join_all(Node& node, Index with) {
    const std::size_t end = node.joined ? node.begin + 1 : node.end;
    for (std::size_t i = node.begin; i < end; ++i) sets_.join(order_[i], with);
    node.joined = true;
  }

  void join_within(std::size_t number) {
    Node& node = nodes_[number];
    if (is_close(node.high - node.low)) return join_all(node, order_[node.begin]);
    if (node.right == 0) {
      for (std::size_t i = node.begin; i < node.end; ++i) join_points(order_[i], i + 1, node.end);
      return;
    }
    join_within(number + 1);
    join_within(node.right);
    join_between(number + 1, node.right);
    node.joined = is_one(nodes_[number + 1], nodes_[node.right]);
  }

  void join_between(std::size_t first, std::size_t second) {
    Node& a = nodes_[first];
    Node& b = nodes_[second];
    if (is_one(a, b)) return;
    const Vec3 none = Vec3::Zero();
    if (!is_close((a.low - b.high).cwiseMax(b.low - a.high).cwiseMax(none))) return;
    if (is_close((a.high - b.low).cwiseMax(b.high - a.low))) {
      const Index one = order_[a.begin];
      join_all(a, one);
      return join_all(b, one);
    }
    if (a.right == 0 && b.right == 0) {
      for (std::size_t i = a.begin; i < a.end; ++i) join_points(order_[i], b.begin, b.end);
      return;
    }
    const bool split_first = b.right == 0 || (a.right != 0 && a.end - a.begin >= b.end - b.begin);
    if (split_first) {
      join_between(first + 1, second);
      join_between(a.right, second);
    } else {
      join_between(first, second + 1);
      join_between(first, b.right);
    }
  }

  void join_points(Index point, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (is_close(points_[point] - at(i))) sets_.join(point, order_[i]);
    }
  }

  std::span<const Vec3> points_;
  double distance_;
  std::vector<Index> order_;
  std::vector<Node> nodes_;
  DisjointSets sets_;
};

}  // namespace

std::vector<Index> merge_close(std::span<const Vec3> points, double distance) {
  return Merger(points, distance).run();
}

namespace {

/// Ascending.
std::vector<Index> vertices_in_use(const TriangleMesh& mesh) {
  const std::vector<char> used = vertices_in_faces(mesh.vertex_count(), mesh.faces());
  std::vector<Index> vertices;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (used[v]) vertices.push_back(v);
  }
  return vertices;
}

}  // namespace

Result<WeldedMesh> weld(const TriangleMesh& mesh, double distance) try {
  if (!(distance >= 0) || !std::isfinite(distance)) {
    return Error{ErrorCode::kBadInput,
                 "vertices cannot be merged over a distance of " + number_text(distance),
                 {"give a length in model units, or 0 for those that are equal"}};
  }
  const std::vector<Index> used = vertices_in_use(mesh);
  std::vector<Vec3> points;
  points.reserve(used.size());
  for (const Index v : used) points.push_back(mesh.positions()[v]);
  const std::vector<Index> lowest = merge_close(points, distance);

  std::vector<Index> same_as(static_cast<std::size_t>(mesh.vertex_count()));
  for (Index v = 0; v < mesh.vertex_count(); ++v) same_as[v] = mesh.standing_for(v);
  Index merged = 0;
  for (std::size_t i = 0; i < used.size(); ++i) {
    same_as[used[i]] = used[lowest[i]];
    merged += used[lowest[i]] != used[i];
  }
  // What stood for others before may have become one with a lower vertex.
  for (Index& low : same_as) low = same_as[low];
  auto welded = TriangleMesh::build({mesh.positions().begin(), mesh.positions().end()},
                                    {mesh.faces().begin(), mesh.faces().end()}, std::move(same_as));
  if (!welded) return welded.error();
  if (!used.empty() && std::ranges::all_of(welded->faces(), repeats_corner)) {
    return Error{ErrorCode::kBadInput,
                 "every face collapses when vertices within " + number_text(distance) +
                     " of each other are merged (" + std::to_string(used.size()) +
                     " vertices become " +
                     std::to_string(used.size() - static_cast<std::size_t>(merged)) + ")",
                 {"give less than the length of an edge"}};
  }
  return WeldedMesh{*std::move(welded), merged};
} catch (const std::bad_alloc&) {
  return Error{
      ErrorCode::kOutOfMemory,
      "the memory ended while the " + std::to_string(mesh.vertex_count()) + " vertices were merged",
      {"take a mesh with fewer faces"}};
}

}  // namespace geotherm
