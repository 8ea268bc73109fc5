// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "geotherm/accuracy.h"
#include "geotherm/distance_method.h"
#include "geotherm/options.h"
#include "geotherm/progress.h"
#include "solver/distributed/mesh_block.h"
#include "solver/distributed/rank_group.h"

namespace geotherm {

/// What one mesh over several ranks gives; the same on all of them but for `distances`.
struct SharedAnswer {
  /// Model units, kUnreached where no source is: of the share of the vertices, numbered as in the
  /// file, that share_begin() gives this rank.
  std::vector<double> distances;
  GlobalIndex vertices = 0, faces = 0;
  Index components = 0;
  double mean_edge = 0, area = 0;        ///< model units
  double t = 0, relative_t = 0;          ///< of the component with most faces
  double least = 0, most = 0, mean = 0;  ///< of the distances that are reached
  GlobalIndex unreached = 0, loose = 0;  ///< the latter are in no face
  Index flips = 0;  ///< of all blocks; those near their edges are made by several
  int blocks = 0, rings = 0, rounds = 0;
  double row_residual = 0;  ///< SharedHeat::row_residual
  double factor_mb = 0;     ///< of the heat step, the rank that has most
  Quality quality;
  std::optional<AccuracyReport> error;  ///< against wavefront; without values and histogram
  std::vector<Warning> warnings;
  double read_ms = 0, share_ms = 0, set_up_ms = 0;  ///< the slowest rank's
  QueryTiming timing;                               ///< likewise
};

/// Distances from vertices of a binary .ply of triangles that no rank holds as a whole. The heat
/// step is solved by blocks (shared_heat.h), the Poisson step by PETSc: conjugate gradients with
/// BoomerAMG, phi = 0 on every source; the answer is held against waves where `check` says so. The
/// method wavefront is shared_waves.h alone. `sources`: numbers in the file. The caller has refused
/// other methods, and of the options what is not the default, but for: time step, Laplacian (kAuto
/// is kIntrinsicDelaunay), variant, precision, threads. `most_of_block`: BlockRules::most. Errors,
/// the same on all ranks: kBadFile, kBadInput, kNumericalFailure. All ranks call it. Precondition:
/// MPI is started.
Result<SharedAnswer> solve_over_ranks(const RankGroup& ranks, const std::string& path,
                                      std::span<const GlobalIndex> sources,
                                      const MethodOptions& options, bool check,
                                      const Progress& progress = {},
                                      Index most_of_block = kMaxBlock);

}  // namespace geotherm
