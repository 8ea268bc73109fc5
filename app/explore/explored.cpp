// SPDX-License-Identifier: MIT
#include "app/explore/explored.h"

#include <algorithm>
#include <cmath>

namespace geotherm::app {
namespace {

const Face& corners_of(const TriangleMesh& mesh, const SurfacePoint& point) {
  return mesh.faces()[static_cast<std::size_t>(point.face)];
}

/// The value of a linear function at a point; a corner of weight 0 does not count, so that one that
/// is not reached does no harm.
double value_at(const TriangleMesh& mesh, std::span<const double> values,
                const SurfacePoint& point) {
  if (point.is_vertex()) return values[point.vertex];
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    if (point.weights[k] > 0) sum += point.weights[k] * values[corners_of(mesh, point)[k]];
  }
  return sum;
}

}  // namespace

double diffusion_time(const TimeStep& step, const MeshReport& mesh) {
  switch (step.rule) {
    case TimeRule::kMeanEdge:
      return step.factor * mesh.mean_edge_length * mesh.mean_edge_length;
    case TimeRule::kMeanFaceArea:
      return step.factor * mesh.area /
             std::max<double>(1, mesh.faces - mesh.repeated_corner_faces - mesh.duplicate_faces);
    case TimeRule::kAbsolute:
      break;
  }
  return step.absolute;
}

const Answer* shown_answer(const Explored& explored, Shown shown) {
  return shown == Shown::kB ? explored.b.get() : explored.a.get();
}

PointFigures figures_at(const Explored& explored, Shown shown, const SurfacePoint& point) {
  const TriangleMesh& mesh = *explored.model->model.mesh;
  PointFigures figures;
  figures.point = point;
  figures.position = position_at(mesh, point);
  figures.nearest_vertex = point.vertex;
  if (!point.is_vertex()) {
    const auto largest = std::ranges::max_element(point.weights) - point.weights.begin();
    figures.nearest_vertex = corners_of(mesh, point)[static_cast<std::size_t>(largest)];
  }
  const Answer* answer = shown_answer(explored, shown);
  if (answer != nullptr) {
    figures.distance = value_at(mesh, answer->result.distances, point);
    if (!answer->result.heat.empty()) figures.heat = value_at(mesh, answer->result.heat, point);
  }
  if (explored.difference) figures.difference = value_at(mesh, explored.difference->values, point);
  return figures;
}

}  // namespace geotherm::app
