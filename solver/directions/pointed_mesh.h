// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "geotherm/mesh.h"

namespace geotherm {

/// A mesh of which given points are vertices: faces that hold them are cut, and the surface stays
/// the same. Its first vertices and uncut faces are those of the mesh.
struct PointedMesh {
  std::shared_ptr<const TriangleMesh> mesh;  ///< the given one where all points are vertices
  std::vector<Index> vertices;               ///< of the points, in their order

  /// The same point on the given mesh.
  SurfacePoint out_of(const SurfacePoint& point) const;

  /// Where the corners of cut faces and the vertices that were added lie on the given mesh.
  using Weights = std::array<double, 3>;
  std::vector<Index> parents;                   ///< of all faces; empty where none was cut
  std::vector<std::array<Weights, 3>> corners;  ///< the same, by weights in the parent
  std::vector<SurfacePoint> added;              ///< of vertices beyond the given ones
  Index given_vertices = 0;                     ///< so many are the given mesh's
};

/// Preconditions: the points lie on the mesh. Errors: those of TriangleMesh::build(). Cost: O(F)
/// where a point is none of the vertices, and again for each on an edge.
Result<PointedMesh> pointed_mesh(const std::shared_ptr<const TriangleMesh>& mesh,
                                 std::span<const SurfacePoint> points);

}  // namespace geotherm
