// SPDX-License-Identifier: MIT
#include "app/session/explored.h"

#include <algorithm>
#include <cmath>

#include "app/picture/picture_data.h"
#include "app/picture/picture_scale.h"
#include "app/session/wording.h"
#include "app/text/text.h"
#include "solver/accuracy/distance_bounds.h"
#include "solver/heat/heat_step.h"

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

/// Whether a face has a point inside, on its border or as a corner.
bool has_point(const TriangleMesh& mesh, const Face& face, const SurfacePoint& point) {
  const auto is_corner = [&face](Index v) { return std::ranges::find(face, v) != face.end(); };
  if (point.is_vertex()) return is_corner(point.vertex);
  for (int k = 0; k < 3; ++k) {
    if (point.weights[k] > 0 && !is_corner(corners_of(mesh, point)[k])) return false;
  }
  return true;
}

/// The straight line within the face of a point to the nearest source in that face; infinite where
/// it has none.
double straight_within_face(const TriangleMesh& mesh, const SourceSet& sources,
                            const SurfacePoint& point) {
  const Face& face = corners_of(mesh, point);
  std::vector<LineSource> lines;
  const auto add = [&](const SurfacePoint& from, const SurfacePoint& to, double offset) {
    if (!has_point(mesh, face, from) || !has_point(mesh, face, to)) return;
    lines.push_back({position_at(mesh, from), position_at(mesh, to), offset});
  };
  for (std::size_t i = 0; i < sources.points.size(); ++i) {
    const SurfacePoint& source = sources.points[i];
    add(source, source, sources.offsets.empty() ? 0 : sources.offsets[i]);
  }
  for (const auto& [low, high] : sources.edges) {
    add(SurfacePoint::at_vertex(low), SurfacePoint::at_vertex(high), 0);
  }
  for (const FaceSegment& segment : sources.segments) {
    add(SurfacePoint::in_face(segment.face, segment.from),
        SurfacePoint::in_face(segment.face, segment.to), 0);
  }
  const Vec3& corner = mesh.positions()[face[0]];
  const double unit = std::max((mesh.positions()[face[1]] - corner).cwiseAbs().maxCoeff(),
                               (mesh.positions()[face[2]] - corner).cwiseAbs().maxCoeff());
  if (lines.empty() || !(unit > 0)) return kUnreached;
  const StraightLine straight(lines, unit);
  return straight.length(straight.place(position_at(mesh, point))) * unit;
}

/// The distance at a point: between the corners it is interpolated, which in a face with sources
/// would be too long near them.
double shown_distance(const Answer& answer, const SurfacePoint& point) {
  const TriangleMesh& mesh = *answer.model.mesh;
  const double distance = value_at(mesh, answer.result.distances, point);
  const bool at_corner = point.is_vertex() || std::ranges::max(point.weights) == 1;
  if (at_corner || !answer.model.is_mesh()) return distance;
  const double straight = straight_within_face(mesh, answer.sources, point);
  return straight <= answer.reach.max_distance ? std::min(distance, straight) : distance;
}

}  // namespace

double time_on_mesh(const TimeStep& step, const MeshReport& mesh) {
  const Index cells = mesh.faces - mesh.repeated_corner_faces - mesh.duplicate_faces;
  const ComponentSize size{mesh.mean_edge_length, mesh.area, std::max<Index>(1, cells)};
  return geotherm::diffusion_time(size, 1, step);
}

std::optional<double> time_in_space(const TimeStep& step, const HeatMethod* heat) {
  if (step.rule == TimeRule::kAbsolute) return step.absolute;
  if (heat == nullptr || heat->t_range()[0] < heat->t_range()[1]) return std::nullopt;
  const TimeStep& known = heat->options().time_step;
  if (step.rule == known.rule) return heat->t() / known.factor * step.factor;
  if (step.rule != TimeRule::kMeanEdge) return std::nullopt;
  ComponentSize size{.mean_edge = std::sqrt(heat->t() / heat->relative_t())};
  size.grading = heat->grading();
  return geotherm::diffusion_time(size, 1, step);
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
    figures.distance = shown_distance(*answer, point);
    if (!answer->result.heat.empty()) figures.heat = value_at(mesh, answer->result.heat, point);
  }
  if (explored.difference) {
    const double difference =
        shown_distance(*explored.a, point) - shown_distance(*explored.b, point);
    figures.difference = std::isfinite(difference) ? difference : kUnreached;
  }
  return figures;
}

