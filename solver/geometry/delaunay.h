// SPDX-License-Identifier: MIT
#pragma once

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

/// The same where its non_delaunay_sides() are known. Cost: O(flips).
Result<std::vector<Edit>> flip_to_delaunay(IntrinsicMesh& mesh, std::vector<Side> sides,
                                           const Progress& progress = {});

/// Flips edges from these sides on until they and what they touch are Delaunay, and appends the
/// flips to `edits`. False where more flips were needed than exact arithmetic could need.
bool restore_delaunay(IntrinsicMesh& mesh, std::vector<Side>& queue, std::vector<Edit>& edits);

}  // namespace geotherm
