// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "solver/distributed/mesh_block.h"
#include "solver/distributed/shared_heat.h"
#include "solver/distributed/shared_notes.h"

namespace geotherm {

/// Puts near-exact distances around the sources in the place of heat's, as one process does
/// (march_nearest()): the faces around the sources come to all ranks, which march over them alike.
/// `distances`: of own vertices, in MeshPart::unit. Cost: two or three exchanges for each component
/// that holds a source, of some hundreds of faces a source. All ranks call it.
void add_near_field(const SharedTask& task, std::span<const MeshBlock> blocks,
                    std::span<const SharedSource> sources, std::span<double> distances);

}  // namespace geotherm
