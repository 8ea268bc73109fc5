// SPDX-License-Identifier: MIT
#include "solver/directions/pointed_mesh.h"

#include <Eigen/LU>
#include <algorithm>
#include <map>
#include <utility>

#include "geotherm/path.h"
#include "solver/mesh/connectivity.h"

namespace geotherm {
namespace {

using Weights = PointedMesh::Weights;

/// Points nearer to a side or a corner than this share of the face's height lie on it: thinner
/// faces would have no angles to go by.
constexpr double kOnSide = 1e-9;

Weights mixed(const std::array<Weights, 3>& corners, const Weights& w) {
  Weights out{};
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < 3; ++i) out[i] += w[k] * corners[k][i];
  }
  return out;
}

Weights rounded(Weights w) {
  double sum = 0;
  for (double& x : w) x = x < kOnSide ? 0 : x, sum += x;
  for (double& x : w) x /= sum;
  return w;
}

constexpr std::array<Weights, 3> kWholeFace = {Weights{1, 0, 0}, Weights{0, 1, 0},
                                               Weights{0, 0, 1}};

class Cutter {
 public:
  explicit Cutter(const TriangleMesh& mesh)
      : mesh_(mesh),
        positions_(mesh.positions().begin(), mesh.positions().end()),
        faces_(mesh.faces().begin(), mesh.faces().end()),
        parents_(faces_.size()),
        corners_(faces_.size(), kWholeFace) {
    for (std::size_t f = 0; f < parents_.size(); ++f) parents_[f] = static_cast<Index>(f);
  }

  /// The vertex that the point has become.
  Index add(const SurfacePoint& point) {
    if (point.is_vertex()) return mesh_.standing_for(point.vertex);
    const auto [face, weights] = part_with(point);
    const auto largest = std::ranges::max_element(weights) - weights.begin();
    const auto zeros = std::ranges::count(weights, 0.0);
    const Face corners = faces_[static_cast<std::size_t>(face)];
    if (zeros == 2) return corners[static_cast<int>(largest)];
    const auto v = static_cast<Index>(positions_.size());
    positions_.push_back(position_at(mesh_, point));
    added_.push_back(point);
    if (zeros == 0) {
      cut_face(face, weights, v);
      return v;
    }
    const int k = next_corner(static_cast<int>(std::ranges::find(weights, 0.0) - weights.begin()));
    const Index a = corners[k], b = corners[next_corner(k)];
    const double share = weights[static_cast<std::size_t>(next_corner(k))];
    for (std::size_t f = 0, count = faces_.size(); f < count; ++f) cut_edge(f, a, b, share, v);
    return v;
  }

  Result<PointedMesh> finish(std::vector<Index> vertices) && {
    std::vector<Index> same(mesh_.same_as().begin(), mesh_.same_as().end());
    if (!same.empty()) {
      for (auto v = static_cast<Index>(same.size()); v < std::ssize(positions_); ++v) {
        same.push_back(v);
      }
    }
    auto mesh = same.empty() ? TriangleMesh::build(std::move(positions_), std::move(faces_))
                             : TriangleMesh::build(std::move(positions_), std::move(faces_), same);
    if (!mesh) return mesh.error();
    return PointedMesh{std::make_shared<const TriangleMesh>(*std::move(mesh)),
                       std::move(vertices),
                       std::move(parents_),
                       std::move(corners_),
                       std::move(added_),
                       mesh_.vertex_count()};
  }

