// SPDX-License-Identifier: MIT
#include "solver/distributed/shared_poisson.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "solver/linear/matrix_rows.h"

namespace geotherm {
namespace {

/// Residual of the Poisson step, relative to its right side, each component's scaled to 1.
constexpr double kPoissonTolerance = 1e-9;
/// A matrix whose rows are this rank's own vertices, columns all ranks'.
struct SharedRows {
  std::vector<int> start = {0}, column;
  std::vector<double> value;
};

SharedRows poisson_rows(const SharedTask& task, std::span<const MeshBlock> blocks) {
  SharedRows out;
  std::vector<std::pair<int, double>> entries;
  for (const MeshBlock& block : blocks) {
    FullRows rows;
    if (block.surface) {
      rows = full_rows(block.surface->combine(0.0, 1.0, {}, 0.0, task.threads)->assembled());
    }
    for (Index here = 0; here < block.own(); ++here) {
      const Index v = block.vertex[here], row = block.row(here);
      entries.clear();
      if (row == kNoIndex || is_pinned(task, v)) {
        entries.emplace_back(static_cast<int>(task.part.id[v]), 1.0);
      } else {
        for (int e = rows.start[row]; e < rows.start[row + 1]; ++e) {
          const Index to = block.part_vertex(rows.column[e]);
          if (!is_pinned(task, to)) {
            entries.emplace_back(static_cast<int>(task.part.id[to]), rows.value[e]);
          }
        }
      }
      std::ranges::sort(entries);
      for (const auto& [column, value] : entries) {
        out.column.push_back(column);
        out.value.push_back(value);
      }
      out.start.push_back(static_cast<int>(out.column.size()));
    }
  }
  return out;
}

/// The right side of each component comes to length 1: iterations end by one norm over all.
std::vector<double> scales_of(const SharedTask& task, const std::vector<double>& b) {
  std::vector<double> squares(task.components.sizes.size(), 0.0);
  for (Index v = 0; v < task.part.own; ++v) {
    if (!is_pinned(task, v)) squares[task.components.of[v]] += b[v] * b[v];
  }
  task.ranks.all_reduce(squares, RankGroup::Reduction::kSum);
  for (double& each : squares) each = each > 0 ? std::sqrt(each) : 1.0;
  return squares;
}

}  // namespace

Result<std::vector<double>> solve_poisson(const SharedTask& task, std::span<const MeshBlock> blocks,
                                          const std::vector<double>& b, int& iterations) {
  const MpiModule& module = task.ranks.module();
  const std::vector<double> scales = scales_of(task, b);
  std::vector<double> right(b.size(), 0.0), phi(b.size());
  for (Index v = 0; v < task.part.own; ++v) {
    if (!is_pinned(task, v)) right[v] = b[v] / scales[task.components.of[v]];
  }
  void* solver = nullptr;
  std::string problem;
  {
    const SharedRows rows = poisson_rows(task, blocks);
    const char* said = nullptr;
    solver = module.make_shared_solver(task.part.own, rows.start.data(), rows.column.data(),
                                       rows.value.data(), &said);
    if (solver == nullptr) problem = said;
  }
  const auto agree = [&]() -> Result<void> {
    if (problem.empty()) return task.ranks.agree({});
    return task.ranks.agree(Error{ErrorCode::kNumericalFailure, "the Poisson step: " + problem});
  };
  if (auto made = agree(); !made) return made.error();
  problem = module.solve(solver, right.data(), phi.data(), kPoissonTolerance, &iterations);
  module.free_solver(solver);
  if (auto solved = agree(); !solved) return solved.error();
  for (Index v = 0; v < task.part.own; ++v) {
    if (!is_pinned(task, v)) phi[v] *= scales[task.components.of[v]];
  }
  return phi;
}

}  // namespace geotherm
