// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "geotherm/geotherm.h"

namespace geotherm::test {

/// The unit square cut into n x n quads, of which each is bent out of the plane by `bend` of its
/// side. Corner (i, j) has the number i (n + 1) + j.
PolygonMesh quads(Index n, double bend = 0);

/// The same, flat, `stretch` times as long, inner corners moved at random by up to `most` of a
/// side.
PolygonMesh moved_quads(Index n, double stretch, double most);

/// A torus of 64 x 28 quads, none of them planar, corners moved at random by up to `most` of a
/// side.
PolygonMesh quad_torus(double most = 0);

/// Relative errors of heat from each of `sources`, added up over them and all vertices, on polygons
/// and on the triangles that triangulated() makes of them. `truth`: a method on these triangles.
struct PolygonErrors {
  double of_polygons = 0, of_triangles = 0;
};
PolygonErrors errors_beside_triangles(const PolygonMesh& polygons, MethodKind truth,
                                      std::span<const Index> sources);

}  // namespace geotherm::test
