// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "geotherm/domains.h"
#include "geotherm/mesh.h"

namespace geotherm {

/// The points x with normal . x = offset. What lies where the normal points is removed.
struct SlicePlane {
  Vec3 normal = Vec3::UnitX();
  double offset = 0;
};

/// The point a + share (b - a) of an edge; its value is interpolated in the same way.
struct EdgePoint {
  Index a = kNoIndex, b = kNoIndex;
  double share = 0;

  bool operator==(const EdgePoint&) const = default;
};

/// What a plane leaves of a model, as triangles.
struct SlicedSurface {
  std::vector<EdgePoint> points;  ///< corner V + i of a face is point i, V the number of positions
  /// First what is left of the model's faces, each turned as it was; then the cut through the
  /// tets, which looks along the normal. No corner of the cut is one of the model's faces: it has
  /// points of its own, which are vertices (share 0) where the plane passes through these.
  std::vector<Face> faces;
  std::vector<Index> origin;  ///< of each: the face that it is a part of, kNoIndex in the cut
  std::vector<Index> tets;    ///< of the faces of the cut: the tet, by its place among those given
};

/// Removes what lies beyond a plane: faces are cut exactly at it, and the body of the tets shows
/// its inside (marching tetrahedra; a tet that is cut in a quadrilateral gives two triangles).
/// Without tets nothing fills the opening. Vertices nearer to the plane than `near` count as on it,
/// so that it leaves no slivers beside them. Faces in the plane belong to what is removed; the tets
/// below them put the cut in their place. Preconditions: corners are positions; near >= 0, in units
/// of normal . x. Throws std::bad_alloc. Cost: O(V + F + T).
SlicedSurface slice(std::span<const Vec3> positions, std::span<const Face> faces,
                    std::span<const Tet> tets, const SlicePlane& plane, double near);

/// The border of some of a volume's tets.
struct PeeledSurface {
  std::vector<Face> faces;    ///< counter-clockwise as seen from outside
  std::vector<Index> origin;  ///< of each: the same face of the whole border, or kNoIndex
  std::vector<Index> tets;    ///< of each: the tet that it belongs to
};

/// `keep`: T, 0 where the tet is removed. `border`: of the whole volume, as boundary() gives it.
/// Precondition: sizes that fit. Throws std::bad_alloc. Cost: O(V + T).
PeeledSurface peel(const TetMesh& mesh, std::span<const Face> border, std::span<const char> keep);

}  // namespace geotherm
