// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "solver/core/progress.h"
#include "solver/core/result.h"
#include "solver/core/types.h"
#include "solver/geometry/intrinsic_mesh.h"
#include "solver/mesh/surface_point.h"

namespace geotherm {

/// One intrinsic edge flip, kept so that points can be carried from the mesh's faces to the
/// flipped ones. Before: face f = (a, b, c) starting at its corner `start_f`, face g = (b, a, d)
/// starting at `start_g`. After: f = (c, a, d), g = (d, b, c).
struct Flip {
  Index f, g;
  std::int8_t start_f, start_g;
  std::array<double, 5> lengths;  ///< ab, bc, ca, ad, db
};

/// Number of edges whose cotangent weight is negative, that is, which are not Delaunay
/// (Bobenko, Springborn 2007). Edges without twins do not count. Cost: O(F).
Index count_non_delaunay(const IntrinsicMesh& mesh, int threads = 1);

/// The lower side of each of these edges, ascending.
std::vector<Side> non_delaunay_sides(const IntrinsicMesh& mesh, int threads = 1);

/// Flips edges until every edge with twins is Delaunay; lengths change, the surface does not.
/// Faces may afterwards share two sides or visit a vertex twice; the operators allow it.
/// Cost: O(F + flips). Source: Bobenko, Springborn 2007; Fisher, Springborn, Schroeder, Bobenko
/// 2006. Precondition: triangle inequalities are strict. Error: kCancelled, with the mesh valid and
/// some of the flips made.
Result<std::vector<Flip>> flip_to_delaunay(IntrinsicMesh& mesh, const Progress& progress = {});

/// The same where its non_delaunay_sides() are known. Cost: O(flips).
Result<std::vector<Flip>> flip_to_delaunay(IntrinsicMesh& mesh, std::vector<Side> sides,
                                           const Progress& progress = {});

/// Carries a point of the unflipped mesh (face numbers before the flips) to the face and weights
/// it has after them. Cost: O(flips), a few nanoseconds each.
SurfacePoint carry_through_flips(const std::vector<Flip>& flips, SurfacePoint point);

}  // namespace geotherm
