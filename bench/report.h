// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "bench/explore_bench.h"
#include "bench/load_bench.h"
#include "bench/machine.h"
#include "bench/render_bench.h"
#include "bench/solve_bench.h"

namespace geotherm::bench {

/// Text for the terminal; each ends with a newline. A ratio is the baseline's figure over ours,
/// except memory and frames: ours over the baseline's.
std::string machine_text(const Machine& machine, int threads);
std::string solve_heading();
std::string solve_text(const SolveGroup& group);
std::string growth_text(const std::vector<Growth>& growth);
std::string load_text(const LoadRow& row);
std::string render_text(const RenderBench& bench);
std::string explore_text(const ExploreBench& bench);

/// The whole as JSON. What was not measured is null; a part without rows is absent.
std::string to_json(const Machine& machine, int threads, const std::vector<SolveGroup>& groups,
                    const std::vector<Growth>& growth, const std::vector<LoadRow>& loads,
                    const RenderBench& render, const ExploreBench& explore);

}  // namespace geotherm::bench
