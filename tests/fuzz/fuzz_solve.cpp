// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "geotherm/accuracy.h"
#include "geotherm/mesh.h"
#include "geotherm/mesh_report.h"
#include "solver/geometry/clean_faces.h"
#include "tests/fuzz/fuzz_mesh.h"
#include "tests/fuzz/fuzz_targets.h"

namespace geotherm::test {
namespace {

/// For every vertex whether faces of three different corners join it to a source.
std::vector<char> reach_of(const TriangleMesh& mesh, const SourceSet& sources) {
  std::vector<Index> parent(static_cast<std::size_t>(mesh.vertex_count()));
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&parent](Index v) {
    while (parent[v] != v) v = parent[v];
    return v;
  };
  std::vector<char> used(parent.size(), 0), hot(parent.size(), 0);
  for (const auto& [a, b, c] : mesh.faces()) {
    if (a == b || b == c || c == a) continue;
    parent[root(a)] = root(b);
    parent[root(b)] = root(c);
    used[a] = used[b] = used[c] = 1;
  }
  for (const SurfacePoint& point : sources.points) {
    hot[root(point.is_vertex() ? mesh.standing_for(point.vertex) : mesh.faces()[point.face][0])] =
        1;
  }
  for (const auto& edge : sources.edges) hot[root(mesh.standing_for(edge[0]))] = 1;
  std::vector<char> reached(parent.size());
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const Index stands = mesh.standing_for(v);
    reached[v] = static_cast<char>(used[stands] && hot[root(stands)]);
  }
  return reached;
}

bool is_number(double value) { return !std::isnan(value); }

std::string quality_fault(const Quality& quality) {
  for (const double figure : {quality.heat_residual, quality.poisson_residual,
                              quality.max_source_distance, quality.eikonal_error_mean}) {
    if (std::isnan(figure) || figure < 0) return "a quality figure is no number";
  }
  return "";
}

std::string nearest_fault(const std::vector<char>& reached, const DistanceResult& result) {
  if (result.nearest_source.empty()) return "";
  if (result.nearest_source.size() != reached.size()) return "not one nearest source per vertex";
  for (std::size_t v = 0; v < reached.size(); ++v) {
    const Index source = result.nearest_source[v];
    if (source < kNoIndex || (source != kNoIndex) != (reached[v] != 0)) {
      return "vertex " + std::to_string(v) + " has the source " + std::to_string(source);
    }
  }
  return "";
}

std::string distance_fault(const FuzzCase& given, const DistanceResult& result) {
  const std::vector<char> reached = reach_of(*given.mesh, given.sources);
  if (result.distances.size() != reached.size()) return "not one distance per vertex";
  for (std::size_t v = 0; v < reached.size(); ++v) {
    const double d = result.distances[v];
    if (std::isnan(d) || d < 0 || std::isfinite(d) != (reached[v] != 0)) {
      return "vertex " + std::to_string(v) + " has the distance " + std::to_string(d) + " and is " +
             (reached[v] ? "" : "not ") + "in reach";
    }
  }
  const std::string fault = nearest_fault(reached, result);
  return fault.empty() ? quality_fault(result.quality) : fault;
}

/// Every field that the answer has.
std::string fields_fault(const TriangleMesh& mesh, const DistanceResult& answer) {
  if (!std::ranges::all_of(answer.heat, is_number) ||
      !std::ranges::all_of(answer.log_heat, is_number)) {
    return "u is no number";
  }
  const auto error = signed_error(answer.distances, answer.distances);
  for (const QualityField field : all_values<QualityField>()) {
    if (needs_heat(field) && answer.log_heat.empty()) continue;
    const DataField made = quality_field(field, mesh, answer, error);
    const auto size =
        made.place == DataField::Place::kFaces ? mesh.faces().size() : mesh.positions().size();
    if (made.values.size() != size) return made.name + " has not one value each";
    if (!std::ranges::all_of(made.values, is_number)) return made.name + " is no number";
  }
  return "";
}

