// SPDX-License-Identifier: MIT
#include <cmath>

#include "app/session/report.h"
#include "app/session/sources.h"
#include "app/session/wording.h"
#include "app/text/text.h"
#include "geotherm/heat_method.h"
#include "geotherm/options.h"
#include "solver/core/parallel.h"

namespace geotherm::app {
namespace {

TextTable two_columns() {
  return TextTable({{"", TextTable::Align::kLeft}, {"", TextTable::Align::kLeft}});
}

std::string ms(double value) { return milliseconds(value) + " ms"; }
std::string mb(double value) { return milliseconds(value) + " MB"; }

/// `width`: what t is in squares of; `other`: that is not the mean edge of the faces of the mesh.
std::string time_in_words(const HeatMethod& method, const MeshSummary& mesh, bool other,
                          const std::string& width) {
  const TimeStep& step = method.options().time_step;
  const std::string factor = significant(step.factor);
  const auto [least, most] = method.t_range();
  const bool several = least < most;
  const bool other_edge = several || other;
  const std::string of = several ? " of the largest component; " + significant(least) + " to " +
                                       significant(most) + " in all"
                                 : "";
  const std::string for_sizes =
      method.grading() == 1
          ? ""
          : ", for m = " + factor +
                (method.refinement().points > 0 ? " and faces of many sizes" : "");
  switch (step.rule) {
    case TimeRule::kMeanEdge:
      return significant(method.t()) + " = " + significant(step.factor * method.grading()) +
             " h^2, " + width + " h = " +
             significant(other_edge ? std::sqrt(method.t() / method.relative_t())
                                    : mesh.mean_edge_length) +
             for_sizes + of;
    case TimeRule::kMeanFaceArea:
      return significant(method.t()) + " = " + significant(step.factor * method.grading()) +
             " A/F, mean face area" + for_sizes + of;
    case TimeRule::kAbsolute:
      break;
  }
  return significant(method.t()) + " as given, which is " + significant(method.relative_t()) +
         " h^2";
}

std::string laplacian_in_words(const HeatMethod& method) {
  std::string name = to_text(method.laplacian());
  if (method.laplacian() == LaplacianKind::kCotan && method.flips() == 0) return name;
  if (method.refinement().points > 0) name += ": " + refinement_in_words(method.refinement());
  return name + ", " + counted(method.flips(), "edge", "edges") + " flipped";
}

std::string sources_in_words(const SourceSet& sources) {
  const std::vector<Index> vertices = vertices_of(sources);
  std::string text = counted(static_cast<std::int64_t>(vertices.size()), "vertex", "vertices");
  constexpr std::size_t kShown = 8;
  if (!vertices.empty() && vertices.size() <= kShown) {
    std::vector<std::string> ids;
    ids.reserve(vertices.size());
    for (const Index v : vertices) ids.push_back(std::to_string(v));
    text = (ids.size() == 1 ? "vertex " : "vertices ") + joined(ids);
  }
  std::int64_t inside = 0;
  for (const SurfacePoint& point : sources.points) inside += !point.is_vertex();
  if (vertices.empty()) text.clear();
  if (inside > 0)
    text += (text.empty() ? "" : ", ") + counted(inside, "point in a face", "points in faces");
  if (!sources.cell_points.empty()) {
    text += (text.empty() ? "" : ", ") +
            counted(std::ssize(sources.cell_points), "point in a cell", "points in cells");
  }
  if (!sources.edges.empty()) {
    text += ", " + counted(static_cast<std::int64_t>(sources.edges.size()), "edge", "edges");
  }
  if (!sources.segments.empty()) {
    text += (text.empty() ? "" : ", ") +
            counted(std::ssize(sources.segments), "piece of a curve", "pieces of curves");
  }
  return text;
}

std::string reached_in_words(const DistanceSummary& d, Index vertices) {
  std::string text = distances_in_words(d);
  if (d.unreached > 0)
    text += ", " + grouped(d.unreached) + " of " + counted(vertices, "vertex", "vertices") +
            " unreached";
  return text;
}

std::string residuals_in_words(const Quality& q) {
  std::string text =
      "heat " + significant(q.heat_residual, 2) + ", Poisson " + significant(q.poisson_residual, 2);
  if (q.iterations_heat + q.iterations_poisson > 0) {
    text += ", after " + grouped(q.iterations_heat) + " and " +
            counted(q.iterations_poisson, "iteration", "iterations");
  }
  return text;
}

/// The rows that only the heat method has.
void add_heat_rows(TextTable& table, const Answer& figures, const HeatMethod& method) {
  const MeshSummary& mesh = figures.mesh;
  const HeatOptions& options = method.options();
  table.add_row({"backend", figures.result.backend + ", " +
                                counted(thread_count(options.threads), "thread", "threads")});
  const auto& space = figures.model.space;
  table.add_row({"t", time_in_words(method, mesh, figures.options.refine > 0 || space,
                                    space ? space->words().width : "mean edge")});
  table.add_row({"method", to_text(options.constraint) + ", heat " + to_text(options.heat) +
                               ", boundary " + to_text(method.boundary()) + ", " +
                               to_text(options.variant) + ", " + to_text(options.precision) +
                               " precision"});
  table.add_row({"laplacian", laplacian_in_words(method)});
}

void add_times(TextTable& table, const Answer& f) {
  const SetupTiming& setup = f.method->timing();
  const QueryTiming& query = f.result.timing;
  table.add_row({"load", ms(f.model.load_ms)});
  if (f.method->heat() == nullptr) {
    table.add_row({"set-up", ms(setup.setup)});
    table.add_row({"query", ms(query.query)});
    table.add_row(
        {"memory", mb(f.method->memory_mb()) + " tables, " + mb(f.peak_rss_mb) + " peak"});
    return;
  }
  table.add_row({"set-up", ms(setup.setup) + " = operators " + milliseconds(setup.operators) +
                               " + analysis " + milliseconds(setup.analyze) + " + factors " +
                               milliseconds(setup.factorize)});
  table.add_row({"query", ms(query.query) + " = heat " + milliseconds(query.diffuse) +
                              " + gradient " + milliseconds(query.gradient) + " + Poisson " +
                              milliseconds(query.poisson)});
  table.add_row({"memory", mb(f.method->memory_mb()) + " factors, " + mb(f.peak_rss_mb) + " peak"});
}

/// What was looked at; empty where that is nothing.
std::string bounds_in_words(const Quality& q) {
  if (q.below_straight_line == 0 && q.steep_edges == 0) {
    if (q.lines_checked && q.edges_checked) return "kept";
    return q.lines_checked ? "no vertex below the straight line" : "";
  }
  std::vector<std::string> broken;
  if (q.lines_checked) {
    broken.push_back(counted(q.below_straight_line, "vertex", "vertices") +
                     " below the straight line");
  }
  if (q.edges_checked) broken.push_back(counted(q.steep_edges, "edge", "edges") + " too steep");
  return joined(broken);
}

}  // namespace

std::string distances_in_words(const DistanceSummary& distance) {
  return significant(distance.min) + " to " + significant(distance.max) + ", mean " +
         significant(distance.mean);
}

std::string solve_table(const Answer& f) {
  const Quality& q = f.result.quality;
  const HeatMethod* heat = f.method->heat();
  TextTable table = two_columns();
  std::string model = one_line(f.model.name) + ": ";
  if (const auto& space = f.model.space) {
    const SpaceWords& words = space->words();
    model += counted(f.mesh.vertices, "vertex", "vertices") + ", " +
             counted(space->cell_count(), words.cell, words.cells) + ", " +
             counted(f.mesh.components, "component", "components");
  } else {
    model += mesh_in_words(f.mesh);
  }
  table.add_row({"model", model});
  if (heat != nullptr) {
    add_heat_rows(table, f, *heat);
  } else {
    table.add_row({"method", to_text(f.method->kind()) + ", " +
                                 counted(thread_count(f.options.threads), "thread", "threads")});
  }
  if (f.options.refine > 0) {
    table.add_row({"refined", counted(f.options.refine, "time", "times") +
                                  ": four times the faces each, solved on and left out again"});
  }
  table.add_row({"sources", sources_in_words(f.sources)});
  add_times(table, f);
  const bool time = f.model.space && f.model.space->measures_time();
  table.add_row({time ? "travel time" : "distance", reached_in_words(f.distance, f.mesh.vertices)});
  std::string gradient =
      "| |grad d| - 1 | = " + significant(q.eikonal_error_mean, 2) + " on average";
  if (heat != nullptr) {
    const auto& space = f.model.space;
    gradient += ", " +
                counted(q.zero_gradient_faces, space ? space->words().cell : "face",
                        space ? space->words().cells : "faces") +
                " without direction";
  }
  table.add_row({"gradient", gradient});
  const std::string bounds = bounds_in_words(q);
  if (!bounds.empty()) table.add_row({"bounds", bounds});
  if (heat != nullptr) table.add_row({"residuals", residuals_in_words(q)});
  constexpr double kRoundOff = 1e-9;
  if (q.max_source_distance > kRoundOff * f.distance.max) {
    table.add_row({"at sources", "|d| was at most " + significant(q.max_source_distance, 2) +
                                     " before it was set to 0"});
  }
  if (f.error) table.add_row({"error", to_text(accuracy_line(*f.error))});
  return table.text();
}

std::string vector_text(const Vec3& v) {
  return significant(v[0]) + ", " + significant(v[1]) + ", " + significant(v[2]);
}

namespace {

std::string box_in_words(const MeshReport& mesh) {
  return "(" + vector_text(mesh.box_min) + ") to (" + vector_text(mesh.box_max) + ")";
}

/// `cell`: "face", or what the vertices of a space belong to. `placed`: they lie somewhere.
std::string vertices_in_words(const MeshReport& mesh, const std::string& cell, bool placed = true) {
  return grouped(mesh.vertices) + " (" + grouped(mesh.unreferenced_vertices) + " in no " + cell +
         (placed ? ", " + grouped(mesh.duplicate_positions) + " where another one lies)" : ")");
}

/// The figures of a space: what is drawn of it has figures of no interest.
std::string space_table(const Model& model, const MeshReport& mesh) {
  const Space& space = *model.space;
  TextTable table = two_columns();
  table.add_row({"model", one_line(model.name)});
  table.add_row({"domain", space.described()});
  table.add_row({"vertices", vertices_in_words(mesh, space.words().cell, space.has_places())});
  for (const SpaceFigure& figure : space.figures()) {
    if (!figure.row.empty()) table.add_row({figure.row, figure.text});
  }
  table.add_row({"components", grouped(mesh.components)});
  if (space.has_places()) {
    table.add_row({"box", box_in_words(mesh)});
  }
  table.add_row({"load", ms(model.load_ms)});
  return table.text();
}

}  // namespace

std::string brief_model_text(const Model& model) {
  return one_line(model.name) + ": " + counted(model.mesh->vertex_count(), "vertex", "vertices") +
         ", " + counted(model.mesh->face_count(), "face", "faces");
}

std::string info_table(const Model& model, const MeshReport& mesh) {
  if (model.space) return space_table(model, mesh);
  TextTable table = two_columns();
  const auto row = [&table](const char* name, std::string value) {
    table.add_row({name, std::move(value)});
  };
  row("model", one_line(model.name));
  if (model.from_points) row("domain", "points; faces and edges are those between them");
  row("vertices", vertices_in_words(mesh, "face"));
  row("faces",
      grouped(mesh.faces) + " (" + grouped(mesh.degenerate_faces) + " degenerate, " +
          grouped(mesh.duplicate_faces) + " duplicate" +
          (model.from_points  // whose faces have no sides
               ? ")"
               : ", " + grouped(mesh.inconsistent_faces) + " turned against their neighbours)"));
  row("edges", grouped(mesh.edges) + " (" + grouped(mesh.boundary_edges) + " boundary, " +
                   grouped(mesh.nonmanifold_edges) + " non-manifold, " +
                   grouped(mesh.non_delaunay_edges) + " not Delaunay)");
  row("components", grouped(mesh.components) + (mesh.edge_components == mesh.components
                                                    ? ""
                                                    : " (" + grouped(mesh.edge_components) +
                                                          " when only shared edges connect)"));
  row("boundary loops", grouped(mesh.boundary_loops));
  row("non-manifold vertices", grouped(mesh.nonmanifold_vertices));
  row("Euler characteristic",
      grouped(mesh.euler_characteristic) + (mesh.orientable ? ", orientable" : ", not orientable"));
  row("edge length", "mean " + significant(mesh.mean_edge_length) + ", from " +
                         significant(mesh.shortest_edge) + " to " + significant(mesh.longest_edge));
  row("area", significant(mesh.area));
  row("box", box_in_words(mesh));
  row("smallest angle", significant(mesh.smallest_angle) + " degrees");
  row("mean quality", significant(mesh.mean_quality) + " (1: all equilateral)");
  const LaplacianChoice choice = auto_laplacian(mesh);
  row("laplacian", "auto takes " + to_text(choice.kind) + ": " + choice.why);
  row("load", ms(model.load_ms));
  return table.text();
}

}  // namespace geotherm::app
