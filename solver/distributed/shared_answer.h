// SPDX-License-Identifier: MIT
#pragma once

#include <span>
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

  /// Adds the divergence at own vertices to `b`, in MeshPart::unit.
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

/// Distances of own vertices as phi has them; those below 0 become 0 and are counted. All ranks
/// call it.
std::vector<double> distances_of(const SharedTask& task, const std::vector<double>& phi,
                                 Quality& quality);

/// Range, mean and counts of the distances of own vertices. All ranks call it.
void measure(const SharedTask& task, std::span<const double> distances, SharedAnswer& out);

/// The quality figures but for those of the distances themselves, and what a person should know of
/// all of them. All ranks call it. Errors (the same on all): those of assess_heat().
Result<void> check_answer(const SharedTask& task, const std::vector<BlockFaces*>& faces,
                          const SharedHeat& heat, std::vector<double> phi,
                          const std::vector<double>& b, SharedAnswer& out);

}  // namespace geotherm