/// `distances` becomes those of the answer; empty where there is none.
std::string method_fault(const FuzzCase& given, MethodKind kind, std::vector<double>& distances) {
  MethodOptions options = given.options;
  options.method = kind;
  const auto method = build_method(given.mesh, options);
  if (!method) return message_fault(sentence(method.error()));
  for (const Warning& warning : (*method)->warnings()) {
    if (const std::string fault = message_fault(sentence(warning)); !fault.empty()) return fault;
  }
  const auto result =
      (*method)->solve(given.sources, {.quality = true, .fields = true, .nearest = true});
  if (!result) return message_fault(sentence(result.error()));
  for (const Warning& warning : result->warnings) {
    if (const std::string fault = message_fault(sentence(warning)); !fault.empty()) return fault;
  }
  if (const std::string fault = distance_fault(given, *result); !fault.empty()) return fault;
  distances = result->distances;
  return fields_fault(*given.mesh, *result);
}

std::string accuracy_fault(const FuzzCase& given, const std::vector<double>& heat) {
  const auto method = build_method(given.mesh, given.options);
  if (!method) return message_fault(sentence(method.error()));
  const CheckedAnswers answers{**method, given.options, {&given.sources, 1}, {&heat, 1}};
  const auto report =
      check_accuracy(given.mesh, answers, {.search = RemedySearch::kWhereNotGood, .threads = 1});
  if (!report) return message_fault(sentence(report.error()));
  if (const std::string fault = message_fault(sentence(*report)); !fault.empty()) return fault;
  if (report->remedy && !(report->remedy->mean_relative <= kGoodError))
    return "a remedy that is not good";
  if (!report->cause) return "";
  const ErrorCause& cause = *report->cause;
  if (!(cause.mean_relative_after < cause.mean_relative_before)) return "a cause without effect";
  return "";
}

std::string report_fault(const TriangleMesh& mesh) {
  const MeshReport report = inspect_mesh(mesh);
  for (const double figure : {report.mean_edge_length, report.shortest_edge, report.longest_edge,
                              report.area, report.smallest_angle, report.mean_quality}) {
    if (!(figure >= 0)) return "a figure of the mesh is no number";
  }
  const CrackReport cracks = find_cracks(mesh);
  if (!(cracks.distance >= 0) || cracks.vertices < 0 ||
      cracks.closed_edges > cracks.boundary_edges) {
    return "cracks that cannot be";
  }
  return "";
}

/// The distance to weld with.
double distance_of(Welding welding, const TriangleMesh& mesh) {
  if (welding == Welding::kCracks) return find_cracks(mesh).distance;
  if (welding == Welding::kEqual) return 0;
  const MeshReport report = inspect_mesh(mesh);
  return (report.box_max - report.box_min).stableNorm() / 4;
}

/// Welds the mesh; it stays as it is where that is refused.
std::string welding_fault(FuzzCase& given) {
  if (given.welding == Welding::kNone) return "";
  auto welded = weld(*given.mesh, distance_of(given.welding, *given.mesh));
  if (!welded) return message_fault(sentence(welded.error()));
  given.mesh = std::make_shared<const TriangleMesh>(std::move(welded->mesh));
  return report_fault(*given.mesh);
}

}  // namespace

std::string fuzz_solve(Bytes bytes) {
  FuzzCase given = decode_case(bytes);
  if (!given.mesh) return "";
  if (const std::string fault = report_fault(*given.mesh); !fault.empty()) return fault;
  if (const std::string fault = welding_fault(given); !fault.empty()) return "weld: " + fault;
  std::vector<double> heat;
  for (const std::string& name : all_names<MethodKind>()) {
    const MethodKind kind = *parse<MethodKind>(name);
    std::vector<double> distances;
    const std::string fault = method_fault(given, kind, distances);
    if (!fault.empty()) return name + ": " + fault;
    if (kind == MethodKind::kHeat) heat = distances;
  }
  if (heat.empty()) return "";
  const std::string fault = accuracy_fault(given, heat);
  return fault.empty() ? "" : "accuracy: " + fault;
}

}  // namespace geotherm::test
