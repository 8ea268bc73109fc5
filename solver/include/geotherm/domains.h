// SPDX-License-Identifier: MIT
#pragma once

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
  /// V, model units; empty where the vertices lie nowhere. Elimination orders are better with them,
  /// and a query counts the distances below the straight line to the nearest source.
  std::vector<Vec3> positions;
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

}  // namespace geotherm
