// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "geotherm/mesh_report.h"
#include "solver/geometry/clean_faces.h"

namespace geotherm {

/// Lengthens edges until every triangle inequality is strict by 1e-5 of the face's longest side
/// (the condition of Sharp, Crane 2020, section 4.5, where one length is added to all edges). Here
/// only edges of faces that fail are lengthened, the shorter ones of the face, and those of
/// neighbours that fail because of it: a degenerate face leaves no trace a few faces away. Where
/// this has no end within a hundred rounds, the smallest common length that does it is
/// added to all edges of the component.
///
/// `lengths`: F x 3, the same for all sides of an edge, in units of about their mean.
/// Cost: O(F), and a few visits of each failing face.
Mollification mollify(std::vector<std::array<double, 3>>& lengths, const CleanFaces& clean,
                      int threads = 1);

}  // namespace geotherm
