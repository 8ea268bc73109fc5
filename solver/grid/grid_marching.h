// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "geotherm/distance_method.h"
#include "geotherm/domains.h"
#include "solver/geometry/grid_mesh.h"

namespace geotherm {

/// Fast marching on a grid as a DistanceMethod: what heat is held against there.
///
/// Upwind (Sethian 1999; Rickett, Fomel 1999): each sample takes the slopes from its nearest
/// neighbours in one cell, of second order where the next neighbour is known, too; where there is
/// no cell, the way along an edge. A sample that sees its source in a straight line, through cells
/// of one speed, has that line's length, or less by way of faster samples. Sources are samples and
/// points of cells, with offsets; nearest sources are known. Errors: those of check_grid(). Cost:
/// O(V log V), 20 bytes a sample, of several sources some times as long, and 36.
Result<std::shared_ptr<const DistanceMethod>> build_grid_marching(std::shared_ptr<const Grid> grid,
                                                                  int threads,
                                                                  const Progress& progress = {});

/// Whether a point is in a cell, whose number is that of its lowest corner, and its weights are as
/// check_weights() has them. Errors: kBadInput.
Result<void> check_cell_point(const GridLattice& lattice, const CellPoint& point);

/// Distance of a sample, model units.
struct NearSample {
  Index sample;
  double distance;
};

/// The samples up to this far from samples and points of cells, by the same marching, the nearest
/// first. Precondition: the sources are valid. Cost: that of these samples, and 13 bytes of each in
/// the grid.
std::vector<NearSample> march_near(const GridLattice& lattice, std::span<const Index> samples,
                                   std::span<const CellPoint> points, double reach);

}  // namespace geotherm
