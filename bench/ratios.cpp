// SPDX-License-Identifier: MIT
#include "bench/report.h"

namespace geotherm::bench {

Ratios ratios_of(const Figures& ours, const Figures* baseline) {
  if (baseline == nullptr) return {};
  return {baseline->setup_ms / ours.setup_ms, baseline->query_ms / ours.query_ms,
          baseline->batch_ms_per_source / ours.batch_ms_per_source,
          ours.factor_mb / baseline->factor_mb, ours.peak_mb / baseline->peak_mb};
}

Shares shares_of(const Rates& rates, const MachineLimits& limits, int threads) {
  if (!limits.measured()) return {};
  return {rates.factor_gflops / (threads > 1 ? limits.all_gflops : limits.one_gflops),
          rates.solve_gbs / limits.reading_gbs(rates.factor_bytes, threads),
          rates.solve_gbs / limits.memory_gbs(threads)};
}

}  // namespace geotherm::bench
