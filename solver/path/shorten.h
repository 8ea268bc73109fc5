// SPDX-License-Identifier: MIT
#pragma once

#include "geotherm/error.h"
#include "geotherm/path.h"
#include "geotherm/progress.h"
#include "solver/path/path_surface.h"

namespace geotherm {

/// Shortens a path until no piece of it can be made shorter: straight across faces, and through a
/// vertex only where there are pi or more on every side (saddles, boundaries). Both ends stay; a
/// closed path is shortened all round and may end as a single point, of length 0. The result is a
/// locally shortest path, never longer than the given one, and the shortest of all where that was
/// near enough to it. Strips of faces are unfolded and pulled tight, and a vertex at which the path
/// bends is passed on its narrow side, each step making it shorter (Xin, Wang 2007, "Efficiently
/// determining a locally exact shortest path on polyhedral surfaces"). A closed path without a
/// vertex is the minimum of a convex function of the place where it is cut open. `start`: points
/// and faces of the file. Errors: kBadInput (no points, pieces outside of their faces),
/// kBudgetEnded, kCancelled, kOutOfMemory.
Result<SurfacePath> shorten(const PathSurface& surface, const SurfacePath& start,
                            bool search = false, const Progress& progress = {});

}  // namespace geotherm
