// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "geotherm/mesh.h"

namespace geotherm::test {

/// Exact distances from a vertex by trying every strip of faces: the lengths of all straight lines
/// between vertices within strips that visit no face twice, and the shortest chains of them. Knows
/// nothing of windows, order or flips. Strips end where they are longer than every distance along
/// edges. Cost: exponential; for meshes of some dozens of faces. Faces without area are not
/// allowed.
std::vector<double> brute_force_distances(const TriangleMesh& mesh, Index source);

}  // namespace geotherm::test