 private:
  /// The part of the face that holds the point, and its weights there.
  std::pair<Index, Weights> part_with(const SurfacePoint& point) const {
    const auto cut = parts_.find(point.face);
    if (cut == parts_.end()) return {point.face, rounded(point.weights)};
    std::pair<Index, Weights> best{kNoIndex, {}};
    double best_least = -kUnreached;
    for (const Index part : cut->second) {
      Eigen::Matrix3d corners;
      for (int k = 0; k < 3; ++k) {
        for (int i = 0; i < 3; ++i) {
          corners(i, k) = corners_[static_cast<std::size_t>(part)][static_cast<std::size_t>(k)]
                                  [static_cast<std::size_t>(i)];
        }
      }
      const Vec3 w =
          corners.partialPivLu().solve(Vec3(point.weights[0], point.weights[1], point.weights[2]));
      if (!(w.minCoeff() > best_least)) continue;
      best_least = w.minCoeff();
      best = {part, {w[0], w[1], w[2]}};
    }
    best.second = rounded(best.second);
    return best;
  }

  /// One corner of a face becomes `v`, whose weights in the parent are given.
  void put(std::size_t f, int corner, Index v, const Weights& place) {
    faces_[f][corner] = v;
    corners_[f][static_cast<std::size_t>(corner)] = place;
  }

  /// A copy of a face as a further part of its parent.
  std::size_t copy(std::size_t f) {
    const Index parent = parents_[f];
    auto& parts = parts_[parent];
    if (parts.empty()) parts.push_back(static_cast<Index>(f));
    parts.push_back(static_cast<Index>(faces_.size()));
    faces_.push_back(Face(faces_[f]));
    parents_.push_back(parent);
    corners_.push_back(std::array<Weights, 3>(corners_[f]));
    return faces_.size() - 1;
  }

  void cut_face(Index face, const Weights& weights, Index v) {
    const auto f = static_cast<std::size_t>(face);
    const Weights place = mixed(corners_[f], weights);
    const std::size_t second = copy(f), third = copy(f);
    put(f, 2, v, place);
    put(second, 0, v, place);
    put(third, 1, v, place);
  }

  void cut_edge(std::size_t f, Index a, Index b, double share, Index v) {
    const Face face = faces_[f];
    if (repeats_corner(face)) return;
    for (int k = 0; k < 3; ++k) {
      const int next = next_corner(k);
      const bool along = face[k] == a && face[next] == b;
      if (!along && !(face[k] == b && face[next] == a)) continue;
      Weights w{};
      w[static_cast<std::size_t>(k)] = along ? 1 - share : share;
      w[static_cast<std::size_t>(next)] = along ? share : 1 - share;
      const Weights place = mixed(corners_[f], w);
      const std::size_t second = copy(f);
      put(f, next, v, place);
      put(second, k, v, place);
      return;
    }
  }

  const TriangleMesh& mesh_;
  std::vector<Vec3> positions_;
  std::vector<Face> faces_;
  std::vector<Index> parents_;
  std::vector<std::array<Weights, 3>> corners_;
  std::map<Index, std::vector<Index>> parts_;  ///< of faces that were cut
  std::vector<SurfacePoint> added_;
};

}  // namespace

SurfacePoint PointedMesh::out_of(const SurfacePoint& point) const {
  if (point.is_vertex()) {
    const Index v = point.vertex;
    return v < given_vertices ? point : added[static_cast<std::size_t>(v - given_vertices)];
  }
  if (parents.empty()) return point;
  const auto f = static_cast<std::size_t>(point.face);
  return SurfacePoint::in_face(parents[f], mixed(corners[f], point.weights));
}

Result<PointedMesh> pointed_mesh(const std::shared_ptr<const TriangleMesh>& mesh,
                                 std::span<const SurfacePoint> points) {
  std::vector<Index> vertices;
  if (std::ranges::all_of(points, &SurfacePoint::is_vertex)) {
    for (const auto& point : points) vertices.push_back(mesh->standing_for(point.vertex));
    return PointedMesh{mesh, std::move(vertices), {}, {}, {}, mesh->vertex_count()};
  }
  Cutter cutter(*mesh);
  for (const auto& point : points) vertices.push_back(cutter.add(point));
  return std::move(cutter).finish(std::move(vertices));
}

}  // namespace geotherm
