// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>
#include <vector>

#include "geotherm/error.h"
#include "geotherm/mesh.h"
#include "geotherm/progress.h"

namespace geotherm {

/// Fewest and most faces that a model can be asked for.
inline constexpr Index kMinModelFaces = 500;
inline constexpr Index kMaxModelFaces = 5'000'000;

/// Makes a bundled model (terrain, sleeve, cube, gargoyle or bunny) of about `faces` faces (within
/// 3 % from 2,000 on). Each is an oriented manifold with exactly one component and no degenerate
/// faces, the same on every run. Y is up, creatures face +Z, outside is where the faces run
/// counter-clockwise; all fit into a box about 2 to 3 units wide. `terrain` has one boundary loop,
/// `sleeve` two, the others none. Cost: linear in `faces`. Errors: an unknown name (kNotAvailable;
/// the message lists the names), a size outside the limits (kBadInput), kCancelled.
Result<TriangleMesh> generate_model(std::string_view name, Index faces,
                                    const Progress& progress = {});

/// V x 3: the vertices of a mesh through which a wave runs along the longest side of its box, as
/// long as that; `phase` (radians) says how far it has come, and 2 pi is the beginning again. What
/// lies side by side is sheared, so that no face folds. A small animation for documentation, tests
/// and benchmark. Cost: O(V).
std::vector<Vec3> waving(const TriangleMesh& mesh, double phase);

}  // namespace geotherm
