// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "geotherm/domains.h"
#include "geotherm/mesh_report.h"
#include "geotherm/progress.h"
#include "solver/geometry/intrinsic_mesh.h"
#include "solver/linear/symmetric_pattern.h"

namespace geotherm {

/// Polygons whose triangles at virtual vertices were flipped to Delaunay, and refined where they
/// are too large for one diffusion time. A face that an edit touched has its virtual vertex as a
/// vertex of the complex, and its cells are triangles across the faces; the others have the cells
/// that they had.
struct FlippedPolygons {
  /// Cells by the numbers that they were given with, then those that refinement has made. Its
  /// vertices from those that were given on are virtual or inserted. A triangle that visits a
  /// vertex twice has it once as a corner. Without numbers and virtual vertices.
  CellComplex cells;
  std::vector<Index> triangle_of_cell;         ///< of `cells`: one of `triangles`; kNoIndex: none
  std::vector<Face> triangles;                 ///< vertices of `cells`
  std::vector<std::array<double, 3>> lengths;  ///< of their sides, in the unit that was asked for
  std::vector<Index> virtual_of_cell;  ///< C: vertex of `cells` that is its face's; kNoIndex: none
  Components parts;                    ///< of the vertices that were given; kNoIndex: in no cell
  std::vector<double> mean_width;      ///< of each part's cells before refinement, in that unit
  std::vector<double> grading;         ///< of each part, Refinement::grading
  Index flips = 0;                     ///< edits that were flips
  RefinementCounts inserted;           ///< vertices, and why
};

/// Null where no edge has to be flipped, and for what are no polygons with virtual vertices. Parts
/// with an edge that does not join two faces of one orientation are flipped as their tufted cover:
/// each cell of theirs that is a triangle stands there twice, with half the area. Faces that have
/// no triangles (PolygonFans) stay as they are. `progress` is asked as stage "operators". Errors:
/// kCancelled. The same bits with any number of threads. Cost: O(corners + edits).
Result<std::shared_ptr<const FlippedPolygons>> flip_polygons(const CellComplex& given, double unit,
                                                             int threads, const Progress& progress);

}  // namespace geotherm
