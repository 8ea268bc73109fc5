// SPDX-License-Identifier: MIT
#include "solver/geometry/intrinsic_surface.h"

#include <algorithm>
#include <cmath>

#include "solver/core/number_text.h"

namespace geotherm {
namespace {

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
                       rounded_text(intrinsic.mollified_by) +
                       " mean edge lengths, and distances may be too long by as much for each "
                       "edge on the way");
  }
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

Result<IntrinsicSurface> build_intrinsic_surface(std::shared_ptr<const TriangleMesh> mesh,
                                                 FlipRule rule, const Progress& progress) {
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
  note_cleaning(clean, out.intrinsic, out.warnings);

  out.delaunay = rule == FlipRule::kAlways ||
                 (rule == FlipRule::kWhereNeeded && count_non_delaunay(out.intrinsic) > 0);
  if (!report(progress, "operators", 0.75)) return cancelled_error();
  if (out.delaunay) {
    auto flips = flip_to_delaunay(out.intrinsic, part_of(progress, 0.75, 1.0));
    if (!flips) return flips.error();
    out.flips = std::move(*flips);
  }
  out.clean_of_face.assign(static_cast<std::size_t>(out.mesh->face_count()), kNoIndex);
  for (std::size_t c = 0; c < clean.original.size(); ++c) {
    out.clean_of_face[clean.original[c]] = static_cast<Index>(c);
  }
  out.on_surface.assign(positions.size(), 0);
  for (const Face& face : clean.faces) {
    for (const Index corner : face) out.on_surface[corner] = 1;
  }
  out.clean_faces = std::move(clean.faces);
  out.clean_edges = std::move(clean.edges);
  return out;
}

}  // namespace geotherm
