// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "geotherm/error.h"
#include "geotherm/types.h"

// Spaces other than triangle meshes. The heat method needs of a space a mass, a stiffness and the
// gradient of a field on each cell (Crane, Weischedel, Wardetzky 2013, section 3.2): a CellComplex
// states these. docs/adding_a_domain.md makes one.
namespace geotherm {

/// A space cut into cells. A cell joins k vertices, which may be another number in each, and gives
/// the values on them one gradient of D numbers, in a frame of its own. The stiffness of a cell is
/// measure times G' G, G its D x k gradients; its mass goes to its vertices in equal shares.
struct CellComplex {
  Index vertices = 0;               ///< V
  int dimension = 0;                ///< D: 1, 2 or 3
  std::vector<std::int64_t> start;  ///< C + 1: cell c has the corners start[c] to start[c + 1]
  std::vector<Index> corners;       ///< of all cells, one after the other; a cell's are different
  std::vector<double> gradients;    ///< D to a corner: of its hat function, 1 / model units
  std::vector<double> measures;     ///< C: lengths, areas or volumes, > 0
  std::vector<double> widths;       ///< C: the mean length of the cell's edges, > 0; t follows them
  /// What is added to a cell's G' G times measure, to hold what its gradient does not see: for each
  /// cell the lower triangle of a k x k matrix by rows, positive semidefinite, rows summing to 0.
  /// Empty: nothing.
  std::vector<double> stabilizers;
  std::vector<char> on_boundary;  ///< V: what the boundary rules hold; empty: none
  /// V, model units; empty where the vertices lie nowhere. Elimination orders are better with them.
  std::vector<Vec3> positions;
  /// No way is shorter than the straight line between `positions`: a query counts the distances
  /// below it.
  bool lengths_are_straight = true;
  std::string cell_name = "cell", cells_name = "cells";  ///< in messages

  Index cell_count() const { return static_cast<Index>(measures.size()); }
  std::span<const Index> corners_of(Index cell) const {
    const auto c = static_cast<std::size_t>(cell);
    return {corners.data() + start[c], corners.data() + start[c + 1]};
  }
};

/// Whether the arrays fit together. Errors (kBadInput, with the numbers): sizes that do not, no
/// cell, a corner out of range or twice in a cell, gradients that are not finite or do not sum to
/// 0, measures or widths that are not above 0, positions that are not finite. Cost: one pass.
Result<void> check_cells(const CellComplex& cells);

/// Vertices joined by edges with lengths, in model units: roads, pipes, a skeleton. Distance runs
/// along the edges.
struct Graph {
  struct Edge {
    Index from = kNoIndex, to = kNoIndex;
    double length = 0;  ///< > 0
  };
  Index vertices = 0;
  std::vector<Edge> edges;
};

/// A graph as a space of one dimension: each edge is a cell. Errors (kBadInput, with the number):
/// no edge, an end out of range, both ends the same, a length that is not above 0. Cost: one pass.
Result<CellComplex> cells_of(const Graph& graph);

/// Faces with any number of corners, as modelling programs write them: V vertices, faces one after
/// the other. They may be concave, and need not be planar; nothing cuts them into triangles.
struct PolygonMesh {
  std::vector<Vec3> positions;       ///< V, model units
  std::vector<std::int64_t> start;   ///< faces + 1: face f has the corners start[f] to start[f + 1]
  std::vector<Index> corners;        ///< round each face
};

/// Cells, and one sentence for each kind of thing that had to be left out.
struct MadeCells {
  CellComplex cells;
  std::vector<Warning> notes;
};

/// A polygon mesh as a space of two dimensions: the gradient of a face is that of its boundary
/// values in the plane of its vector area, and what that does not see is held by the stabilizer of
/// de Goes, Butts, Desbrun 2020 (equation 20, lambda = 1). Cells are the faces that were not left
/// out, in order: those without area, with fewer than three corners or with one twice. Errors
/// (kBadInput, with the number): a corner out of range, a coordinate that is not finite, no face
/// that can be used. Cost: one pass.
Result<MadeCells> cells_of(const PolygonMesh& mesh);

/// Samples in a box, such as the pixels of an image or the voxels of a scan.
struct Grid {
  std::array<Index, 3> size = {1, 1, 1};  ///< samples along x, y and z; 1 along z in two dimensions
  std::array<double, 3> spacing = {1, 1, 1};  ///< between samples, model units, > 0
  Vec3 origin = Vec3::Zero();                 ///< of sample (0, 0, 0)
  /// For each sample, x fastest: the speed with which distance is travelled there, so that the
  /// answer is travel time; 0 where nothing passes. Empty: 1 everywhere.
  std::vector<double> speeds;
};

/// A grid as a space: vertices are samples, numbered with x fastest, cells the squares or cubes
/// between samples that pass, and the edges that lie in none of these, so that corridors one sample
/// wide connect. Bilinear (trilinear) elements; their gradient is that at the middle. The speed of a
/// cell is the harmonic mean of its corners'. Errors (kBadInput, with the numbers): sizes that are
/// not positive or do not fit the speeds, a speed that is negative or not finite, nothing that
/// passes. Cost: one pass; 0.5 kB a cube.
Result<CellComplex> cells_of(const Grid& grid);

}  // namespace geotherm
