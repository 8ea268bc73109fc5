// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "geotherm/build_method.h"
#include "geotherm/distance_method.h"
#include "solver/distributed/mesh_block.h"
#include "solver/distributed/shared_heat.h"

// What a person should know of a mesh over ranks and of its distances. All ranks call these.
namespace geotherm {

/// How the mesh was taken, one sentence each: faces left out, edges lengthened, and where one
/// process would have inserted vertices or made a cover. Precondition: blocks and part have their
/// faces still. `repeated`: faces of this rank's slice that repeat a corner.
std::vector<Warning> notes_of(const RankGroup& ranks, const MeshPart& part,
                              const SharedComponents& components, std::span<const MeshBlock> blocks,
                              const MethodOptions& options, double repeated);

/// A source vertex, as all ranks know it.
struct SharedSource {
  GlobalIndex id;
  Index component;
  double x, y, z;  ///< in MeshPart::unit

  Vec3 place() const { return {x, y, z}; }
};
std::vector<SharedSource> sources_of(const SharedTask& task);

/// Holds the distances of own vertices (`result.distances`, in MeshPart::unit) against the straight
/// lines from the sources, and raises what is below where the method is not the published one; the
/// figures are those of all ranks, clamped_reach in model units.
void check_lines(const SharedTask& task, std::span<const SharedSource> sources,
                 DistanceResult& result);

}  // namespace geotherm
