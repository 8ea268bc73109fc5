// SPDX-License-Identifier: MIT
#include "app/session/answer.h"

#include <algorithm>
#include <cmath>

#include "app/session/wording.h"
#include "app/text/text.h"

namespace geotherm::app {

void DistanceSummary::add(std::span<const double> row) {
  constexpr double kSmaller = 0x1p-40;  // where the sum leaves the range of doubles
  DistanceSummary of_row;
  double sum = 0, smaller_sum = 0;
  for (const double d : row) {
    if (!std::isfinite(d)) {
      ++of_row.unreached;
      continue;
    }
    of_row.min = std::min(of_row.min, d);
    of_row.max = std::max(of_row.max, d);
    sum += d;
    smaller_sum += d * kSmaller;
  }
  of_row.reached = static_cast<double>(row.size()) - static_cast<double>(of_row.unreached);
  if (of_row.reached > 0) {
    of_row.mean =
        std::isfinite(sum) ? sum / of_row.reached : smaller_sum / of_row.reached / kSmaller;
  }
  add(of_row);
}

void DistanceSummary::add(const DistanceSummary& more) {
  min = std::min(min, more.min);
  max = std::max(max, more.max);
  const double both = reached + more.reached;
  if (both > 0) mean += (more.mean - mean) * (more.reached / both);
  reached = both;
  unreached += more.unreached;
}

DistanceSummary summarize(std::span<const double> distances) {
  DistanceSummary summary;
  summary.add(distances);
  return summary;
}

Result<void> check_answer_path(const Model& model, const std::string& path) {
  if (check_distance_path(path)) return {};
  if (model.space) return model.space->check_path(path);
  const bool of_tets = static_cast<bool>(check_tet_distances_path(path));
  if (!of_tets && !check_grid_distances_path(path)) return check_distance_path(path);
  return Error{ErrorCode::kBadInput,
               one_line(path) + " holds " + (of_tets ? "tets" : "a grid") + ", and " +
                   one_line(model.name) + " is a surface",
               {"write .vtp"}};
}

Result<void> write_answer(const std::string& path, const Model& model,
                          std::span<const double> distances, std::span<const Index> nearest,
                          std::span<const DataField> fields) {
  if (model.space && model.space->check_path(path)) {
    return model.space->write(path, distances, nearest, fields);
  }
  return write_distances(path, *model.mesh, distances, nearest, fields);
}

CheckedAnswers checked_answers(const Answer& answer) {
  return {*answer.method, answer.options, {&answer.sources, 1}, {&answer.result.distances, 1}};
}

void describe_space(const Model& model, MeshSummary& mesh) {
  if (!model.space) return;
  mesh.unreferenced_vertices = model.space->unused_vertices();
  mesh.components = model.space->components();
  if (model.space->has_places()) return;
  // Its triangles have areas; vertices at one place have not.
  mesh.degenerate_faces = 0;
  mesh.mean_edge_length = kUnreached;
  for (const SpaceFigure& figure : model.space->figures()) {
    if (figure.key == "area") mesh.area = std::get<double>(figure.value);
  }
}

void describe_space(const Model& model, MeshReport& mesh) {
  if (!model.space) return;
  describe_space(model, static_cast<MeshSummary&>(mesh));
  mesh.box_min = Vec3::Constant(kUnreached);
  mesh.box_max = -mesh.box_min;
  const auto positions = model.mesh->positions();
  for (std::size_t v = 0; v < positions.size(); ++v) {
    if (model.space->used()[v] == 0) continue;
    mesh.box_min = mesh.box_min.cwiseMin(positions[v]);
    mesh.box_max = mesh.box_max.cwiseMax(positions[v]);
  }
}

namespace {

/// Whether the setting `weld` joins some of a mesh's components, as words; else empty.
/// `components`: how many there are. Cost: a weld and a pass over the faces.
Hint weld_hint(const TriangleMesh& mesh, Index components) {
  if (components < 2 || !mesh.same_as().empty()) return {};
  const auto welded = weld(mesh, 0);
  if (!welded || welded->merged == 0) return {};
  const Index left = summarize_mesh(welded->mesh).components;
  if (left >= components) return {};
  return {SettingHint{"weld", {"0"}}, " joins vertices that lie on each other, which leaves " +
                                          counted(left, "component", "components")};
}

}  // namespace

std::vector<Warning> unreached_notes(const MeshSummary& mesh, Index unreached,
                                     const TriangleMesh* whole) {
  std::vector<Warning> notes;
  const Index loose = mesh.unreferenced_vertices;
  if (loose > 0) {
    notes.push_back({counted(loose, "vertex belongs", "vertices belong") +
                     " to no face; the distance there is infinite"});
  }
  const Index lost = unreached - loose;
  if (lost > 0) {
    notes.push_back({counted(lost, "vertex lies", "vertices lie") +
                         " in components without a source (there are " +
                         counted(mesh.components, "component", "components") +
                         "); the distance there is infinite",
                     whole != nullptr ? weld_hint(*whole, mesh.components) : Hint()});
  }
  return notes;
}

void note_unreached(const TriangleMesh& mesh, std::span<const double> distances,
                    const std::string& from, std::vector<Warning>& warnings) {
  std::vector<char> lost(distances.size(), 0);
  for (const Face& face : mesh.faces()) {
    if (repeats_corner(face)) continue;
    for (const Index v : face) lost[v] = std::isfinite(distances[v]) ? 0 : 1;
  }
  const auto count = std::ranges::count(lost, 1);
  if (count == 0) return;
  warnings.push_back({counted(count, "vertex lies", "vertices lie") + " in components without " +
                      from + "; the distance there is infinite"});
}

Error about_model(const std::string& name, const Error& error) {
  const bool of_mesh = error.code == ErrorCode::kBadInput && !is_about_setting(error);
  const ErrorCode code = of_mesh ? ErrorCode::kBadFile : error.code;
  if (!name.empty()) return about(one_line(name), error, code);
  return {code, error.message, error.hint, error.subject};
}

std::vector<Region> regions_of(const SourceSet& sources, std::span<const Index> nearest) {
  const SourceGroups groups = source_groups(sources);
  std::vector<Region> regions(static_cast<std::size_t>(groups.count));
  for (Index label = 0; label < groups.count; ++label) regions[label].label = label;
  for (std::size_t i = 0; i < sources.points.size(); ++i) {
    Region& region = regions[groups.of_point[i]];
    if (!region.point) region.point = sources.points[i];
  }
  // Points of cells have the last groups.
  for (std::size_t i = 0, count = sources.cell_points.size(); i < count; ++i) {
    regions[regions.size() - count + i].in_cell = sources.cell_points[i];
  }
  for (const Index group : groups.of_edge) ++regions[group].edges;
  for (const Index group : groups.of_segment) ++regions[group].segments;
  for (const Index group : nearest) {
    if (group != kNoIndex) ++regions[group].vertices;
  }
  return regions;
}

}  // namespace geotherm::app
