// SPDX-License-Identifier: MIT
#include "solver/geometry/intrinsic_surface.h"

#include <algorithm>
#include <cmath>

#include "solver/core/number_text.h"
#include "solver/core/parallel.h"
#include "solver/core/stopwatch.h"
#include "solver/geometry/tufted_cover.h"

namespace geotherm {
namespace {

/// Faces a thread must have to be worth starting.
constexpr std::int64_t kGrain = 1 << 15;

void note_mollification(const IntrinsicMesh& intrinsic, std::vector<std::string>& warnings) {
  const Mollification& mollified = intrinsic.mollified;
  if (mollified.most > 0) {
    warnings.push_back(
        counted_text(static_cast<std::size_t>(mollified.faces), "face is", "faces are") +
        " degenerate or nearly so: " +
        counted_text(static_cast<std::size_t>(mollified.edges), "edge was", "edges were") +
        " lengthened in " +
        counted_text(static_cast<std::size_t>(mollified.components), "component", "components") +
        ", by up to " + rounded_text(mollified.most) +
        " mean edge lengths; distances across them may be too long by as much");
  }
}

/// A flag per clean face, empty where none is to be doubled.
std::vector<char> faces_to_double(const CleanFaces& clean, Index vertex_count, CoverRule rule) {
  switch (rule) {
    case CoverRule::kAlways:
      return std::vector<char>(clean.faces.size(), 1);
    case CoverRule::kWhereNeeded:
      return faces_that_need_cover(clean, vertex_count);
    case CoverRule::kNever:
      break;
  }
  return {};
}

/// Whether lengths can be measured in units of the mean edge.
Result<void> check_mean_edge(const TriangleMesh& mesh, const CleanFaces& clean, double mean_edge) {
  if (!std::isfinite(mean_edge)) {
    double most = 0;
    for (const Vec3& p : mesh.positions()) most = std::max(most, p.cwiseAbs().maxCoeff());
    return Error{ErrorCode::kBadInput,
                 "the edges of the mesh are too long to be added up (coordinates go up to " +
                     rounded_text(most) + "); scale the model down"};
  }
  if (clean.faces.empty() || !(mean_edge > 0)) {
    return Error{
        ErrorCode::kBadInput,
        "the mesh has no face with area (" +
            counted_text(static_cast<std::size_t>(mesh.face_count()), "face", "faces") + ", " +
            counted_text(static_cast<std::size_t>(clean.repeated_corner), "repeats a corner",
                         "repeat a corner") +
            ", mean edge length " + rounded_text(mean_edge) + "); check how it was exported"};
  }
  return {};
}

}  // namespace

std::vector<std::string> cleaning_notes(const CleanFaces& clean) {
  std::vector<std::string> notes;
  if (clean.repeated_corner > 0) {
    notes.push_back(counted_text(static_cast<std::size_t>(clean.repeated_corner),
                                 "face repeats a corner and was left out",
                                 "faces repeat a corner and were left out"));
  }
  if (clean.duplicate > 0) {
    notes.push_back(counted_text(static_cast<std::size_t>(clean.duplicate),
                                 "duplicate face was left out", "duplicate faces were left out"));
  }
  return notes;
}

void keep_clean_faces(CleanFaces clean, IntrinsicSurface& surface, int threads) {
  surface.clean_of_face.assign(static_cast<std::size_t>(surface.mesh->face_count()), kNoIndex);
  surface.on_surface.resize(static_cast<std::size_t>(surface.mesh->vertex_count()));
  parallel_for(threads, static_cast<std::int64_t>(clean.original.size()), kGrain,
               [&](std::int64_t begin, std::int64_t end) {
                 for (std::int64_t c = begin; c < end; ++c) {
                   const Index original = clean.original[static_cast<std::size_t>(c)];
                   surface.clean_of_face[original] = static_cast<Index>(c);
                 }
               });
  for (Index v = 0; v < surface.mesh->vertex_count(); ++v) {
    surface.on_surface[v] = clean.corners.at(v).empty() ? 0 : 1;
  }
  surface.clean_faces = std::move(clean.faces);
  surface.clean_edges = std::move(clean.edges);
  surface.corners = std::move(clean.corners);
}

Result<IntrinsicSurface> build_intrinsic_surface(std::shared_ptr<const TriangleMesh> mesh,
                                                 FlipRule rule, const Progress& progress,
                                                 CoverRule cover, int threads) {
  if (!report(progress, "operators", 0.0)) return cancelled_error();
  Stopwatch watch;
  IntrinsicSurface out;
  out.mesh = std::move(mesh);
  CleanFaces clean = clean_faces(*out.mesh, threads);
  const auto positions = out.mesh->positions();
  out.times.clean = watch.lap();
  out.mean_edge = mean_edge_length(positions, clean.edges, threads);
  if (const auto valid = check_mean_edge(*out.mesh, clean, out.mean_edge); !valid) {
    return valid.error();
  }
  if (!report(progress, "operators", 0.5)) return cancelled_error();
  out.intrinsic = build_intrinsic_mesh(positions, clean, out.mean_edge, threads);
  out.warnings = cleaning_notes(clean);
  note_mollification(out.intrinsic, out.warnings);
  const Index vertices = out.mesh->vertex_count();
  const std::vector<char> doubled = faces_to_double(clean, vertices, cover);
  out.tufted = !doubled.empty();
  if (out.tufted) make_tufted_cover(out.intrinsic, positions, clean, doubled);

  if (!report(progress, "operators", 0.75)) return cancelled_error();
  out.times.intrinsic = watch.lap();
  std::vector<Side> sides;
  if (rule != FlipRule::kNever) sides = non_delaunay_sides(out.intrinsic, threads);
  out.delaunay = rule == FlipRule::kAlways || !sides.empty();
  if (!sides.empty()) {
    auto flips = flip_to_delaunay(out.intrinsic, std::move(sides), part_of(progress, 0.75, 1.0));
    if (!flips) return flips.error();
    out.flips = std::move(*flips);
  }
  out.times.flips = watch.lap();
  keep_clean_faces(std::move(clean), out, threads);
  if (!out.flips.empty() || out.tufted) {
    out.corners = CornerTable(vertices, out.intrinsic.faces, threads);
  }
  out.times.clean += watch.lap();
  return out;
}

}  // namespace geotherm
