// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "solver/core/progress.h"
#include "solver/core/result.h"
#include "solver/geometry/delaunay.h"
#include "solver/geometry/intrinsic_mesh.h"
#include "solver/mesh/surface_point.h"
#include "solver/mesh/triangle_mesh.h"

namespace geotherm {

/// When the edges of a mesh are flipped to Delaunay.
enum class FlipRule { kNever, kWhereNeeded, kAlways };

/// A mesh made ready for numerical work: cleaned, and triangulated intrinsically. Immutable; every
/// distance method begins with one.
struct IntrinsicSurface {
  std::shared_ptr<const TriangleMesh> mesh;
  std::vector<Face> clean_faces;     ///< before flips, as CleanFaces
  std::vector<Index> clean_of_face;  ///< F of the mesh: number in clean_faces, or kNoIndex
  IntrinsicMesh intrinsic;           ///< after flips; its vertices are the mesh's
  std::vector<Flip> flips;
  bool delaunay = false;  ///< flips were asked for or needed
  double mean_edge = 0;   ///< of the mesh, model units; also the unit of `intrinsic`
  std::vector<std::string> warnings;
};

/// `progress` is asked as stage "operators". Errors: kBadInput (no face with area, edges that cannot
/// be added up), kCancelled. Cost: O(F + flips).
Result<IntrinsicSurface> build_intrinsic_surface(std::shared_ptr<const TriangleMesh> mesh,
                                                 FlipRule rule, const Progress& progress = {});

/// Whether every source lies on the surface. Errors (kBadInput, with the numbers): no source, a
/// vertex or face out of range, a vertex in no face, bad weights, a face that was left out, an edge
/// that is none, offsets that are negative, not finite or not one a point.
Result<void> check_sources(const IntrinsicSurface& surface, const SourceSet& sources);

}  // namespace geotherm
