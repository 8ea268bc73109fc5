// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "solver/distributed/shared_heat.h"

namespace geotherm {

/// phi = 0 is held where a source is, and where nothing is asked.
inline bool is_pinned(const SharedTask& task, Index v) {
  const Index component = task.components.of[v];
  return component == kNoIndex || !task.reached[static_cast<std::size_t>(component)] ||
         task.is_source[static_cast<std::size_t>(v)] != 0;
}

/// phi of own vertices, L phi = b (of own vertices, in MeshPart::unit), by conjugate gradients of
/// all ranks with BoomerAMG. `iterations`: that it took. Errors (the same on all ranks):
/// kNumericalFailure, with PETSc's reason. All ranks call it.
Result<std::vector<double>> solve_poisson(const SharedTask& task, std::span<const MeshBlock> blocks,
                                          const std::vector<double>& b, int& iterations);

}  // namespace geotherm
