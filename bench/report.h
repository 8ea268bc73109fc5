// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "bench/benches.h"
#include "bench/machine_limits.h"

namespace geotherm::bench {

/// All that one run measured. Parts that were not asked for are empty.
struct BenchRun {
  Machine machine;
  int threads = 1;
  bool quick = false;
  MachineLimits limits;
  std::vector<SolveGroup> groups;
  std::vector<Growth> growth;
  std::vector<LoadRow> loads;
  std::vector<MovingRow> moving;
  RenderBench render;
  ExploreBench explore;
};

/// Ours beside the baseline's: its figure over ours, except memory: ours over its.
struct Ratios {
  double setup = kNotMeasured, query = kNotMeasured, batch = kNotMeasured;
  double memory = kNotMeasured, peak = kNotMeasured;
};
Ratios ratios_of(const Figures& ours, const Figures* baseline);

/// Shares of what the machine can do at best.
struct Shares {
  double factor = kNotMeasured;  ///< of its multiply-adds
  double solve = kNotMeasured;   ///< of reading as many bytes as the factor has
  double memory = kNotMeasured;  ///< of reading memory; above 1 where a cache holds the factor
};
Shares shares_of(const Rates& rates, const MachineLimits& limits, int threads);

/// Text for the terminal; each ends with a newline. A ratio is the baseline's figure over ours,
/// except memory and frames: ours over the baseline's.
std::string machine_text(const Machine& machine, int threads);
std::string limits_text(const MachineLimits& limits);
std::string solve_heading();
std::string solve_text(const SolveGroup& group, const MachineLimits& limits, int threads);
std::string growth_text(const std::vector<Growth>& growth);
std::string load_text(const LoadRow& row);
std::string moving_text(const MovingRow& row);
std::string render_text(const RenderBench& bench);
std::string explore_text(const ExploreBench& bench);

/// The whole as JSON. What was not measured is null; a part without rows is absent.
std::string to_json(const BenchRun& run);

/// For the documentation, in Markdown: set-up, query, batch and memory as tables of meshes by
/// contenders, what was left out and why, the limits, rates and growth.
std::string to_markdown(const BenchRun& run);

/// Set-up, query, batch and memory over the number of faces, one colour for each backend of the
/// heat method and for the baseline, as an SVG picture that needs nothing else; readable on light
/// and dark pages. Lines join the irregular mesh that was measured at most sizes; the others are
/// marks. Figures that are not there leave gaps.
std::string performance_chart(const BenchRun& run);

}  // namespace geotherm::bench
