// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "geotherm/accuracy.h"
#include "geotherm/error.h"
#include "solver/distributed/mesh_block.h"

namespace geotherm {

/// Near-exact distances, and how they were found.
struct SharedWaves {
  std::vector<double> distances;  ///< of own vertices of the part, in MeshPart::unit
  Quality quality;                ///< slopes alone
  int rounds = 0;                 ///< exchanges between blocks
  double visits = 0;              ///< of edges, of all ranks
};

/// The method wavefront over the blocks of all ranks. Each block holds the faces at its own
/// vertices, with an intrinsic Delaunay triangulation that is the same in all blocks. Bands of
/// distances follow each other: every block runs its waves to the end of the band; what fell at
/// vertices and edges that several blocks have goes to the block that owns it and from there to the
/// others, where edges wait again, until nothing waits in the band. So every face is crossed with
/// the least values that any block knows, as in one process, but in another order within a band:
/// distances differ by up to 1e-3 of the largest, less than the method's error. One block gives the
/// bits of one process.
/// `is_source`: of each vertex of the part. `band`: in MeshPart::unit. Errors (the same on all
/// ranks): kBudgetEnded (distances fall without end). All ranks call it. Precondition: blocks are
/// flipped and have their whole surface.
Result<SharedWaves> wave_over_ranks(const RankGroup& ranks, const MeshPart& part,
                                    std::span<const MeshBlock> blocks,
                                    std::span<const char> is_source, double band);

/// How far distances of own vertices are from near-exact ones, over all ranks, without values and
/// histogram. `milliseconds`: that the waves took. All ranks call it.
AccuracyReport hold_over_ranks(const RankGroup& ranks, const MeshPart& part,
                               std::span<const double> distances, std::span<const double> waves,
                               double milliseconds);

/// The same of waves that may have failed, or where blocks are not `flipped` were not run.
AccuracyReport verdict_over_ranks(const RankGroup& ranks, const MeshPart& part, bool flipped,
                                  std::span<const double> distances,
                                  const Result<SharedWaves>& waves, double milliseconds);

}  // namespace geotherm
