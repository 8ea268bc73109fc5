// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "solver/core/progress.h"
#include "solver/core/result.h"
#include "solver/path/path_surface.h"
#include "solver/path/surface_path.h"

namespace geotherm {

/// Two points, and the distances of all vertices from each (V, file order, model units).
struct GeodesicEnds {
  SurfacePoint from, to;
  std::span<const double> from_distances, to_distances;
};

/// The shortest path that is found from one point to the other, from several starts: the shortest
/// path along edges, the streamlines of both distances, and, while distances say that there may be
/// a shorter one (their sum at a vertex is the length of the best path through it), the streamlines
/// from such vertices to both ends. Never longer than the path along edges; with distances as good
/// as those of wavefront waves it is the shortest of all but for rare ones, which are longer by
/// less than a thousandth. Errors: those of shorten() and trace_streamline().
Result<SurfacePath> search_geodesic(const PathSurface& surface, const GeodesicEnds& ends,
                                    const Progress& progress = {});

/// The same path from its end to its start.
SurfacePath reversed(SurfacePath path);

/// Appends a path that begins where the other ends, if that has points.
void append(SurfacePath& path, const SurfacePath& next);

}  // namespace geotherm
