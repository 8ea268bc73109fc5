// SPDX-License-Identifier: MIT
#include "bench/benches.h"

#include <cmath>
#include <map>
#include <utility>

#include "bench/report.h"

namespace geotherm::bench {
namespace {

/// The slope of y over x, with an offset of its own for each key.
class CommonSlope {
 public:
  void add(const std::string& key, double x, double y) {
    if (std::isfinite(x) && std::isfinite(y)) points_[key].emplace_back(x, y);
  }
  double slope() const {
    double xx = 0, xy = 0;
    for (const auto& [key, points] : points_) {
      double mean_x = 0, mean_y = 0;
      for (const auto& [x, y] : points) {
        mean_x += x / static_cast<double>(points.size());
        mean_y += y / static_cast<double>(points.size());
      }
      for (const auto& [x, y] : points) {
        xx += (x - mean_x) * (x - mean_x);
        xy += (x - mean_x) * (y - mean_y);
      }
    }
    // A mesh at two sizes at least: rounding alone would give any slope.
    return xx > 0.01 ? xy / xx : kNotMeasured;
  }

 private:
  std::map<std::string, std::vector<std::pair<double, double>>> points_;
};

struct Slopes {
  CommonSlope setup, query;

  void add(const SolveGroup& group, const Figures& figures) {
    const double size = std::log(group.vertices);
    setup.add(group.mesh, size, std::log(figures.setup_ms));
    query.add(group.mesh, size, std::log(figures.query_ms));
  }
  Exponents exponents() const { return {setup.slope(), query.slope()}; }
};

struct AllSlopes {
  Slopes all, regular, irregular;
};

}  // namespace

std::vector<Growth> measure_growth(const std::vector<SolveGroup>& groups) {
  std::vector<std::string> names;
  std::map<std::string, AllSlopes> slopes;
  for (const SolveGroup& group : groups) {
    for (const Figures& figures : group.figures) {
      if (!figures.failure.empty() || !figures.not_run.empty()) continue;
      if (!slopes.contains(figures.name)) names.push_back(figures.name);
      AllSlopes& own = slopes[figures.name];
      own.all.add(group, figures);
      (group.regular ? own.regular : own.irregular).add(group, figures);
    }
  }
  std::vector<Growth> out;
  for (const std::string& name : names) {
    const AllSlopes& own = slopes[name];
    const Growth growth{name, own.all.exponents(), own.regular.exponents(),
                        own.irregular.exponents()};
    if (std::isfinite(growth.all.setup)) out.push_back(growth);
  }
  return out;
}

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
