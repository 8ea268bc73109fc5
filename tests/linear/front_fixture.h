// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "solver/linear/multifrontal/front_factor.h"
#include "tests/linear/backend_fixture.h"
#include "tests/support/mesh_zoo.h"
#include "tests/support/sanitized.h"

namespace geotherm::test {

/// The graph of a lower triangle.
inline SymmetricPattern pattern_of_lower(const LowerPattern& lower) {
  const auto size = static_cast<Index>(lower.start.size()) - 1;
  std::vector<std::vector<Index>> neighbors(static_cast<std::size_t>(size));
  for (Index j = 0; j < size; ++j) {
    for (std::int64_t e = lower.start[j] + 1; e < lower.start[j + 1]; ++e) {
      neighbors[lower.row[e]].push_back(j);
      neighbors[j].push_back(lower.row[e]);
    }
  }
  SymmetricPattern pattern;
  for (std::vector<Index>& list : neighbors) {
    std::sort(list.begin(), list.end());
    pattern.neighbor.insert(pattern.neighbor.end(), list.begin(), list.end());
    pattern.start.push_back(static_cast<std::int64_t>(pattern.neighbor.size()));
  }
  return pattern;
}

/// A mesh in the order of the native backend, and the fronts of its operators.
struct Fronts {
  explicit Fronts(const Draft& draft, int threads = 1)
      : surface(analysed(*finish(Draft(draft)), backend_named("native"))),
        pattern(pattern_of_lower(surface.operators->lower)),
        tree(build_front_tree(pattern, count_columns(pattern), threads)) {}

  std::shared_ptr<const FemOperator> heat() const {
    return std::make_shared<FemOperator>(surface.operators, 1, 1);
  }
  FrontFactor factor(FactorStorage storage, int threads = 1,
                     InstructionSet set = best_instruction_set()) const {
    FrontFactor out;
    const FactorFailure failure =
        factorize_fronts(tree, heat()->assembled(), {threads, storage}, out, nullptr, set);
    EXPECT_FALSE(failure.failed());
    return out;
  }
  /// M^-1 b.
  std::vector<double> solve(const FrontFactor& factor, std::vector<double> b, int group = 1,
                            int threads = 1, InstructionSet set = best_instruction_set()) const {
    const FrontPasses passes(tree, factor, group, set);
    passes.forward(b.data(), group, threads);
    passes.backward(b.data(), group, threads);
    return b;
  }

  Analysed surface;
  SymmetricPattern pattern;
  FrontTree tree;
};

inline std::vector<double> random_numbers(Index count, unsigned seed) {
  const Block block = random_block(count, 1, seed);
  return {block.data(), block.data() + count};
}

/// Large enough for several tasks, with fronts of one to many blocks of columns.
inline Draft many_tasks() { return kSanitized ? torus(90, 60, 0.4) : torus(150, 100, 0.4); }

}  // namespace geotherm::test
