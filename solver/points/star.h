// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>
#include <vector>

#include "geotherm/types.h"
#include "solver/points/sorted_points.h"

namespace geotherm {

/// The neighbours of a point, in order of distance, with places relative to it in units of the
/// distance to the last.
struct Neighbourhood {
  struct Neighbour {
    Vec3 way;       ///< from the point
    double square;  ///< of its length
    Index number;
  };

  Index point = kNoIndex;
  int count = 0;
  double radius = 0;  ///< distance to the last neighbour, in units of the sorted points
  Neighbour all[NeighbourTree::kMaxNeighbours];

  std::span<Neighbour> neighbours() { return {all, static_cast<std::size_t>(count)}; }
  std::span<const Neighbour> neighbours() const { return {all, static_cast<std::size_t>(count)}; }
};

/// The `count` nearest neighbours, fewer where there are no more.
void find_neighbours(const NeighbourTree& tree, std::span<const Vec3> points, Index point,
                     int count, Neighbourhood& out);

/// A unit normal of the plane that fits the neighbours best, those near the point most. Where they
/// lie on one line it is one of those across. Precondition: at least one neighbour.
Vec3 fitted_normal(const Neighbourhood& around);

/// How far apart two sheets are among which the neighbours are shared out, in units of the
/// neighbourhood; 0 where their heights over the plane do not fall into two groups.
double sheet_gap(const Neighbourhood& around, const Vec3& normal);

/// The triangles that a point has in its tangent plane.
struct Star {
  std::vector<std::array<Index, 2>> triangles;  ///< the two other corners, counter-clockwise
  double height = 0;  ///< the largest of a corner over the plane, in units of the neighbourhood
};

/// The star of the point in the Delaunay triangulation, weighted by heights, of its neighbours in
/// the plane through it with this unit normal: the point's Voronoi cell in space is cut by the
/// plane, one neighbour after the other, until the others are too far away to cut it. A vertex of
/// the cell stands for the triangle of the point and the two neighbours whose sides meet there.
/// Circumradii above the neighbourhood's radius are left out: what lies beyond was not looked at.
///
/// Four points on a circle are triangulated the same from each of them, up to rounding: numbers of
/// points stand for tiny weights that decide. Cost: O(neighbours that are near times sides).
void find_star(const Neighbourhood& around, const Vec3& normal, Star& star);

}  // namespace geotherm
