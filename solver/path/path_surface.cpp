// SPDX-License-Identifier: MIT
#include "solver/path/path_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "solver/core/text.h"

namespace geotherm {
namespace {

/// Weights may be below 0, and their sum off 1, by what nine typed digits give.
constexpr double kWeightSumTolerance = 1e-6;

struct Frame {
  Vec3 middle = Vec3::Zero();
  double unit = 1;
};

/// About the vertices that faces use; the unit is a power of two, so that scaling rounds nothing.
Frame frame_of(std::span<const Vec3> positions, std::span<const Face> faces) {
  constexpr double kMax = std::numeric_limits<double>::max();
  Vec3 low = Vec3::Constant(kMax), high = Vec3::Constant(-kMax);
  for (const Face& face : faces) {
    for (const Index v : face) {
      low = low.cwiseMin(positions[v]);
      high = high.cwiseMax(positions[v]);
    }
  }
  if (faces.empty()) return {};
  int exponent = 0;
  std::frexp((high / 2 - low / 2).maxCoeff(), &exponent);
  return {low / 2 + high / 2, std::ldexp(1.0, std::clamp(exponent, -1021, 1022))};
}

std::vector<Vec3> framed(std::span<const Vec3> positions, const Frame& frame) {
  std::vector<Vec3> out;
  out.reserve(positions.size());
  for (const Vec3& p : positions) out.emplace_back((p - frame.middle) / frame.unit);
  return out;
}

}  // namespace

PathSurface::PathSurface(std::shared_ptr<const TriangleMesh> mesh)
    : mesh_(std::move(mesh)),
      clean_(clean_faces(*mesh_)),
      clean_face_(static_cast<std::size_t>(mesh_->face_count()), kNoIndex),
      edge_at_(3 * clean_.faces.size()),
      edge_graph_({}, {}) {
  for (std::size_t f = 0; f < clean_.faces.size(); ++f) {
    clean_face_[clean_.original[f]] = static_cast<Index>(f);
  }
  for (Index e = 0; e < clean_.edges.edge_count(); ++e) {
    for (const Side side : clean_.edges.sides(e)) edge_at_[side] = e;
  }
  const Frame frame = frame_of(mesh_->positions(), clean_.faces);
  unit_ = frame.unit;
  positions_ = framed(mesh_->positions(), frame);
  edge_graph_ = EdgeGraph(positions_, clean_.edges);
}

Vec3 PathSurface::position(const SurfacePoint& point) const {
  if (point.is_vertex()) return position(point.vertex);
  const Face& f = face(point.face);
  return point.weights[0] * position(f[0]) + point.weights[1] * position(f[1]) +
         point.weights[2] * position(f[2]);
}

int PathSurface::corner_of_vertex(Index f, Index vertex) const {
  const Face& corners = face(f);
  for (int k = 0; k < 3; ++k) {
    if (corners[k] == vertex) return k;
  }
  return -1;
}

double PathSurface::corner_angle(Index f, int corner) const {
  const Vec3& tip = position(face(f)[corner]);
  const Vec3 a = position(face(f)[next_corner(corner)]) - tip;
  const Vec3 b = position(face(f)[previous_corner(corner)]) - tip;
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

Index PathSurface::shared_edge(Index f, Index g) const {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (edge_at(3 * f + i) == edge_at(3 * g + j)) return edge_at(3 * f + i);
    }
  }
  return kNoIndex;
}

/// Finds the point by its vertices, since the clean face may list them in another order, and the
/// face of the file may have been left out.
Result<SurfacePoint> PathSurface::at_weighted_vertices(const Face& vertices,
                                                       const std::array<double, 3>& weights) const {
  std::vector<std::pair<Index, double>> held;  // each vertex once, weights above 0
  for (std::size_t k = 0; k < 3; ++k) {
    if (weights[k] == 0) continue;
    const auto same = std::ranges::find(held, vertices[k], &std::pair<Index, double>::first);
    if (same == held.end()) {
      held.emplace_back(vertices[k], weights[k]);
    } else {
      same->second += weights[k];
    }
  }
  double sum = 0;
  for (const auto& [vertex, weight] : held) sum += weight;
  const auto corners = corners_at(held.front().first);
  if (held.size() == 1 && !corners.empty()) return SurfacePoint::at_vertex(held.front().first);
  for (const Index corner : corners) {
    SurfacePoint out = SurfacePoint::in_face(corner / 3, {});
    bool holds = true;
    for (const auto& [vertex, weight] : held) {
      const int k = corner_of_vertex(corner / 3, vertex);
      holds = holds && k >= 0;
      if (k >= 0) out.weights[k] = weight / sum;
    }
    if (holds) return out;
  }
  return Error{ErrorCode::kBadInput,
               "the point at vertex " + std::to_string(held.front().first) +
                   " is in no face with three corners",
               {"choose another"}};
}

