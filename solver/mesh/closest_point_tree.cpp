// SPDX-License-Identifier: MIT
#include "solver/mesh/closest_point_tree.h"

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "solver/mesh/connectivity.h"
#include "solver/mesh/local_simplex.h"

namespace geotherm {
namespace {

/// Of a box, in shares of what is near: more than the round-off of distances, so that what they
/// decide among equals is not left out.
constexpr double kBoxSlack = 1e-12;

/// Places farther out than this, in units of the frame, are nearer to no box than to another.
constexpr double kTreeReach = 1e6;

/// The nearest face so far, the first among equals, whatever the order of the faces.
struct NearestFace {
  double distance = std::numeric_limits<double>::infinity();
  std::array<double, 3> weights{};
  Index face = kNoIndex;

  void offer(const TriangleMesh& mesh, Index f, const Vec3& query) {
    const Face& corners = mesh.faces()[f];
    if (repeats_corner(corners)) return;
    const auto p = mesh.positions();
    LocalSimplex<3> local({p[corners[0]], p[corners[1]], p[corners[2]]}, query);
    local.offer_triangle(0, 1, 2);
    for (std::size_t k = 0; k < 3; ++k) local.offer_edge(k, (k + 1) % 3);
    if (local.distance > distance || (local.distance == distance && f >= face)) return;
    if (!(local.distance < std::numeric_limits<double>::infinity())) return;
    distance = local.distance;
    weights = local.weights;
    face = f;
  }

  Result<ClosestPoint> on(const TriangleMesh& mesh) const {
    if (face == kNoIndex) {
      return Error{ErrorCode::kBadInput,
                   "none of the " + std::to_string(mesh.face_count()) +
                       " faces can hold a point; each repeats a corner or is infinitely far"};
    }
    for (std::size_t k = 0; k < 3; ++k) {
      if (weights[k] != 1.0) continue;
      return ClosestPoint{SurfacePoint::at_vertex(mesh.faces()[face][k]), distance};
    }
    return ClosestPoint{SurfacePoint::in_face(face, weights), distance};
  }
};

Result<void> check_place(const Vec3& query) {
  if (query.allFinite()) return {};
  return Error{ErrorCode::kBadInput, "the point has a coordinate that is not finite"};
}

/// Of a place in the frame to the box.
double box_distance(const FloatBox& box, const Vec3& place) {
  Vec3 beyond;
  for (int k = 0; k < 3; ++k) {
    beyond[k] = std::max({box.low[k] - place[k], place[k] - box.high[k], 0.0});
  }
  return beyond.norm();
}

}  // namespace

Result<ClosestPoint> closest_point(const TriangleMesh& mesh, const Vec3& query) {
  if (auto finite = check_place(query); !finite) return finite.error();
  NearestFace nearest;
  for (Index f = 0; f < mesh.face_count(); ++f) nearest.offer(mesh, f, query);
  return nearest.on(mesh);
}

Result<ClosestPointTree> ClosestPointTree::build(const TriangleMesh& mesh,
                                                 const Progress& progress) {
  const BoxFrame frame = frame_of(mesh);
  std::vector<BoxItem> items;
  items.reserve(static_cast<std::size_t>(mesh.face_count()));
  const auto p = mesh.positions();
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const Face& face = mesh.faces()[f];
    if (repeats_corner(face)) continue;
    items.push_back(
        {box_of({frame.into(p[face[0]]), frame.into(p[face[1]]), frame.into(p[face[2]])}), f});
  }
  auto tree = build_box_tree(std::move(items), progress);
  if (!tree) return tree.error();
  return ClosestPointTree(mesh, frame, *std::move(tree));
}

Result<ClosestPoint> ClosestPointTree::to(const Vec3& query) const {
  if (auto finite = check_place(query); !finite) return finite.error();
  const Vec3 place = frame_.into(query);
  const double reach = place.cwiseAbs().maxCoeff();
  if (!(reach < kTreeReach)) return closest_point(*mesh_, query);
  struct Waiting {
    std::uint32_t node;
    double distance;
  };
  std::array<Waiting, BoxTree::kMaxDepth + 1> waiting;
  std::size_t count = 0;
  if (!tree_.nodes.empty()) waiting[count++] = {0, box_distance(tree_.nodes[0].box, place)};
  NearestFace nearest;
  while (count > 0) {
    const Waiting at = waiting[--count];
    if (at.distance > nearest.distance * frame_.scale + kBoxSlack * (2 + reach)) continue;
    const BoxNode& node = tree_.nodes[at.node];
    if (node.count > 0) {
      for (const Index f : std::span(tree_.ids).subspan(node.first, node.count)) {
        nearest.offer(*mesh_, f, query);
      }
      continue;
    }
    Waiting near{node.first, box_distance(tree_.nodes[node.first].box, place)};
    Waiting far{node.first + 1, box_distance(tree_.nodes[node.first + 1].box, place)};
    if (far.distance < near.distance) std::swap(near, far);
    waiting[count++] = far;
    waiting[count++] = near;
  }
  return nearest.on(*mesh_);
}

}  // namespace geotherm
