// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "geotherm/distance_method.h"
#include "solver/core/parallel.h"
#include "solver/distributed/shared_heat.h"
#include "solver/distributed/shared_solve.h"

// From the heat to the right side of the Poisson step, and from its answer to distances and what is
// to be said of them.
namespace geotherm {

/// The faces of a block after the heat step: their divergence, and figures at the end.
class BlockFaces {
 public:
  /// Keeps references to task and block, whose surface has its faces alone.
  BlockFaces(const SharedTask& task, const SharedHeat& heat, const MeshBlock& block,
             SourceAnchors anchors);

  /// Of own vertices, in MeshPart::unit.
  void add_divergence(std::vector<double>& b) const;

  struct Sums {
    CellCounts cells;
    Quality quality;
    double error = 0, area = 0;  ///< eikonal, by area
    double left = 0, given = 0;  ///< squares of L phi - b and of b
  };
  /// `phi`, `b`: of vertices of the part, in MeshPart::unit.
  Sums inspect(const std::vector<double>& phi, const std::vector<double>& b) const;

 private:
  const SharedTask& task_;
  const MeshBlock& block_;
  mutable BlockPool pool_;
  SourceAnchors anchors_;
  BlockField given_;
  FaceField field_;
};

/// Makes distances of phi, of own vertices, and their range, mean and counts in `out`. All ranks
/// call it.
std::vector<double> distances_of(const SharedTask& task, const std::vector<double>& phi,
                                 SharedAnswer& out);

/// The quality figures, and what a person should know of them; distances below the straight lines
/// are raised to these. All ranks call it. Errors (the same on all): those of assess_heat().
Result<void> check_answer(const SharedTask& task, const std::vector<BlockFaces*>& faces,
                          const SharedHeat& heat, std::vector<double> phi,
                          const std::vector<double>& b, std::vector<double>& distances,
                          SharedAnswer& out);

}  // namespace geotherm
