// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "geotherm/mesh.h"
#include "geotherm/types.h"
#include "solver/mesh/connectivity.h"

namespace geotherm {

/// The faces that can carry an operator, and what was left out.
struct CleanFaces {
  std::vector<Face> faces;        ///< no repeated corner, no face twice; orientation as consistent
                                  ///< as the surface allows
  std::vector<Index> original;    ///< number of each face in the mesh
  CornerTable corners;            ///< of `faces`
  EdgeTable edges;                ///< of `faces`
  Index repeated_corner = 0;      ///< faces dropped: two corners are one vertex
  Index one_vertex = 0;           ///< of them: all corners are, as masked() leaves faces
  Index duplicate = 0;            ///< faces dropped: the same three vertices as an earlier one
  bool oriented_manifold = true;  ///< every edge has one face, or two that agree in orientation
  Index reoriented = 0;           ///< faces turned round to agree with their neighbours
  bool turned_by_shape = false;   ///< which ones depends on where the vertices are, too
};

/// Whether two faces agree in orientation where they share an edge: the sides run opposite ways.
inline bool sides_agree(const std::vector<Face>& faces, Side a, Side b) {
  return faces[face_of(a)][corner_of(a)] != faces[face_of(b)][corner_of(b)];
}

/// Cost: O(F).
CleanFaces clean_faces(const TriangleMesh& mesh, int threads = 1);

/// Which faces hang together through shared vertices: distances never pass between components.
struct FaceComponents {
  std::vector<Index> of;  ///< F: number of the face's component, by first appearance
  Index count = 0;
};

/// Precondition: corners are below `vertex_count`. Cost: O(V + F).
FaceComponents face_components(std::span<const Face> faces, Index vertex_count);

/// Cracks of a surface: edges of its boundary that lie on each other, or a small share of the mean
/// edge apart, and what weld() would do about them.
struct CrackReport {
  Index vertices = 0;        ///< that would be merged, WeldedMesh::merged; 0: there are no cracks
  double distance = 0;       ///< that merges them, model units, one digit; 0: they are equal
  Index boundary_edges = 0;  ///< edges with one face
  Index closed_edges = 0;    ///< those of them that would have two faces or more
};

/// A distance up to a hundredth of the mean edge is tried, the smallest that closes the most
/// counts; one that makes a face collapse does not, but for faces that have two corners at one
/// place already. Cost: four times weld() and clean_faces().
CrackReport find_cracks(const TriangleMesh& mesh);

}  // namespace geotherm
