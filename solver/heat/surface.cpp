// SPDX-License-Identifier: MIT
#include "solver/heat/surface.h"

#include <algorithm>
#include <cmath>

#include "solver/core/number_text.h"
#include "solver/core/stopwatch.h"

namespace geotherm {
namespace {

/// Numbers the vertices that faces use; `vertices` lists them.
std::vector<Index> number_used(Index vertex_count, const std::vector<Face>& faces,
                               std::vector<Index>& vertices) {
  std::vector<Index> local(static_cast<std::size_t>(vertex_count), kNoIndex);
  for (const Face& face : faces) {
    for (const Index corner : face) local[corner] = 0;
  }
  for (Index v = 0; v < vertex_count; ++v) {
    if (local[v] == kNoIndex) continue;
    local[v] = static_cast<Index>(vertices.size());
    vertices.push_back(v);
  }
  return local;
}

void note_cleaning(const CleanFaces& clean, const IntrinsicMesh& intrinsic,
                   std::vector<std::string>& warnings) {
  if (clean.repeated_corner > 0) {
    warnings.push_back(counted_text(static_cast<std::size_t>(clean.repeated_corner),
                                    "face repeats a corner and was left out",
                                    "faces repeat a corner and were left out"));
  }
  if (clean.duplicate > 0) {
    warnings.push_back(counted_text(static_cast<std::size_t>(clean.duplicate),
                                    "duplicate face was left out",
                                    "duplicate faces were left out"));
  }
  if (intrinsic.mollified_by > 0) {
    warnings.push_back("degenerate or nearly degenerate faces: every edge was lengthened by " +
                       rounded_text(intrinsic.mollified_by) + " mean edge lengths");
  }
}

/// A component whose mean edge differs from that of all by more than this is badly served by one t.
constexpr double kOtherScale = 4;

/// What to say about components whose edges are much longer or shorter than the mean edge of all.
std::string compare_scales(const Surface& surface, const EdgeTable& edges) {
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
  if (!report(progress, "operators", 0.0)) return cancelled_error();
  auto out = std::make_shared<Surface>();
  out->mesh = std::move(mesh);
  CleanFaces clean = clean_faces(*out->mesh);
  const auto positions = out->mesh->positions();
  out->mean_edge = mean_edge_length(positions, clean.edges);
  if (!std::isfinite(out->mean_edge)) {
    double most = 0;
    for (const Vec3& p : positions) most = std::max(most, p.cwiseAbs().maxCoeff());
    return Error{ErrorCode::kBadInput,
                 "the edges of the mesh are too long to be added up (coordinates go up to " +
                     rounded_text(most) + "); scale the model down"};
  }
  if (clean.faces.empty() || !(out->mean_edge > 0)) {
    return Error{ErrorCode::kBadInput,
                 "the mesh has no face with area (" + std::to_string(out->mesh->face_count()) +
                     " faces, " + std::to_string(clean.repeated_corner) +
                     " repeat a corner, mean edge length " + rounded_text(out->mean_edge) +
                     "); check how it was exported"};
  }
  if (!report(progress, "operators", 0.2)) return cancelled_error();
  out->intrinsic = build_intrinsic_mesh(positions, clean, out->mean_edge);
  note_cleaning(clean, out->intrinsic, out->warnings);

  if (laplacian == LaplacianKind::kTufted) {
    return Error{ErrorCode::kNotAvailable,
                 "--laplacian tufted is not available in this version; use auto, which flips every "
                 "edge that has two faces"};
  }
  const bool flip = laplacian == LaplacianKind::kIntrinsicDelaunay ||
                    (laplacian == LaplacianKind::kAuto && count_non_delaunay(out->intrinsic) > 0);
  out->laplacian = flip ? LaplacianKind::kIntrinsicDelaunay : LaplacianKind::kCotan;
  if (!report(progress, "operators", 0.3)) return cancelled_error();
  if (flip) {
    auto flips = flip_to_delaunay(out->intrinsic, part_of(progress, 0.3, 0.4));
    if (!flips) return flips.error();
    out->flips = std::move(*flips);
  }

  std::vector<Index> used;
  const std::vector<Index> local = number_used(out->mesh->vertex_count(), clean.faces, used);
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

  if (!report(progress, "analyze", 0.4)) return cancelled_error();
  auto analysis = backend.analyze(pattern, used_positions, threads);
  if (!analysis) return analysis.error();
  out->analysis = std::move(*analysis);
  out->analyze_ms = watch.lap();

  if (!report(progress, "operators", 0.8)) return cancelled_error();
  const std::span<const Index> order = out->analysis->order();
  out->operators = build_operator_mesh(out->intrinsic, pattern, local, order);
  out->vertex_of_row.resize(used.size());
  out->row_of_vertex.assign(local.size(), kNoIndex);
  for (std::size_t k = 0; k < order.size(); ++k) {
    out->vertex_of_row[k] = used[order[k]];
    out->row_of_vertex[used[order[k]]] = static_cast<Index>(k);
  }
  out->on_boundary.assign(used.size(), 0);
  for (Index e = 0; e < clean.edges.edge_count(); ++e) {
    if (clean.edges.sides(e).size() != 1) continue;
    out->on_boundary[out->row_of_vertex[clean.edges.low(e)]] = 1;
    out->on_boundary[out->row_of_vertex[clean.edges.high(e)]] = 1;
  }
  for (const double mass : out->operators->mass) out->unit_area += mass;
  if (!(out->unit_area > 0)) {
    return Error{ErrorCode::kBadInput, "the mesh has no area; all its faces are degenerate"};
  }
  out->clean_of_face.assign(static_cast<std::size_t>(out->mesh->face_count()), kNoIndex);
  for (std::size_t c = 0; c < clean.original.size(); ++c) {
    out->clean_of_face[clean.original[c]] = static_cast<Index>(c);
  }
  if (out->operators->components.count > 1) {
    out->scale_warning = compare_scales(*out, clean.edges);
  }
  out->clean_faces = std::move(clean.faces);
  out->operators_ms += watch.lap();
  return std::shared_ptr<const Surface>(std::move(out));
}

}  // namespace geotherm
