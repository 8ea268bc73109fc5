// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "geotherm/distance_method.h"
#include "geotherm/options.h"
#include "solver/distributed/mesh_block.h"
#include "solver/heat/unit_field.h"

namespace geotherm {

/// What all ranks know of one solve.
struct SharedTask {
  const RankGroup& ranks;
  const MeshPart& part;
  const SharedComponents& components;
  const DiffusionTimes& times;  ///< of the components, in MeshPart::unit
  const HeatOptions& options;
  std::span<const char> is_source;  ///< of each vertex of the part
  std::vector<char> reached;        ///< of each component: it holds a source
  int threads = 1;
};

/// u of the heat step, and how it was found.
struct SharedHeat {
  std::vector<WideNumber> u;  ///< of own vertices of the part, and those of `beside`
  int rounds = 0;             ///< until no block heard anything new
  double residual = 0;        ///< |M u - b| / |b|, as Quality::heat_residual
  double row_residual = 0;    ///< the largest |M u - b|_i / (M_ii u_i)
  std::vector<Index> beside;  ///< vertices that others own and share a face with an own one
  std::vector<FaceField::Extent> extent;  ///< of each component, in MeshPart::unit
};

/// Makes the factors of all blocks. Errors (the same on all ranks): the backend's.
Result<void> factorise_blocks(const SharedTask& task, std::vector<MeshBlock>& blocks);

/// Restricted additive Schwarz (Cai, Sarkis 1999): in each round the blocks that heard something
/// new at their edge solve for their own vertices and the rings around, others' values held beyond.
/// Heat falls by e over about each ring, so that it takes few rounds, and numbers have exponents of
/// their own: the far field is right to the last row, which is checked. Errors (the same on all
/// ranks): kNumericalFailure (rounds without end, a row that is off by more than 1e-4).
Result<SharedHeat> diffuse_over_ranks(const SharedTask& task, std::span<const MeshBlock> blocks);

/// The sources in a block, where it has any on its surface.
SourceAnchors anchors_in(const SharedTask& task, const MeshBlock& block);

/// What a block's surface is still asked for once its sources are placed: faces in their order,
/// without the mesh that they came from. `analysis`: with what a factor is made by.
std::shared_ptr<const Surface> faces_alone(const Surface& surface, bool analysis);

/// X of a block, as FaceField has it, for its own vertices.
struct BlockField {
  HeatField heat;
  PerComponent t = 0;                     ///< in squares of the block's unit; 0: |X| = 1
  std::vector<FaceField::Extent> extent;  ///< of its components, in the block's unit
};
BlockField field_of(const SharedTask& task, const SharedHeat& heat, const MeshBlock& block);

}  // namespace geotherm
