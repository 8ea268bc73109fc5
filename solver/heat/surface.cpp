// SPDX-License-Identifier: MIT
#include "solver/heat/surface.h"

#include <algorithm>
#include <cmath>

#include "solver/core/number_text.h"
#include "solver/core/stopwatch.h"

namespace geotherm {
namespace {

/// Share of the work at which the analysis begins, and ends.
constexpr double kAnalyzeFrom = 0.4, kAnalyzeTo = 0.8;

FlipRule flip_rule(LaplacianKind laplacian) {
  switch (laplacian) {
    case LaplacianKind::kIntrinsicDelaunay:
      return FlipRule::kAlways;
    case LaplacianKind::kAuto:
      return FlipRule::kWhereNeeded;
    default:
      return FlipRule::kNever;
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

/// A component whose mean edge differs from that of all by more than this is badly served by one t.
constexpr double kOtherScale = 4;

/// What to say about components whose edges are much longer or shorter than the mean edge of all.
std::string compare_scales(const Surface& surface) {
  const EdgeTable& edges = surface.clean_edges;
  const Components& components = surface.operators->components;
  std::vector<double> sum(static_cast<std::size_t>(components.count), 0.0);
  std::vector<Index> count(sum.size(), 0);
  for (Index e = 0; e < edges.edge_count(); ++e) {
    const Vec3& low = surface.mesh->positions()[edges.low(e)];
    const Vec3& high = surface.mesh->positions()[edges.high(e)];
    const Index c = components.of[surface.row_of_vertex[edges.low(e)]];
    sum[c] += (low - high).stableNorm() / surface.mean_edge;
    ++count[c];
  }
  Index others = 0;
  double farthest = 1;
  for (std::size_t c = 0; c < sum.size(); ++c) {
    const double mean = sum[c] / count[c];
    if (mean < kOtherScale && mean > 1 / kOtherScale) continue;
    ++others;
    if (std::abs(std::log(mean)) > std::abs(std::log(farthest))) farthest = mean;
  }
  if (others == 0) return {};
  return std::to_string(others) + " of " + std::to_string(components.count) +
         " components have edges of quite another length (" +
         rounded_text(farthest * surface.mean_edge) + " on average, all together " +
         rounded_text(surface.mean_edge) +
         "), and t, which follows the latter, fits them badly; solve them apart or use --time-step "
         "absolute:T";
}

}  // namespace

Result<std::shared_ptr<const Surface>> build_surface(std::shared_ptr<const TriangleMesh> mesh,
                                                     const Backend& backend,
                                                     LaplacianKind laplacian, int threads,
                                                     const Progress& progress) {
  Stopwatch watch;
  if (laplacian == LaplacianKind::kTufted) {
    return Error{ErrorCode::kNotAvailable,
                 "--laplacian tufted is not available in this version; use auto, which flips every "
                 "edge that has two faces"};
  }
  auto built = build_intrinsic_surface(std::move(mesh), flip_rule(laplacian),
                                       part_of(progress, 0.0, kAnalyzeFrom));
  if (!built) return built.error();
  auto out = std::make_shared<Surface>();
  static_cast<IntrinsicSurface&>(*out) = std::move(*built);
  out->laplacian = out->delaunay ? LaplacianKind::kIntrinsicDelaunay : LaplacianKind::kCotan;
  const auto positions = out->mesh->positions();
  const EdgeTable& edges = out->clean_edges;

  std::vector<Index> used;
  const std::vector<Index> local = number_used(out->on_surface, used);
  const SymmetricPattern pattern = pattern_of_faces(static_cast<Index>(used.size()), [&] {
    std::vector<Face> faces = out->intrinsic.faces;
    for (Face& face : faces) {
      for (Index& corner : face) corner = local[corner];
    }
    return faces;
  }());
  std::vector<Vec3> used_positions(used.size());
  for (std::size_t i = 0; i < used.size(); ++i) used_positions[i] = positions[used[i]];
  out->operators_ms = watch.lap();

  if (!report(progress, "analyze", kAnalyzeFrom)) return cancelled_error();
  auto analysis = backend.analyze(pattern, used_positions, threads);
  if (!analysis) return analysis.error();
  out->analysis = std::move(*analysis);
  out->analyze_ms = watch.lap();

  if (!report(progress, "operators", kAnalyzeTo)) return cancelled_error();
  const std::span<const Index> order = out->analysis->order();
  out->operators = build_operator_mesh(out->intrinsic, pattern, local, order);
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
  for (const double mass : out->operators->mass) out->unit_area += mass;
  if (!(out->unit_area > 0)) {
    return Error{ErrorCode::kBadInput, "the mesh has no area; all its faces are degenerate"};
  }
  if (out->operators->components.count > 1) {
    out->scale_warning = compare_scales(*out);
  }
  out->operators_ms += watch.lap();
  return std::shared_ptr<const Surface>(std::move(out));
}

}  // namespace geotherm