Result<SurfacePoint> PathSurface::into(const SurfacePoint& point) const {
  const auto out_of_range = [](const char* what, Index id, Index count) {
    return Error{ErrorCode::kBadInput,
                 std::string("there is no ") + what + " " + std::to_string(id),
                 {"the mesh has 0 to " + std::to_string(count - 1)}};
  };
  if (point.is_vertex()) {
    if (point.vertex < 0 || point.vertex >= mesh_->vertex_count()) {
      return out_of_range("vertex", point.vertex, mesh_->vertex_count());
    }
    return at_weighted_vertices({point.vertex, point.vertex, point.vertex}, {1, 0, 0});
  }
  if (point.face < 0 || point.face >= mesh_->face_count()) {
    return out_of_range("face", point.face, mesh_->face_count());
  }
  const auto& [a, b, c] = point.weights;
  if (!(std::min({a, b, c}) >= -kWeightSumTolerance &&
        std::abs(a + b + c - 1) <= kWeightSumTolerance)) {
    return Error{ErrorCode::kBadInput,
                 "the weights " + number_text(a) + ", " + number_text(b) + ", " + number_text(c) +
                     " are no point of a face",
                 {"they must be at least 0 and sum to 1"}};
  }
  std::array<double, 3> weights = {std::max(a, 0.0), std::max(b, 0.0), std::max(c, 0.0)};
  const double sum = weights[0] + weights[1] + weights[2];
  for (double& weight : weights) weight /= sum;
  const Index clean = clean_face_[point.face];
  const Face& vertices = mesh_->faces()[point.face];
  if (clean == kNoIndex || std::ranges::max(weights) == 1 || face(clean) != vertices) {
    auto found = at_weighted_vertices(vertices, weights);
    if (!found || found->is_vertex() || clean == kNoIndex) return found;
    return *express(*found, clean);  // a point on an edge stays in its own face
  }
  return SurfacePoint::in_face(clean, weights);
}

SurfacePoint PathSurface::out_of(const SurfacePoint& point) const {
  if (point.is_vertex()) return point;
  SurfacePoint out = SurfacePoint::in_face(file_face(point.face), {});
  const Face& listed = mesh_->faces()[out.face];
  for (std::size_t k = 0; k < 3; ++k) {
    const int corner = corner_of_vertex(point.face, listed[k]);
    out.weights[k] = point.weights[static_cast<std::size_t>(corner)];
  }
  return out;
}

std::optional<SurfacePoint> PathSurface::express(const SurfacePoint& point, Index into) const {
  if (point.is_vertex()) {
    if (corner_of_vertex(into, point.vertex) < 0) return std::nullopt;
    return point;
  }
  if (point.face == into) return point;
  SurfacePoint out = SurfacePoint::in_face(into, {});
  for (std::size_t k = 0; k < 3; ++k) {
    if (point.weights[k] == 0) continue;
    const int corner = corner_of_vertex(into, face(point.face)[k]);
    if (corner < 0) return std::nullopt;
    out.weights[static_cast<std::size_t>(corner)] = point.weights[k];
  }
  return out;
}

std::vector<Index> PathSurface::faces_at(const SurfacePoint& point) const {
  std::vector<Index> out;
  if (point.is_vertex()) {
    for (const Index corner : corners_at(point.vertex)) out.push_back(corner / 3);
    return out;
  }
  for (int k = 0; k < 3; ++k) {
    if (point.weights[static_cast<std::size_t>(previous_corner(k))] != 0) continue;
    for (const Side side : edges().sides(edge_at(3 * point.face + k))) {
      out.push_back(face_of(side));
    }
    return out;
  }
  return {point.face};
}

}  // namespace geotherm
