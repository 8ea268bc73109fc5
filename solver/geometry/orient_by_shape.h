// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "solver/mesh/connectivity.h"

namespace geotherm {

/// Turns faces round so that neighbours agree where they can, on surfaces with one side, too, where
/// some edges stay in disagreement and stop flips. Edges that flips need most agree first (a
/// maximum spanning tree of the faces, Kruskal 1956, by the opposite cotangents): what is flipped,
/// and the turn of the whole, then follow from the shape and not from the numbering. `edges`: of
/// `faces`, whose sides it names; it is out of date afterwards. Cost: O(F log F).
void orient_by_shape(std::span<const Vec3> positions, std::vector<Face>& faces,
                     const EdgeTable& edges);

}  // namespace geotherm
