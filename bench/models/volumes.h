// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "geotherm/domains.h"
#include "geotherm/error.h"

namespace geotherm {

/// Fewest and most tetrahedra that a volume can be asked for.
inline constexpr Index kMinVolumeTets = 100;
inline constexpr Index kMaxVolumeTets = 20'000'000;

/// The names of the volumes: box-tets, ball-tets.
std::vector<std::string> volume_names();
/// Whether it is one of them.
bool is_volume_name(std::string_view name);

/// Makes a volume of about so many tetrahedra, all positive, none flat, the same on every run:
/// `box-tets` is 2 x 1.5 x 1 (make_box_tets()), `ball-tets` has the radius 1 (make_ball_tets(); the
/// number of layers being whole, up to a tenth more or less from 20,000 on). Cost: linear in
/// `tets`. Errors: an unknown name (kNotAvailable), a size outside the limits (kBadInput).
Result<TetMesh> generate_volume(std::string_view name, Index tets);

/// A box from the origin to `size`, of nx x ny x nz cells, each cut into six tets round its
/// diagonal (Kuhn 1960): no dihedral angle above 90 degrees where the cells are cubes. Vertices run
/// along x, then y, then z. Preconditions: counts > 0, sizes > 0.
TetMesh make_box_tets(Index nx, Index ny, Index nz, const Vec3& size);

/// A ball of radius 1 around the origin, which is vertex 0: 20 layers^3 tets. An icosahedron's 20
/// sectors are cut into layers; layer k is what lies between the spheres of radius (k - 1)/layers
/// and k/layers, whose triangles are those of an icosahedron with k parts a side. No tet has two
/// faces on the border, so that none becomes a sliver there. Precondition: layers > 0.
TetMesh make_ball_tets(Index layers);

}  // namespace geotherm
