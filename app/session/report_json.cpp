// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>

#include "app/session/answer.h"
#include "app/session/machine.h"
#include "app/session/report.h"
#include "app/session/sources.h"
#include "app/session/wording.h"
#include "app/text/text.h"
#include "geotherm/heat_method.h"
#include "geotherm/options.h"
#include "solver/core/parallel.h"

namespace geotherm::app {
namespace {

/// Backends that failed, at the set-up and at the query.
Json fallbacks_json(const HeatMethod& method, const DistanceResult& result) {
  Json json = Json::array();
  for (const auto* failed : {&method.fallbacks(), &result.fallbacks}) {
    for (const Fallback& each : *failed) {
      json.push_back({{"backend", each.backend}, {"reason", each.error.message}});
    }
  }
  return json;
}

/// Offsets in the order of `sources`: vertices ascending, then points in faces.
Json offsets_json(const SourceSet& sources) {
  std::map<Index, double> of_vertex;
  for (const Index v : vertices_of(sources)) of_vertex[v] = 0;
  Json in_faces = Json::array();
  for (std::size_t i = 0; i < sources.points.size(); ++i) {
    const SurfacePoint& point = sources.points[i];
    if (point.is_vertex()) {
      of_vertex[point.vertex] = sources.offsets[i];
    } else {
      in_faces.push_back(sources.offsets[i]);
    }
  }
  Json json = Json::array();
  for (const auto& [vertex, offset] : of_vertex) json.push_back(offset);
  for (Json& offset : in_faces) json.push_back(std::move(offset));
  return json;
}

/// What the operators took, step by step.
Json stages_json(const SetupTiming::Operators& stages) {
  return {{"clean", stages.clean},
          {"intrinsic", stages.intrinsic},
          {"flips", stages.flips},
          {"pattern", stages.pattern},
          {"renumber", stages.renumber}};
}

Json tried_json(const TriedSetting& tried) {
  return {{"option", tried.option},
          {"value", tried.value},
          {"mean_relative", tried.mean_relative},
          {"max_of_range", tried.max_of_range},
          {"against", to_text(tried.against)}};
}

}  // namespace

Json quality_json(const Quality& q, bool heat) {
  const auto where = [](bool known, auto value) { return known ? Json(value) : Json(nullptr); };
  const auto of_heat = [&](auto value) { return where(heat, value); };
  return {{"heat_residual", of_heat(q.heat_residual)},
          {"poisson_residual", of_heat(q.poisson_residual)},
          {"max_source_distance", q.max_source_distance},
          {"eikonal_error_mean", q.eikonal_error_mean},
          {"zero_gradient_faces", of_heat(q.zero_gradient_faces)},
          {"iterations_heat", of_heat(q.iterations_heat)},
          {"iterations_poisson", of_heat(q.iterations_poisson)},
          {"clamped_vertices", of_heat(q.clamped_vertices)},
          {"clamped_reach", of_heat(q.clamped_reach)},
          {"below_straight_line", where(q.lines_checked, q.below_straight_line)},
          {"most_below_straight_line", where(q.lines_checked, q.most_below_straight_line)},
          {"steep_edges", where(q.edges_checked, q.steep_edges)},
          {"steepest_edge", where(q.edges_checked, q.steepest_edge)}};
}

Json setting_json(const Setting& setting, const ViewerState& state) {
  const std::string text = setting.get(state);
  if (setting.kind == SettingKind::kSwitch) return text == "on";
  if (setting.kind == SettingKind::kWord) return text;
  if (const auto whole = number_in<std::int64_t>(text)) return *whole;
  return *number_in<double>(text);
}

std::string key_of(const Setting& setting) {
  std::string key(setting.name);
  std::ranges::replace(key, '-', '_');
  return key;
}

namespace {

/// Null where the model is no file.
Json path_json(const Model& model) {
  if (model.path.empty() || model.path == kStandardInput) return nullptr;
  return std::filesystem::absolute(model.path).string();
}

}  // namespace

Json model_json(const Model& model, const MeshSummary& mesh) {
  return {{"name", model.name},
          {"path", path_json(model)},
          {"vertices", mesh.vertices},
          {"faces", mesh.faces},
          {"components", mesh.components},
          {"boundary_edges", mesh.boundary_edges},
          {"nonmanifold_edges", mesh.nonmanifold_edges},
          {"degenerate_faces", mesh.degenerate_faces},
          {"mean_edge_length", mesh.mean_edge_length},
          {"area", mesh.area}};
}

Json brief_model_json(const Model& model) {
  return {{"name", model.name},
          {"vertices", model.mesh->vertex_count()},
          {"faces", model.mesh->face_count()}};
}

void add_domain(const Model& model, Json& json) {
  if (model.is_mesh()) return;
  json["domain"] = domain_name(model);
  if (!model.space) return;
  json[model.space->words().cells] = model.space->cell_count();
  if (const auto size = model.space->size(); size[0] > 0) json["size"] = size;
}

namespace {

/// The figures of a space; those of the faces that are drawn of it stand under "drawn".
Json space_json(const Model& model, const MeshReport& mesh) {
  Json json = {{"name", model.name}, {"path", path_json(model)}, {"vertices", mesh.vertices}};
  add_domain(model, json);
  for (const SpaceFigure& figure : model.space->figures()) {
    json[figure.key] = std::visit([](const auto& value) { return Json(value); }, figure.value);
  }
  json.update({{"components", mesh.components},
               {"unreferenced_vertices", mesh.unreferenced_vertices},
               {"duplicate_positions", mesh.duplicate_positions},
               {"box_min", vector_json(mesh.box_min)},
               {"box_max", vector_json(mesh.box_max)},
               {"drawn",
                {{"faces", mesh.faces},
                 {"edges", mesh.edges},
                 {"boundary_edges", mesh.boundary_edges},
                 {"boundary_loops", mesh.boundary_loops},
                 {"area", mesh.area}}}});
  if (!model.space->has_places()) {
    for (const char* const key : {"duplicate_positions", "box_min", "box_max"}) json.erase(key);
  }
  return json;
}

}  // namespace

Json full_model_json(const Model& model, const MeshReport& mesh) {
  if (model.space) return space_json(model, mesh);
  Json json = model_json(model, mesh);
  add_domain(model, json);
  json.update({{"edges", mesh.edges},
               {"edge_components", mesh.edge_components},
               {"boundary_loops", mesh.boundary_loops},
               {"nonmanifold_vertices", mesh.nonmanifold_vertices},
               {"repeated_corner_faces", mesh.repeated_corner_faces},
               {"duplicate_faces", mesh.duplicate_faces},
               {"unreferenced_vertices", mesh.unreferenced_vertices},
               {"merged_vertices", mesh.merged_vertices},
               {"duplicate_positions", mesh.duplicate_positions},
               {"inconsistent_faces", mesh.inconsistent_faces},
               {"orientable", mesh.orientable},
               {"non_delaunay_edges", mesh.non_delaunay_edges},
               {"euler_characteristic", mesh.euler_characteristic},
               {"shortest_edge", mesh.shortest_edge},
               {"longest_edge", mesh.longest_edge},
               {"smallest_angle", mesh.smallest_angle},
               {"mean_quality", mesh.mean_quality},
               {"box_min", vector_json(mesh.box_min)},
               {"box_max", vector_json(mesh.box_max)},
               {"dropped_faces", mesh.repeated_corner_faces + mesh.duplicate_faces},
               {"lengthened_edges", mesh.mollified.edges},
               {"lengthened_components", mesh.mollified.components},
               {"lengthened_by", mesh.mollified.most},
               {"tufted_components", mesh.tufted_components},
               {"large_faces", mesh.refinement.large_faces},
               {"obtuse_border_edges", mesh.refinement.obtuse_boundary},
               {"inserted_vertices", mesh.refinement.points}});
  const LaplacianChoice choice = auto_laplacian(mesh);
  json["auto_laplacian"] = {{"kind", to_text(choice.kind)}, {"why", choice.why}};
  return json;
}

Json point_json(const SurfacePoint& point) {
  if (point.is_vertex()) return point.vertex;
  return {{"face", point.face}, {"weights", point.weights}};
}

Json point_json(const CellPoint& point) {
  return {{"cell", point.cell}, {"weights", point.weights}};
}

/// The pieces of curves across faces.
Json segments_json(const SourceSet& sources) {
  Json json = Json::array();
  for (const FaceSegment& segment : sources.segments) {
    json.push_back({{"face", segment.face}, {"from", segment.from}, {"to", segment.to}});
  }
  return json;
}

Json sources_json(const SourceSet& sources) {
  Json json = vertices_of(sources);
  for (const SurfacePoint& point : sources.points) {
    if (!point.is_vertex()) json.push_back(point_json(point));
  }
  for (const CellPoint& point : sources.cell_points) {
    json.push_back(point_json(point));
  }
  return json;
}

Json regions_json(const SourceSet& sources, std::span<const Index> nearest) {
  Json json = Json::array();
  for (const Region& region : regions_of(sources, nearest)) {
    Json one = {{"label", region.label}, {"vertices", region.vertices}};
    if (region.point) one["source"] = point_json(*region.point);
    if (region.in_cell) one["source"] = point_json(*region.in_cell);
    if (region.edges > 0) one["source_edges"] = region.edges;
    if (region.segments > 0) one["source_segments"] = region.segments;
    json.push_back(std::move(one));
  }
  return json;
}

/// What was inserted into the triangulation, why, and by how much t follows.
Json refinement_json(const HeatMethod& heat) {
  const RefinementCounts& refinement = heat.refinement();
  return {
      {"points", refinement.points},           {"border_splits", refinement.boundary_splits},
      {"large_faces", refinement.large_faces}, {"obtuse_border_edges", refinement.obtuse_boundary},
      {"complete", refinement.complete},       {"grading", heat.grading()}};
}

/// The least and the largest time of a component; once where they are one, as with one component.
Json times_json(const HeatMethod& heat) {
  const auto [least, most] = heat.t_range();
  return least < most ? Json{least, most} : Json::array({least});
}

/// The settings as they were used, then what the method made of them.
Json options_json(const DistanceMethod& method, const MethodOptions& asked,
                  const DistanceResult& answer) {
  const HeatMethod* const heat = method.heat();
  ViewerState state;
  state.options = asked;
  if (heat != nullptr) {
    static_cast<HeatOptions&>(state.options) = heat->options();
    state.options.boundary = heat->boundary();
    state.options.laplacian = heat->laplacian();
  }
  Json json;
  for (const Setting& setting : settings()) {
    if (setting.group != SettingGroup::kMethod) continue;
    const bool unused = heat == nullptr && setting.of_heat;
    json[key_of(setting)] = unused ? Json(nullptr) : setting_json(setting, state);
  }
  json["threads"] = thread_count(asked.threads);
  if (heat == nullptr) {
    json["t"] = nullptr;
    json["laplacian"] = to_text(LaplacianKind::kIntrinsicDelaunay);
    return json;
  }
  json["backend"] = answer.backend;
  if (heat->options().time_step.rule == TimeRule::kAbsolute) json["time_factor"] = nullptr;
  json.update({{"backend_asked", asked.backend},
               {"fallbacks", fallbacks_json(*heat, answer)},
               {"t", heat->t()},
               {"t_of_components", times_json(*heat)},
               {"flips", heat->flips()},
               {"refinement", refinement_json(*heat)}});
  return json;
}

Json distance_json(const DistanceSummary& d) {
  return {{"min", d.min}, {"max", d.max}, {"mean", d.mean}, {"unreached", d.unreached}};
}

Json error_json(const AccuracyReport& report) {
  const DistanceError& e = report.figures;
  const auto figure = [&report](auto value) {
    return report.measured ? Json(value) : Json(nullptr);
  };
  Json json = {{"reference", to_text(report.reference)},
               {"mean_relative", figure(e.mean_relative)},
               {"max_of_range", figure(e.max_of_range)},
               {"verdict", to_text(report)},
               {"cure", report.remedy ? tried_json(*report.remedy) : Json(nullptr)},
               {"grade", report.measured ? Json(to_text(report.grade)) : Json(nullptr)},
               {"max", figure(e.max)},
               {"mean_signed", figure(e.mean_signed)},
               {"worst_vertex", e.worst == kNoIndex ? Json(nullptr) : Json(e.worst)},
               {"reference_ms", figure(report.milliseconds)}};
  json["cause"] = nullptr;
  if (report.cause) {
    json["cause"] = {{"option", report.cause->option},
                     {"value", report.cause->value},
                     {"mean_relative_before", report.cause->mean_relative_before},
                     {"mean_relative_after", report.cause->mean_relative_after}};
  }
  json["tried"] = Json::array();
  for (const TriedSetting& tried : report.tried) json["tried"].push_back(tried_json(tried));
  return json;
}

Json error_json(const SampleCheck& check) {
  const AccuracyReport& report = check;
  Json json = error_json(report);
  if (!report.measured) return json;
  json["sources_checked"] = report.sets;
  json["sources"] = check.of;
  json["worst_source"] = report.worst_set;
  return json;
}

namespace {

Json reach_json(const Answer& answer) {
  const double most = answer.reach.max_distance;
  Json json = {{"max_distance", most < kUnreached ? Json(most) : Json(nullptr)},
               {"targets", Json::array()}};
  for (const Index v : answer.reach.targets) {
    const double d = answer.result.distances[static_cast<std::size_t>(v)];
    json["targets"].push_back(
        {{"vertex", v}, {"distance", d < kUnreached ? Json(d) : Json(nullptr)}});
  }
  return json;
}

}  // namespace

Json solve_json(const Answer& f) {
  const SetupTiming& setup = f.method->timing();
  const QueryTiming& query = f.result.timing;
  const bool heat = f.method->heat() != nullptr;
  const auto of_heat = [heat](double ms) { return heat ? Json(ms) : Json(nullptr); };
  Json json = {{"model", model_json(f.model, f.mesh)},
               {"options", options_json(*f.method, f.options, f.result)},
               {"sources", sources_json(f.sources)}};
  add_domain(f.model, json["model"]);
  if (!f.sources.edges.empty()) json["source_edges"] = f.sources.edges;
  if (!f.sources.segments.empty()) json["source_segments"] = segments_json(f.sources);
  if (!f.sources.offsets.empty()) json["source_offsets"] = offsets_json(f.sources);
  json.update({{"distance", distance_json(f.distance)},
               {"timing_ms",
                {{"load", f.model.load_ms},
                 {"operators", setup.operators},
                 {"analyze", of_heat(setup.analyze)},
                 {"factorize", of_heat(setup.factorize)},
                 {"setup", setup.setup},
                 {"diffuse", of_heat(query.diffuse)},
                 {"gradient", of_heat(query.gradient)},
                 {"poisson", of_heat(query.poisson)},
                 {"query", query.query},
                 {"report", f.report_ms},
                 {"process", process_milliseconds()},
                 {"stages", heat ? stages_json(setup.stages) : Json(nullptr)}}},
               {"memory_mb",
                {{"factor", f.method->memory_mb()},
                 {"factor_forecast", heat ? Json(f.method->heat()->forecast_mb()) : Json(nullptr)},
                 {"peak_rss", f.peak_rss_mb}}},
               {"quality", quality_json(f.result.quality, heat)},
               {"warnings", to_text(f.warnings)}});
  if (f.reach.is_bounded()) json["reach"] = reach_json(f);
  if (!f.result.nearest_source.empty()) {
    json["regions"] = regions_json(f.sources, f.result.nearest_source);
  }
  if (f.error) json["error"] = error_json(*f.error);
  if (f.replaced) json["replaced"] = error_json(*f.replaced);
  return json;
}

}  // namespace geotherm::app
