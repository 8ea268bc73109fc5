// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "solver/linear/separator.h"

namespace geotherm {

/// Separators that planes leave: of each direction the plane of least cost, size times imbalance(),
/// that has a quarter of the vertices on each side at least, those of the separator included.
/// `most` directions at most, best first; none where no plane keeps the balance. The directions are
/// the axes and the diagonals between two of them, without those along which the part is thin, and
/// without the shortest diagonal where none is. The result does not depend on `threads`. Cost: one
/// pass over the edges, one over the vertices for each direction; 48 bytes a vertex.
std::vector<Separator> plane_cuts(const GraphPart& part, int most, int threads);

}  // namespace geotherm
