// SPDX-License-Identifier: MIT
#include "solver/geometry/intrinsic_surface.h"

#include <algorithm>
#include <cmath>

#include "solver/core/number_text.h"
#include "solver/geometry/tufted_cover.h"

namespace geotherm {
namespace {

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
    return Error{ErrorCode::kBadInput,
                 "the mesh has no face with area (" + std::to_string(mesh.face_count()) +
                     " faces, " + std::to_string(clean.repeated_corner) +
                     " repeat a corner, mean edge length " + rounded_text(mean_edge) +
                     "); check how it was exported"};
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

void keep_clean_faces(CleanFaces clean, IntrinsicSurface& surface) {
  surface.clean_of_face.assign(static_cast<std::size_t>(surface.mesh->face_count()), kNoIndex);
  for (std::size_t c = 0; c < clean.original.size(); ++c) {
    surface.clean_of_face[clean.original[c]] = static_cast<Index>(c);
  }
  surface.on_surface.assign(static_cast<std::size_t>(surface.mesh->vertex_count()), 0);
  for (const Face& face : clean.faces) {
    for (const Index corner : face) surface.on_surface[corner] = 1;
  }
  surface.clean_faces = std::move(clean.faces);
  surface.clean_edges = std::move(clean.edges);
}

Result<IntrinsicSurface> build_intrinsic_surface(std::shared_ptr<const TriangleMesh> mesh,
                                                 FlipRule rule, const Progress& progress,
                                                 CoverRule cover) {
  if (!report(progress, "operators", 0.0)) return cancelled_error();
  IntrinsicSurface out;
  out.mesh = std::move(mesh);
  CleanFaces clean = clean_faces(*out.mesh);
  const auto positions = out.mesh->positions();
  out.mean_edge = mean_edge_length(positions, clean.edges);
  if (const auto valid = check_mean_edge(*out.mesh, clean, out.mean_edge); !valid) {
    return valid.error();
  }
  if (!report(progress, "operators", 0.5)) return cancelled_error();
  out.intrinsic = build_intrinsic_mesh(positions, clean, out.mean_edge);
  out.warnings = cleaning_notes(clean);
  note_mollification(out.intrinsic, out.warnings);
  const std::vector<char> doubled = faces_to_double(clean, out.mesh->vertex_count(), cover);
  out.tufted = !doubled.empty();
  if (out.tufted) make_tufted_cover(out.intrinsic, positions, clean, doubled);

  out.delaunay = rule == FlipRule::kAlways ||
                 (rule == FlipRule::kWhereNeeded && count_non_delaunay(out.intrinsic) > 0);
  if (!report(progress, "operators", 0.75)) return cancelled_error();
  if (out.delaunay) {
    auto flips = flip_to_delaunay(out.intrinsic, part_of(progress, 0.75, 1.0));
    if (!flips) return flips.error();
    out.flips = std::move(*flips);
  }
  keep_clean_faces(std::move(clean), out);
  return out;
}

}  // namespace geotherm
