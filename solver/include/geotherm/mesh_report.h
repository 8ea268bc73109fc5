// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "geotherm/mesh.h"
#include "geotherm/types.h"

// What a mesh is and what is wrong with it, before anything is solved.
namespace geotherm {

/// What a mesh is, in a few numbers. Edges, components and lengths are those of the faces that
/// the operators are built on: faces that repeat a corner or another face are left out.
struct MeshSummary {
  Index vertices = 0, faces = 0;    ///< as in the file
  Index components = 0;             ///< sets of faces connected through shared vertices
  Index boundary_edges = 0;         ///< edges with one face
  Index nonmanifold_edges = 0;      ///< edges with three faces or more
  Index degenerate_faces = 0;       ///< repeated corner, or height below 1e-10 of the longest side
  Index unreferenced_vertices = 0;  ///< in none of the faces, nor is what stands for them
  double mean_edge_length = 0;      ///< model units
  double area = 0;                  ///< model units squared
};

/// What was added to edges of degenerate faces so that every triangle inequality is strict (Sharp,
/// Crane 2020, section 4.5); all 0 where no face needed it.
struct Mollification {
  double most = 0;       ///< the largest length added to an edge
  Index faces = 0;       ///< faces that were degenerate or nearly so
  Index edges = 0;       ///< edges that were lengthened
  Index components = 0;  ///< components (through shared vertices) that hold one of them
};

/// What is inserted into the triangulation, never into the mesh, so that it can carry the heat
/// method (LaplacianKind::kRefined).
struct RefinementCounts {
  Index large_faces = 0;      ///< faces that were too large for the diffusion
  Index obtuse_boundary = 0;  ///< boundary edges opposite an obtuse angle
  Index points = 0;           ///< inserted vertices, numbered from the mesh's vertex count on
  Index boundary_splits = 0;  ///< those of them that split a boundary edge
  bool complete = true;       ///< false: the limit on inserted vertices was reached
};

/// What a mesh is and what is wrong with it.
struct MeshReport : MeshSummary {
  Index edges = 0;                 ///< of the faces that are used
  Index edge_components = 0;       ///< sets of faces connected through shared edges
  Index boundary_loops = 0;        ///< connected pieces of the boundary; holes that touch are one
  Index nonmanifold_vertices = 0;  ///< vertices whose faces form more than one fan

  Index repeated_corner_faces = 0;        ///< of the degenerate faces those with a repeated corner
  Index one_vertex_faces = 0;             ///< of the latter those of one vertex, as masked() leaves
  Index duplicate_faces = 0;              ///< the same three vertices as an earlier face
  Index merged_vertices = 0;              ///< that another one stands for (TriangleMesh::same_as())
  Index duplicate_positions = 0;          ///< vertices that lie exactly where an earlier one does
  Index inconsistent_faces = 0;           ///< faces to be turned so that neighbours agree
  bool orientable = true;                 ///< after turning them, all neighbours agree
  Index non_delaunay_edges = 0;           ///< edges with a negative cotangent weight
  Index tufted_components = 0;            ///< that are no oriented manifold along all their edges
  Mollification mollified;                ///< added to edges where no flip is made, model units
  RefinementCounts refinement;            ///< what LaplacianKind::kAuto inserts
  std::int64_t euler_characteristic = 0;  ///< V - E + F, of what the faces use

  double shortest_edge = 0, longest_edge = 0;           ///< model units
  Vec3 box_min = Vec3::Zero(), box_max = Vec3::Zero();  ///< of the faces' vertices
  double smallest_angle = 0;                            ///< degrees
  double mean_quality = 0;  ///< mean of 4 sqrt(3) area / (sum of squared sides); 1: equilateral
};

/// 4 sqrt(3) area / (sum of squared sides): 1 for an equilateral triangle, 0 for one without area.
double triangle_quality(const std::array<Vec3, 3>& corners);

/// Summarises a mesh, with the same bits with any number of threads. Cost: O(F).
MeshSummary summarize_mesh(const TriangleMesh& mesh, int threads = 1);

/// Cost: O(F), several times that of the summary, and sorting the positions.
MeshReport inspect_mesh(const TriangleMesh& mesh);

}  // namespace geotherm
