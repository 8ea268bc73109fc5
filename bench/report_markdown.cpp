// SPDX-License-Identifier: MIT
#include <cmath>

#include "bench/number_text.h"
#include "bench/report.h"

namespace geotherm::bench {
namespace {

std::string cell(const std::string& text) { return " " + text + " |"; }

/// "grid, 30k"; regular meshes are said to be.
std::string mesh_text(const SolveGroup& group) {
  const double faces = group.faces;
  const std::string size =
      faces < 1e6 ? format("%.0fk", faces / 1e3) : format("%.1fM", faces / 1e6);
  return group.mesh + (group.regular ? " (regular), " : ", ") + size;
}

/// What was measured and, in brackets, how that is to the baseline's.
std::string with_ratio(const std::string& figure, double ratio) {
  if (!std::isfinite(ratio)) return figure;
  return figure + format(" (%.*f\u00d7)", ratio < 0.95 ? 2 : ratio < 9.95 ? 1 : 0, ratio);
}

std::string with_share(const std::string& figure, double share) {
  return std::isfinite(share) ? figure + format(" (%.0f %%)", 100 * share) : figure;
}

std::string times_table(const BenchRun& run) {
  std::string out =
      "| mesh, faces | backend | set-up | query | batch of 16, a source | factors | peak |\n"
      "| --- | --- | --- | --- | --- | --- | --- |\n";
  for (const SolveGroup& group : run.groups) {
    if (!group.failure.empty())
      out += "|" + cell(group.mesh) + cell(group.failure) + " | | | | |\n";
    for (const Figures& f : group.figures) {
      out += "|" + cell(mesh_text(group)) + cell("`" + f.name + "`");
      if (!f.failure.empty() || !f.not_run.empty()) {
        out += cell(f.failure.empty() ? f.not_run : "failed: " + f.failure) + " | | | |\n";
        continue;
      }
      const bool ours = &f != group.baseline();
      const Ratios r = ours ? ratios_of(f, group.baseline()) : Ratios{};
      out += cell(with_ratio(time_text(f.setup_ms), r.setup)) +
             cell(with_ratio(time_text(f.query_ms), r.query)) +
             cell(with_ratio(time_text(f.batch_ms_per_source), r.batch)) +
             cell(with_share(memory_text(f.factor_mb), r.memory)) +
             cell(with_share(memory_text(f.peak_mb), r.peak)) + "\n";
    }
  }
  return out;
}

std::string rates_table(const BenchRun& run) {
  std::string rows;
  for (const SolveGroup& group : run.groups) {
    for (const Figures& f : group.figures) {
      if (!std::isfinite(f.rates.factor_gflops) && !std::isfinite(f.rates.solve_gbs)) continue;
      const Shares shares = shares_of(f.rates, run.limits, run.threads);
      rows += "|" + cell(mesh_text(group)) + cell("`" + f.name + "`") +
              cell(with_share(number_text(f.rates.factor_gflops, 1), shares.factor)) +
              cell(memory_text(f.rates.factor_bytes / (1024 * 1024))) +
              cell(with_share(number_text(f.rates.solve_gbs, 1), shares.solve)) + "\n";
    }
  }
  if (rows.empty()) return {};
  return "| mesh, faces | backend | factorisation, GFLOP/s | one factor | solve, GB/s |\n"
         "| --- | --- | --- | --- | --- |\n" +
         rows;
}

std::string limits_table(const MachineLimits& limits) {
  if (!limits.measured()) return {};
  std::string out = format("| at best | 1 thread | %d |\n| --- | --- | --- |\n", limits.threads);
  const auto row = [&](const std::string& what, double one, double all) {
    out += "|" + cell(what) + cell(number_text(one, 1)) + cell(number_text(all, 1)) + "\n";
  };
  row("multiply-adds, GFLOP/s", limits.one_gflops, limits.all_gflops);
  if (std::isfinite(limits.one_dgemm_gflops)) {
    row("DGEMM, GFLOP/s", limits.one_dgemm_gflops, limits.all_dgemm_gflops);
  }
  for (const MachineLimits::Reading& r : limits.reading) {
    row("reading " + memory_text(r.bytes / (1024 * 1024)) + ", GB/s", r.one_gbs, r.all_gbs);
  }
  return out;
}

std::string growth_table(const std::vector<Growth>& growth) {
  if (growth.empty()) return {};
  std::string out =
      "| exponent of | set-up | regular | irregular | query | regular | irregular |\n"
      "| --- | --- | --- | --- | --- | --- | --- |\n";
  for (const Growth& g : growth) {
    out += "|" + cell("`" + g.name + "`");
    for (double Exponents::*part : {&Exponents::setup, &Exponents::query}) {
      for (const Exponents& e : {g.all, g.regular, g.irregular}) {
        out += cell(number_text(e.*part, 2));
      }
    }
    out += "\n";
  }
  return out;
}

}  // namespace

std::string to_markdown(const BenchRun& run) {
  std::string out = run.machine.cpu + format(", %d threads, the baseline 1", run.threads) +
                    (run.quick ? " (a quick run)" : "") + "; " + run.machine.compiler + "; BLAS " +
                    run.machine.blas + ".\n";
  for (const std::string& table :
       {run.groups.empty() ? std::string() : times_table(run), limits_table(run.limits),
        rates_table(run), growth_table(run.growth)}) {
    if (!table.empty()) out += "\n" + table;
  }
  for (const LoadRow& row : run.loads) {
    if (row.failure.empty()) out += load_text(row);
  }
  return out;
}

}  // namespace geotherm::bench
