// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "solver/core/types.h"
#include "solver/mesh/surface_point.h"
#include "solver/mesh/triangle_mesh.h"

namespace geotherm {

/// A polyline on the surface. Two points that follow each other lie in a common face.
struct SurfacePath {
  std::vector<SurfacePoint>
      points;                ///< n, of the mesh of the file; a closed path repeats its first
  std::vector<Index> faces;  ///< n - 1: the face (of the file) that holds each piece
  double length = 0;         ///< model units
  bool closed = false;
};

/// Where a point of the mesh lies, model units. Precondition: it lies on the mesh.
Vec3 position_at(const TriangleMesh& mesh, const SurfacePoint& point);

/// The points as weights in a face each: that of the piece that begins there, the last one in that
/// of the last piece. A path of one vertex takes the first face that has it; one of a vertex in no
/// face stays bare.
std::vector<SurfacePoint> points_in_faces(const TriangleMesh& mesh, const SurfacePath& path);

/// Positions of the points, model units.
std::vector<Vec3> positions_of(const TriangleMesh& mesh, const SurfacePath& path);

/// Sum of the lengths of the pieces, model units.
double length_of(const TriangleMesh& mesh, const std::vector<SurfacePoint>& points);

/// The same path from its end to its start.
SurfacePath reversed(SurfacePath path);

/// Appends a path that begins where the other ends, if that has points.
void append(SurfacePath& path, const SurfacePath& next);

}  // namespace geotherm
