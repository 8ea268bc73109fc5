// SPDX-License-Identifier: MIT
#include "tests/bench/bench_fixture.h"

#include <cmath>

namespace geotherm::test {

bench::Figures figures_of(const std::string& name, Index faces, double pace, double exponent) {
  const double thousands = faces / 1000.0;
  bench::Figures out{.name = name};
  out.setup_ms = pace * std::pow(thousands, exponent);
  out.query_ms = pace * thousands / 10;
  out.batch_ms_per_source = pace * thousands / 40;
  out.factor_mb = pace * thousands;
  out.peak_mb = 2 * pace * thousands;
  return out;
}

bench::SolveGroup group_of(const std::string& mesh, Index faces, bool regular) {
  bench::SolveGroup out;
  out.mesh = mesh;
  out.faces = faces;
  out.vertices = faces / 2;
  out.regular = regular;
  return out;
}

bench::BenchRun sample_run() {
  bench::BenchRun run;
  run.machine = {{.cpu = "a processor", .cores = 2, .blas = "a BLAS"}, "a compiler"};
  run.threads = 2;
  run.limits = {.threads = 2,
                .reading = {{4e6, 100, 200}, {1e9, 20, 30}},
                .cache_bytes = 3e7,
                .one_gflops = 50,
                .all_gflops = 100};
  for (const Index faces : {30'000, 100'000, 280'000, 1'100'000}) {
    for (const bool regular : {true, false}) {
      bench::SolveGroup group = group_of(regular ? "grid" : "torus", faces, regular);
      group.figures.push_back(figures_of("quick", faces, 0.5, 1.25));
      group.figures.back().factor_mb *= 2;
      group.figures.back().rates = {.factor_gflops = 25, .solve_gbs = 15, .factor_bytes = 1e9};
      group.figures.push_back(figures_of("slow", faces, 1.5, 1.25));
      if (faces > 1'000'000) {
        group.figures.back() = {.name = "slow"};
        group.figures.back().not_run = "not run: would take about 1000 s";
      }
      group.figures.push_back(figures_of(bench::kBaseline, faces, 2, 1.25));
      run.groups.push_back(group);
    }
  }
  run.growth = bench::measure_growth(run.groups);
  return run;
}

}  // namespace geotherm::test
