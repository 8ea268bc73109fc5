// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "geotherm/distance_method.h"
#include "geotherm/domains.h"

namespace geotherm {

/// Fast marching on a grid as a DistanceMethod: what heat is held against there.
///
/// Second order upwind (Sethian 1999; Rickett, Fomel 1999): each sample takes the slopes from its
/// nearest neighbours in one cell, of second order where the next neighbour is known, too; where
/// there is no cell, the way along an edge. A sample that sees its source in a straight line,
/// through cells of one speed, has the exact distance. Sources are samples and points of cells,
/// with offsets; nearest sources are known. Errors: those of check_grid(). Cost: O(V log V), 15
/// bytes a sample.
Result<std::shared_ptr<const DistanceMethod>> build_grid_marching(std::shared_ptr<const Grid> grid,
                                                                  int threads,
                                                                  const Progress& progress = {});

}  // namespace geotherm
