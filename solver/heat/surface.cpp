// SPDX-License-Identifier: MIT
#include "solver/heat/surface.h"

#include <algorithm>
#include <cmath>

#include "solver/core/number_text.h"
#include "solver/core/stopwatch.h"
#include "solver/geometry/surface_pattern.h"

namespace geotherm {
namespace {

/// Share of the work at which the analysis begins, and ends.
constexpr double kAnalyzeFrom = 0.4, kAnalyzeTo = 0.8;

FlipRule flip_rule(LaplacianKind laplacian) {
  switch (laplacian) {
    case LaplacianKind::kIntrinsicDelaunay:
    case LaplacianKind::kTufted:
      return FlipRule::kAlways;
    case LaplacianKind::kAuto:
      return FlipRule::kWhereNeeded;
    default:
      return FlipRule::kNever;
  }
}

CoverRule cover_rule(LaplacianKind laplacian) {
  switch (laplacian) {
    case LaplacianKind::kTufted:
      return CoverRule::kAlways;
    case LaplacianKind::kAuto:
      return CoverRule::kWhereNeeded;
    default:
      return CoverRule::kNever;
  }
}

/// Numbers the vertices that faces use; `vertices` lists them.
std::vector<Index> number_used(const std::vector<char>& on_surface, std::vector<Index>& vertices) {
  std::vector<Index> local(on_surface.size(), kNoIndex);
  for (std::size_t v = 0; v < on_surface.size(); ++v) {
    if (!on_surface[v]) continue;
    local[v] = static_cast<Index>(vertices.size());
    vertices.push_back(static_cast<Index>(v));
  }
  return local;
}

/// A mean edge below this, in those of the whole mesh, is that of a point: its faces were given
/// areas (mollify.h), and these say how long its edges are.
constexpr double kPoint = 1e-60;

/// Sizes of the components; of the only one the mean edge is exactly 1.
std::vector<ComponentSize> measure_components(const Surface& surface) {
  const OperatorMesh& mesh = *surface.operators;
  std::vector<ComponentSize> sizes(static_cast<std::size_t>(mesh.components.count));
  for (Index i = 0; i < mesh.size(); ++i) sizes[mesh.components.of[i]].area += mesh.mass[i];
  for (const Face& face : mesh.faces) ++sizes[mesh.components.of[face[0]]].faces;
  for (std::size_t c = 0; c < sizes.size(); ++c) {
    if (!mesh.is_doubled(static_cast<Index>(c))) continue;
    sizes[c].area /= 2;
    sizes[c].faces /= 2;
  }
  if (sizes.size() == 1) return sizes;
  const EdgeTable& edges = surface.clean_edges;
  std::vector<double> sum(sizes.size(), 0.0);
  std::vector<Index> count(sizes.size(), 0);
  for (Index e = 0; e < edges.edge_count(); ++e) {
    const Vec3& low = surface.mesh->positions()[edges.low(e)];
    const Vec3& high = surface.mesh->positions()[edges.high(e)];
    const Index c = mesh.components.of[surface.row_of_vertex[edges.low(e)]];
    sum[c] += safe_norm(low - high) / surface.mean_edge;
    ++count[c];
  }
  for (std::size_t c = 0; c < sizes.size(); ++c) {
    const double mean = sum[c] / count[c];
    sizes[c].mean_edge = mean > kPoint ? mean : std::sqrt(sizes[c].area / sizes[c].faces);
  }
  return sizes;
}

LaplacianKind kind_of(const IntrinsicSurface& surface) {
  if (surface.tufted) return LaplacianKind::kTufted;
  return surface.delaunay ? LaplacianKind::kIntrinsicDelaunay : LaplacianKind::kCotan;
}

}  // namespace

Result<std::shared_ptr<const Surface>> build_surface(std::shared_ptr<const TriangleMesh> mesh,
                                                     const Backend& backend,
                                                     LaplacianKind laplacian, int threads,
                                                     const Progress& progress) {
  Stopwatch watch, stage;
  auto built =
      build_intrinsic_surface(std::move(mesh), flip_rule(laplacian),
                              part_of(progress, 0.0, kAnalyzeFrom), cover_rule(laplacian), threads);
  if (!built) return built.error();
  auto out = std::make_shared<Surface>();
  static_cast<IntrinsicSurface&>(*out) = std::move(*built);
  out->laplacian = kind_of(*out);
  const auto positions = out->mesh->positions();
  const EdgeTable& edges = out->clean_edges;

  stage.lap();
  std::vector<Index> used;
  const std::vector<Index> local = number_used(out->on_surface, used);
  const SymmetricPattern pattern =
      surface_pattern(out->intrinsic, out->corners, used, local, threads);
  out->corners = {};
  std::vector<Vec3> used_positions(used.size());
  for (std::size_t i = 0; i < used.size(); ++i) used_positions[i] = positions[used[i]];
  SetupTiming& timing = out->timing;
  timing.stages = {out->times.clean, out->times.intrinsic, out->times.flips, stage.lap(), 0};
  timing.operators = watch.lap();

  if (!report(progress, "analyze", kAnalyzeFrom)) return cancelled_error();
  auto analysis = backend.analyze(pattern, used_positions, threads);
  if (!analysis) return analysis.error();
  out->analysis = std::move(*analysis);
  timing.analyze = watch.lap();

  if (!report(progress, "operators", kAnalyzeTo)) return cancelled_error();
  const std::span<const Index> order = out->analysis->order();
  out->operators = build_operator_mesh(out->intrinsic, pattern, local, order, threads);
  out->vertex_of_row.resize(used.size());
  out->row_of_vertex.assign(local.size(), kNoIndex);
  for (std::size_t k = 0; k < order.size(); ++k) {
    out->vertex_of_row[k] = used[order[k]];
    out->row_of_vertex[used[order[k]]] = static_cast<Index>(k);
  }
  out->on_boundary.assign(used.size(), 0);
  for (Index e = 0; e < edges.edge_count(); ++e) {
    if (edges.sides(e).size() != 1) continue;
    out->on_boundary[out->row_of_vertex[edges.low(e)]] = 1;
    out->on_boundary[out->row_of_vertex[edges.high(e)]] = 1;
  }
  out->components = measure_components(*out);
  if (std::ranges::none_of(out->components, [](const auto& size) { return size.area > 0; })) {
    return Error{ErrorCode::kBadInput, "the mesh has no area; all its faces are degenerate"};
  }
  timing.stages.renumber = watch.lap();
  timing.operators += timing.stages.renumber;
  return std::shared_ptr<const Surface>(std::move(out));
}

}  // namespace geotherm
