// SPDX-License-Identifier: MIT
#include "app/report_json.h"

#include "app/resolve_sources.h"
#include "solver/core/parallel.h"
#include "solver/heat/option_text.h"

namespace geotherm::app {
namespace {

Json vector_json(const Vec3& v) { return Json::array({v[0], v[1], v[2]}); }

std::string compact(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// True for what gets a line for each of its members: filled objects, and lists that hold some.
bool opens(const Json& json) {
  if (json.empty()) return false;
  return json.is_object() || (json.is_array() && json.front().is_structured());
}

void write(const Json& json, int level, std::string& out) {
  constexpr int kDeepest = 2;
  if (level >= kDeepest || !opens(json)) {
    out += compact(json);
    return;
  }
  const bool object = json.is_object();
  const std::string indent(static_cast<std::size_t>(2 * level), ' ');
  out += object ? "{" : "[";
  bool first = true;
  for (const auto& item : json.items()) {
    out += (first ? "\n  " : ",\n  ") + indent;
    if (object) out += compact(item.key()) + ": ";
    write(item.value(), level + 1, out);
    first = false;
  }
  out += "\n" + indent + (object ? "}" : "]");
}

Json options_json(const HeatMethod& method) {
  const HeatOptions& options = method.options();
  const bool absolute = options.time_step.rule == TimeRule::kAbsolute;  // and has no factor
  return {{"method", "heat"},
          {"backend", options.backend},
          {"time_step", to_text(options.time_step)},
          {"time_factor", absolute ? Json(nullptr) : Json(options.time_step.factor)},
          {"t", method.t()},
          {"constraint", to_text(options.constraint)},
          {"heat", to_text(options.heat)},
          {"boundary", to_text(options.boundary)},
          {"laplacian", to_text(method.laplacian())},
          {"threads", thread_count(options.threads)},
          {"variant", to_text(options.variant)},
          {"flips", method.flips()}};
}

Json quality_json(const Quality& q) {
  return {{"heat_residual", q.heat_residual},
          {"poisson_residual", q.poisson_residual},
          {"max_source_distance", q.max_source_distance},
          {"eikonal_error_mean", q.eikonal_error_mean},
          {"zero_gradient_faces", q.zero_gradient_faces},
          {"iterations_heat", q.iterations_heat},
          {"iterations_poisson", q.iterations_poisson},
          {"clamped_vertices", q.clamped_vertices}};
}

}  // namespace

Json model_json(const std::string& name, const MeshReport& mesh) {
  return {{"name", name},
          {"vertices", mesh.vertices},
          {"faces", mesh.faces},
          {"components", mesh.components},
          {"boundary_edges", mesh.boundary_edges},
          {"nonmanifold_edges", mesh.nonmanifold_edges},
          {"degenerate_faces", mesh.degenerate_faces},
          {"mean_edge_length", mesh.mean_edge_length},
          {"area", mesh.area}};
}

Json full_model_json(const std::string& name, const MeshReport& mesh) {
  Json json = model_json(name, mesh);
  json.update({{"edges", mesh.edges},
               {"edge_components", mesh.edge_components},
               {"boundary_loops", mesh.boundary_loops},
               {"nonmanifold_vertices", mesh.nonmanifold_vertices},
               {"repeated_corner_faces", mesh.repeated_corner_faces},
               {"duplicate_faces", mesh.duplicate_faces},
               {"unreferenced_vertices", mesh.unreferenced_vertices},
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
               {"box_max", vector_json(mesh.box_max)}});
  return json;
}

Json sources_json(const SourceSet& sources) {
  Json json = vertices_of(sources);
  for (const SurfacePoint& point : sources.points) {
    if (point.is_vertex()) continue;
    json.push_back(Json{{"face", point.face}, {"weights", point.weights}});
  }
  return json;
}

Json solve_json(const SolveFigures& f) {
  const SetupTiming& setup = f.method.timing();
  const QueryTiming& query = f.result.timing;
  Json json = {{"model", model_json(f.model.name, f.mesh)},
               {"options", options_json(f.method)},
               {"sources", sources_json(f.sources)}};
  if (!f.sources.edges.empty()) json["source_edges"] = f.sources.edges;
  json.update({{"distance",
                {{"min", f.distance.min},
                 {"max", f.distance.max},
                 {"mean", f.distance.mean},
                 {"unreached", f.distance.unreached}}},
               {"timing_ms",
                {{"load", f.model.load_ms},
                 {"operators", setup.operators},
                 {"analyze", setup.analyze},
                 {"factorize", setup.factorize},
                 {"setup", setup.setup},
                 {"diffuse", query.diffuse},
                 {"gradient", query.gradient},
                 {"poisson", query.poisson},
                 {"query", query.query}}},
               {"memory_mb", {{"factor", f.method.memory_mb()}, {"peak_rss", f.peak_rss_mb}}},
               {"quality", quality_json(f.result.quality)},
               {"warnings", f.warnings}});
  return json;
}

std::string to_text(const Json& json) {
  std::string out;
  write(json, 0, out);
  return out + '\n';
}

}  // namespace geotherm::app
