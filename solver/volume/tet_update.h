// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "geotherm/types.h"

namespace geotherm {

/// A corner of a tet as another corner sees it: where it is, seen from there, and its distance.
struct KnownCorner {
  Vec3 offset;       ///< from the corner that is asked about, model units
  double value = 0;  ///< distance there; kUnreached: not known
};

/// The distance at one corner of a tet (the origin) from those at the other three: the least of
/// value(x) + |x| over the points x of the face that these span, with the value linear on the face
/// (Bornemann, Rasch 2006: the Hopf-Lax formula; the solution is that of the front plane of Kimmel
/// and Sethian 1998 where its direction comes through the face, and of the formulas on the face's
/// edges and at its corners where it does not). Corners that are not known are left out: the face
/// becomes an edge or a corner. Never below the distance from the least of the values; exact where
/// the distance is linear. Flat and obtuse tets are as good as any. kUnreached where no corner is
/// known. Cost: some hundred operations.
double updated_distance(const std::array<KnownCorner, 3>& known);

/// Where the straight line from a corner of a tet to a point outside crosses the opposite face.
struct FaceCrossing {
  bool crosses = false;
  std::array<double, 3> weights{};  ///< of the face's corners; 0 where below round-off
};

/// `corners`: of the face, and `target`: the point, all as seen from the corner. Weights below some
/// round-off count as 0, so that lines through edges and corners cross.
FaceCrossing cross_face(const std::array<Vec3, 3>& corners, const Vec3& target);

}  // namespace geotherm
