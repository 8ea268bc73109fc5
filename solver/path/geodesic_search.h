// SPDX-License-Identifier: MIT
#pragma once

#include "solver/core/progress.h"
#include "solver/core/result.h"
#include "solver/path/crossing_graph.h"
#include "solver/path/path_surface.h"
#include "solver/path/surface_path.h"

namespace geotherm {

/// The shortest path that is found from one point to the other, from several starts: the shortest
/// path along edges, the streamlines of both distances, those through vertices whose distances say
/// that there may be a shorter path, and the shortest paths of a CrossingGraph, which need pass
/// near no vertex. Never longer than the path along edges. Nothing proves that it is the shortest
/// of all; docs/paths.md has the measured rate. Errors: kOutOfMemory, those of shorten() and
/// trace_streamline().
Result<SurfacePath> search_geodesic(const PathSurface& surface, const GeodesicEnds& ends,
                                    const Progress& progress = {});

}  // namespace geotherm
