// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "solver/geometry/intrinsic_mesh.h"

namespace geotherm {

/// How many vertices of a component are worth walking over; 0: none.
std::size_t near_count(std::size_t sources, double faces);

/// A vertex at a distance from the sources.
struct NearDistance {
  Index vertex;
  double distance;
};

/// The `count` vertices nearest to the seeds, ascending, with their distances: by marching over
/// faces, each of which takes the source back from the distances at two corners and sees the third
/// from there, where the straight line passes between the two (Novotni, Klein 2002), and along
/// edges elsewhere. A vertex that gets a shorter way later passes it on. In a plane that is exact,
/// but at vertices whose shortest way leads between two of which one is farther than the last.
/// `corners`: of `faces`. Cost: O(count log count) on Delaunay triangles, whatever the mesh has.
std::vector<NearDistance> march_nearest(const CornerTable& corners, std::span<const Face> faces,
                                        std::span<const FaceLayout> layout,
                                        std::span<const NearDistance> seeds, std::size_t count);

/// The share of heat's distance in the answer at a vertex, where the farthest that was walked to
/// is at `limit`: 0 up to half of that, 1 there.
double share_of_heat(double distance, double limit);

}  // namespace geotherm
