// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "geotherm/domains.h"
#include "geotherm/progress.h"

namespace geotherm {

/// Whether the triangles between the sides of a face and its virtual vertex are the face: all are
/// turned to the side that their sum is.
bool sees_all_sides(std::span<const Vec3> corners, const Vec3& virtual_vertex);

/// Polygons whose triangles at virtual vertices were flipped to Delaunay. A face that a flip
/// touched has its virtual vertex as a vertex of the complex, and its cells are triangles across
/// the faces; the others have the cells that they had.
struct FlippedPolygons {
  /// With the numbers, widths and order of the cells that were given; the vertices from those on
  /// are virtual ones. A triangle that visits a vertex twice has it once as a corner.
  CellComplex cells;
  std::vector<Index> triangle_of_cell;  ///< C: number among `triangles`; kNoIndex: none
  std::vector<Index> virtual_of_cell;   ///< C: vertex of `cells` that is its face's virtual one
  std::vector<Face> triangles;          ///< vertices of `cells`
  std::vector<std::array<double, 3>> lengths;  ///< of their sides, in the unit that was asked for
};

/// Null where no edge has to be flipped, and for what are no polygons with virtual vertices. Left
/// as they are: faces that do not see all their sides, have a side without length, or a triangle
/// that is nearly flat, and edges that do not join two faces of one orientation. `progress` is
/// asked as stage "operators". Errors: kCancelled. The same bits with any number of threads. Cost:
/// O(corners + flips).
Result<std::shared_ptr<const FlippedPolygons>> flip_polygons(const CellComplex& given, double unit,
                                                             int threads, const Progress& progress);

}  // namespace geotherm
