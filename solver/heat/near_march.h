// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "solver/geometry/intrinsic_mesh.h"

namespace geotherm {

/// How many vertices of a component are worth walking over; 0: none.
std::size_t near_count(std::size_t sources, double faces);

/// A vertex at a distance from the sources.
struct NearDistance {
  std::int64_t vertex;
  double distance;
};

/// A triangle beside the sources, by numbers of its corners.
struct NearFace {
  std::array<std::int64_t, 3> corners;
  FaceLayout layout;
};
struct NearFaces {
  std::vector<NearFace> faces;
  bool are_all = false;  ///< of the component
};

/// The `count` vertices nearest to the seeds, ascending, with their distances: by marching over
/// faces, each of which takes the source back from the distances at two corners and sees the third
/// from there, where the straight line passes between the two (Novotni, Klein 2002), and along
/// edges elsewhere. From one seed in a plane that is exact, but at vertices whose shortest way
/// leads between two of which one is farther than the last. `corners`: of `faces`. Cost: O(count
/// log count) on Delaunay triangles, whatever the mesh has.
std::vector<NearDistance> march_nearest(const CornerTable& corners, std::span<const Face> faces,
                                        std::span<const FaceLayout> layout,
                                        std::span<const NearDistance> seeds, std::size_t count);

/// The same over faces that are fetched: `within(r)` are those with a corner up to r from a seed
/// along the straight line, which is no longer than any way, and those of the seeds; a march does
/// not mind some twice. `mean_edge`: guesses the first r. Cost: that of two marches or so.
std::vector<NearDistance> march_around(std::span<const NearDistance> seeds, std::size_t count,
                                       double mean_edge,
                                       const std::function<NearFaces(double reach)>& within);

/// The share of heat's distance in the answer at a vertex, where the farthest that was walked to
/// is at `limit`: 0 up to half of that, 1 there. 1 where that is a source.
double share_of_heat(double distance, double limit);

}  // namespace geotherm
