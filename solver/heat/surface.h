// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "geotherm/backend.h"
#include "geotherm/distance_method.h"
#include "geotherm/error.h"
#include "geotherm/options.h"
#include "solver/geometry/intrinsic_surface.h"
#include "solver/geometry/operator_mesh.h"

namespace geotherm {

/// How large a component (of OperatorMesh::components) is, in units of the intrinsic mesh.
struct ComponentSize {
  double mean_edge = 1;
  double area = 0;
  Index faces = 0;      ///< of the mesh that were not left out
  double inserted = 0;  ///< share of the vertices that the mesh has not
  double grading = 1;   ///< the diffusion time that its triangulation resolves over mean_edge^2
};

/// A mesh made ready for the heat method: cleaned, triangulated intrinsically, analysed by a
/// backend and renumbered into its elimination order. Immutable; shared by every HeatMethod of the
/// same mesh, backend and Laplacian.
struct Surface : IntrinsicSurface {
  LaplacianKind laplacian = LaplacianKind::kCotan;

  /// V, then inserted vertices (IntrinsicSurface::vertex_count()): elimination number, kNoIndex
  /// when in no face.
  std::vector<Index> row_of_vertex;
  std::vector<Index> vertex_of_row;  ///< n
  std::vector<char> on_boundary;     ///< n: the vertex lies on an edge with one face
  std::shared_ptr<const Analysis> analysis;
  std::shared_ptr<const OperatorMesh> operators;

  std::vector<ComponentSize> components;
  SetupTiming timing;  ///< operators with their stages, and analyze
};

/// `progress` is asked between operators, flips and analysis, as stages "operators" and "analyze".
/// Errors: kBadInput (no face with area), kCancelled, and the backend's.
Result<std::shared_ptr<const Surface>> build_surface(std::shared_ptr<const TriangleMesh> mesh,
                                                     const Backend& backend,
                                                     LaplacianKind laplacian, int threads,
                                                     const Progress& progress = {});

}  // namespace geotherm
