// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>
#include <vector>

#include "solver/geometry/clean_faces.h"
#include "solver/mesh/edge_table.h"

namespace geotherm {

/// A surface as faces and edge lengths, without positions. Everything numerical is computed from
/// this: the mesh of the file, its intrinsic Delaunay triangulation and any other triangulation of
/// the same surface are one code path.
///
/// Side k of a face joins its corners k and k + 1. Both sides of an inner edge have the same
/// length; every face satisfies the triangle inequality strictly.
struct IntrinsicMesh {
  std::vector<Face> faces;                     ///< F x 3 vertices
  std::vector<std::array<double, 3>> lengths;  ///< F x 3, in units of `unit`
  std::vector<Side> twin;                      ///< 3F: the other side of the edge, or kNoSide
  double unit = 1.0;                           ///< length of 1 in model units: the mean edge length
  double mollified_by = 0;  ///< what was added to every length, in units of `unit`

  Index face_count() const { return static_cast<Index>(faces.size()); }
};

/// Mean length over the edges (each counted once), model units.
double mean_edge_length(std::span<const Vec3> positions, const EdgeTable& edges);

/// Builds the intrinsic mesh of clean faces. Lengths are divided by `unit` (> 0), so that what
/// follows sees numbers of order 1 at any scale. Faces that are degenerate or nearly so are
/// mollified: the smallest common length is added to all edges that makes every triangle
/// inequality strict by 1e-5 of the face's longest side (Sharp, Crane 2020, section 4.5). Edges
/// with a number of sides other than two, or whose faces disagree in orientation, get no twins.
/// Cost: O(F).
IntrinsicMesh build_intrinsic_mesh(std::span<const Vec3> positions, const CleanFaces& clean,
                                   double unit);

/// A triangle laid out in its own plane: corner 0 at the origin, corner 1 at (base, 0), corner 2
/// at (x, height), height > 0.
struct FaceLayout {
  double base, x, height;
};
FaceLayout lay_out(const std::array<double, 3>& lengths);

/// Twice the cotangent weight of a side's own face: the cotangent of the angle opposite to it.
double opposite_cotangent(const std::array<double, 3>& lengths, int side);

}  // namespace geotherm
