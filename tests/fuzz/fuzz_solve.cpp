// SPDX-License-Identifier: MIT
#include <cmath>
#include <numeric>

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
    hot[root(point.is_vertex() ? point.vertex : mesh.faces()[point.face][0])] = 1;
  }
  for (const auto& edge : sources.edges) hot[root(edge[0])] = 1;
  std::vector<char> reached(parent.size());
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    reached[v] = static_cast<char>(used[v] && hot[root(v)]);
  }
  return reached;
}

std::string quality_fault(const Quality& quality) {
  for (const double figure : {quality.heat_residual, quality.poisson_residual,
                              quality.max_source_distance, quality.eikonal_error_mean}) {
    if (std::isnan(figure) || figure < 0) return "a quality figure is no number";
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
  return quality_fault(result.quality);
}

std::string method_fault(const FuzzCase& given, MethodKind kind) {
  MethodOptions options = given.options;
  options.method = kind;
  const auto method = build_method(given.mesh, options);
  if (!method) return message_fault(method.error().message);
  for (const std::string& warning : (*method)->warnings()) {
    if (const std::string fault = message_fault(warning); !fault.empty()) return fault;
  }
  const auto result = (*method)->solve(given.sources);
  if (!result) return message_fault(result.error().message);
  return distance_fault(given, *result);
}

}  // namespace

std::string fuzz_solve(Bytes bytes) {
  const FuzzCase given = decode_case(bytes);
  if (!given.mesh) return "";
  for (const std::string& name : method_names()) {
    const std::string fault = method_fault(given, *parse_method(name));
    if (!fault.empty()) return name + ": " + fault;
  }
  return "";
}

}  // namespace geotherm::test