std::optional<double> value_shown(const PointFigures& figures, Shown shown) {
  return shown == Shown::kDifference ? figures.difference : figures.distance;
}

namespace {

std::string caption_of(const Explored& explored, Shown shown) {
  const Model& model = explored.model->model;
  const std::string size = size_in_words(model);
  if (!explored.b) {
    return picture_caption(model.name, size, explored.a ? explored.a->method.get() : nullptr);
  }
  if (shown != Shown::kDifference) {
    return picture_caption(model.name, size, shown_answer(explored, shown)->method.get()) +
           (shown == Shown::kB ? " (B)" : " (A)");
  }
  return picture_caption(model.name, size, nullptr) +
         ", A: " + method_caption(*explored.a->method) +
         ", B: " + method_caption(*explored.b->method);
}

void set_answer(PictureData& data, const Explored& explored, Shown shown, View view,
                const Answer& answer) {
  const Model& model = explored.model->model;
  const TriangleMesh& mesh = *model.mesh;
  add_sources(data, mesh, explored.set, places_in_cells(model, explored.set));
  add_paths(data, mesh, explored.paths);
  if (explored.centre) {
    for (const SurfacePath& way : explored.centre->ways) {
      add_line(data, positions_of(mesh, way), to_text(explored.centre->kind));
    }
  }
  if (view == View::kExactError) {  // nothing, where nothing is known of the error
    if (answer.error && !answer.error->values.empty()) {
      add_error(data, answer.error->values, error_title(*answer.error));
    }
  } else if (shown == Shown::kDifference && explored.difference && !face_field(view)) {
    add_difference(data, explored.difference->values, measures_time(model));
  } else {
    add_distances(data, answer.result.distances, {}, measures_time(model));
  }
  if (shows_arrows(view) && !answer.result.log_heat.empty()) {
    add_fields(data, mesh, answer.result);
  }
}

}  // namespace

void set_view_values(PictureData& data, const Model& model, View view,
                     const DistanceResult* answer) {
  const auto field = face_field(view);
  const bool lacks = answer == nullptr || (field && needs_heat(*field) && answer->log_heat.empty());
  // Those of tets are shown inside as well.
  if (!model.space || data.volume || !field || !needs_distances(view) || lacks) {
    return set_face_values(data, *model.mesh, view, answer);
  }
  const std::vector<Index> cells = model.space->cells_of_faces();
  set_face_values(data, view, cell_field(*model.space, *field, *answer, cells), cells,
                  model.space->words().cell);
}

void set_explored(PictureData& data, const Explored& explored, Shown shown, View view) {
  data.sources.clear();
  data.values.clear();
  data.heat_directions.clear();
  data.distance_gradients.clear();
  data.tet_heat.clear();
  data.tet_gradients.clear();
  data.value_unit = 1;
  data.value_base = 0;
  data.largest_value = 0;
  data.is_signed = false;
  data.nearest.clear();
  if (explored.a) data.nearest = explored.a->result.nearest_source;
  data.lines.clear();
  if (shown != Shown::kA && !explored.b) shown = Shown::kA;
  data.caption = caption_of(explored, shown);
  const bool field =
      explored.field && show_field(data, *explored.model->model.mesh, *explored.field);
  const Answer* answer = field ? nullptr : shown_answer(explored, shown);
  if (answer != nullptr) set_answer(data, explored, shown, view, *answer);
  set_view_values(data, explored.model->model, view, answer != nullptr ? &answer->result : nullptr);
}

PictureData picture_of(const Explored& explored, Shown shown, View view) {
  PictureData data = *explored.model->base;
  set_explored(data, explored, shown, view);
  return data;
}

}  // namespace geotherm::app
