// SPDX-License-Identifier: MIT
#pragma once

#include "bench/models/draft_mesh.h"
#include "geotherm/error.h"
#include "geotherm/progress.h"

namespace geotherm::generate {

// Each makes its model with about `faces` faces (at least 500). Y is up, creatures face +Z.
// Error: kCancelled.

/// Mountains cut by rivers over the square [-1, 1]^2 of x and z; one boundary loop.
Result<DraftMesh> make_terrain(Index faces, const Progress& progress);
/// A bent garment sleeve, shoulder up; two boundary loops.
Result<DraftMesh> make_sleeve(Index faces, const Progress& progress);
/// The cube [-1, 1]^3, closed, with exact edges and corners.
Result<DraftMesh> make_cube(Index faces, const Progress& progress);
/// A winged, horned creature that crouches on a plinth; closed.
Result<DraftMesh> make_gargoyle(Index faces, const Progress& progress);
/// A sitting rabbit; closed.
Result<DraftMesh> make_bunny(Index faces, const Progress& progress);

}  // namespace geotherm::generate
