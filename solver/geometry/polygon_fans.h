// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "geotherm/domains.h"
#include "solver/geometry/intrinsic_mesh.h"
#include "solver/linear/symmetric_pattern.h"

namespace geotherm {

/// Whether the triangles between the sides of a face and its virtual vertex are the face: all are
/// turned to the side that their sum is.
bool sees_all_sides(std::span<const Vec3> corners, const Vec3& virtual_vertex);

/// The lengths of the sides of the triangle a, b, c: from a to b, from b to c, from c to a.
inline std::array<double, 3> side_lengths(const Vec3& a, const Vec3& b, const Vec3& c) {
  return {(b - a).norm(), (c - b).norm(), (a - c).norm()};
}

/// The longest side of a triangle is shorter than the two others by this share of it at least, or
/// the rounding of lengths would decide its angles.
constexpr double kFlatTriangle = 1e-5;
bool is_flat_triangle(const std::array<double, 3>& lengths);

/// Whether a cell of a polygon is one of the triangles that its face was cut into, or a triangle.
inline bool is_cut(const CellComplex& given, Index cell) {
  return given.corners_of(cell).size() == 3 || !given.virtual_vertices[cell].allFinite();
}

/// Where the corners of such a triangle stand among those of its face, ascending: the others have
/// the gradient 0 there. Empty where they are not three.
std::vector<std::size_t> cut_corners(const CellComplex& given, Index cell);

/// The triangles of polygons as one intrinsic mesh: those at virtual vertices where these are the
/// face, or those that it was cut into. A face that neither are has none. Edges of triangles that
/// are nearly flat are lengthened (mollify()). The virtual vertex of face i has the number V + i.
struct PolygonFans {
  std::vector<Index> first_cell;  ///< F + 1: the cells of face i are those from first_cell[i] on
  std::vector<Index> first;       ///< F + 1: the triangles of face i, in the order of its cells
  /// A side at a face that has no triangles, or at an edge that is no oriented manifold, is its own
  /// twin: neither a flip nor a split passes it.
  IntrinsicMesh mesh;
  std::vector<Side> walls;            ///< sides at a face without triangles
  std::vector<Side> folds;            ///< the others at an edge that is no oriented manifold
  Components parts;                   ///< of the vertices that are in a cell
  std::vector<char> is_not_manifold;  ///< of each part: it has such an edge

  Index face_count() const { return static_cast<Index>(first.size()) - 1; }
  bool has_triangles(Index face) const { return first[face + 1] > first[face]; }
};

/// Precondition: polygons with virtual vertices. Lengths are in units of `unit`. Cost: O(corners),
/// squared of each face that was cut.
PolygonFans build_fans(const CellComplex& given, double unit, int threads);

/// The parts of the vertices, and which of these need a cover. Cost: O(corners).
void find_parts(const CellComplex& given, PolygonFans& fans);

/// Makes the tufted cover of the parts with an edge that is no oriented manifold. `places`: of the
/// V and F vertices. False where there is no such part. Precondition: find_parts(), no flips. Cost:
/// O(corners).
bool cover_fans(std::span<const Vec3> places, PolygonFans& fans, int threads);

}  // namespace geotherm
