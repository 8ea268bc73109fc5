// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "geotherm/error.h"
#include "geotherm/progress.h"
#include "geotherm/types.h"
#include "solver/geometry/edit.h"
#include "solver/geometry/intrinsic_mesh.h"

namespace geotherm {

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
Result<std::vector<Edit>> flip_to_delaunay(IntrinsicMesh& mesh, const Progress& progress = {});

/// Flips to Delaunay where the non_delaunay_sides() are known already. Cost: O(flips).
Result<std::vector<Edit>> flip_to_delaunay(IntrinsicMesh& mesh, std::vector<Side> sides,
                                           const Progress& progress = {});

/// Flips edges from these sides on until they and what they touch are Delaunay, and appends the
/// flips to `edits`. False where more flips were needed than exact arithmetic could need.
bool restore_delaunay(IntrinsicMesh& mesh, std::vector<Side>& queue, std::vector<Edit>& edits);

/// Puts a new vertex on an edge, `share` (between 0 and 1) of the way along `side`; the one or two
/// faces at the edge are cut in two and stay flat, so that the surface stays what it is. The edits,
/// one a face, are appended. Returns the sides of the new faces opposite the vertex, whose edges
/// may no longer be Delaunay. Precondition: the two sides of the edge belong to different faces.
/// Cost: O(1).
std::vector<Side> split_side(IntrinsicMesh& mesh, Side side, double share, Index vertex,
                             std::vector<Edit>& edits);

/// The same within a face, at these barycentric weights, all above 0: the face is cut in three.
std::vector<Side> split_face(IntrinsicMesh& mesh, Index face, const std::array<double, 3>& weights,
                             Index vertex, std::vector<Edit>& edits);

}  // namespace geotherm
