// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "geotherm/distance_method.h"
#include "geotherm/domains.h"

namespace geotherm {

/// Fast marching in a volume as a DistanceMethod, what heat is held against there: exact wherever a
/// vertex sees its source along a straight line, and fast marching where the way bends round a
/// border. Sources are vertices, with offsets, and points of tets; nearest sources are known.
///
/// A vertex has the straight line's length where its source is a corner of one of its tets, or
/// where the line to the source leaves one of its tets through a face whose corners (those that
/// weigh at the crossing) have it from the same source. In a convex volume that is every vertex. It
/// can be too short only behind a hole that is narrower than one face in its shadow. A straight
/// re-entrant edge of the border that sees the source is one of its own for what lies behind it.
/// Elsewhere a
/// vertex has the least that the planes through the distances of the other corners of its tets give
/// (updated_distance()), of first order in the edge length. A vertex that became nearer is looked
/// at again, in the order of distance, until nothing changes: obtuse tets, whose fronts arrive in
/// no order, need no other care.
///
/// Sources: Kimmel, Sethian 1998; Bornemann, Rasch 2006; Fu, Kirby, Whitaker 2013 (tetrahedra).
///
/// `straight_reach`: straight lines up to this distance from their source, model units, which shows
/// how planes alone converge. Some edges around a point source must be exact, for the front is bent
/// there; 0: only the tets that touch the source. Errors: kBadInput (no tet with a volume); of a
/// query also kBudgetEnded. Cost: O(V + T), some 35 bytes a tet; of a query O(T log V), some
/// microseconds a vertex; of up to 8 sources each is followed everywhere. Throws std::bad_alloc.
Result<std::shared_ptr<const DistanceMethod>> build_tet_marching(
    std::shared_ptr<const TetMesh> mesh, int threads, const Progress& progress = {},
    double straight_reach = kUnreached);

}  // namespace geotherm
