// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <string_view>

#include "bench/estimates.h"
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

/// One table: a row for each mesh, a column for each contender.
struct Quantity {
  const char* title;
  double Figures::*figure;
  double Ratios::*ratio;
  bool memory;  ///< in MB, with our share of the baseline's; else a time, with its over ours
};

constexpr Quantity kQuantities[] = {
    {"Set-up", &Figures::setup_ms, &Ratios::setup, false},
    {"Query", &Figures::query_ms, &Ratios::query, false},
    {"Batch of 16, one source's share", &Figures::batch_ms_per_source, &Ratios::batch, false},
    {"Factors (tables of other methods)", &Figures::factor_mb, &Ratios::memory, true},
    {"Peak memory", &Figures::peak_mb, &Ratios::peak, true},
};

std::vector<std::string> contenders_of(const std::vector<SolveGroup>& groups) {
  std::vector<std::string> names;
  for (const SolveGroup& group : groups) {
    for (const Figures& f : group.figures) {
      if (std::ranges::find(names, f.name) == names.end()) names.push_back(f.name);
    }
  }
  return names;
}

std::string figure_cell(const SolveGroup& group, const std::string& name, const Quantity& of) {
  const auto f = std::ranges::find(group.figures, name, &Figures::name);
  if (f == group.figures.end()) return cell("");
  if (!f->failure.empty()) return cell("failed");
  if (!f->not_run.empty()) return cell("not run");
  const bool ours = &*f != group.baseline();
  const double ratio = ours ? ratios_of(*f, group.baseline()).*of.ratio : kNotMeasured;
  const double figure = (*f).*of.figure;
  if (of.memory && figure == 0) return cell("none");
  return cell(of.memory ? with_share(memory_text(figure), ratio)
                        : with_ratio(time_text(figure), ratio));
}

std::string figures_table(const BenchRun& run, const Quantity& quantity) {
  const std::vector<std::string> names = contenders_of(run.groups);
  std::string head = "|" + cell(quantity.title), rule = "| --- |", rows;
  for (const std::string& name : names) {
    head += cell("`" + name + "`");
    rule += " --- |";
  }
  for (const SolveGroup& group : run.groups) {
    if (!group.failure.empty()) continue;
    rows += "|" + cell(mesh_text(group));
    for (const std::string& name : names) rows += figure_cell(group, name, quantity);
    rows += "\n";
  }
  return rows.empty() ? rows : head + "\n" + rule + "\n" + rows;
}

/// Why there are no figures, one line each.
std::string reasons(const BenchRun& run) {
  std::string out;
  constexpr std::string_view kHeading = "not run: ";
  for (const SolveGroup& group : run.groups) {
    if (!group.failure.empty()) out += "- " + group.mesh + ": " + group.failure + "\n";
    for (const Figures& f : group.figures) {
      std::string reason = f.failure.empty() ? f.not_run : "failed: " + f.failure;
      if (reason.starts_with(kHeading)) reason.erase(0, kHeading.size());
      if (!reason.empty()) out += "- " + mesh_text(group) + ", `" + f.name + "`: " + reason + "\n";
    }
  }
  return out.empty() ? out : "Left out:\n\n" + out;
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
  std::vector<std::string> parts;
  for (const Quantity& quantity : kQuantities) parts.push_back(figures_table(run, quantity));
  parts.insert(parts.end(), {reasons(run), limits_table(run.limits), rates_table(run),
                             growth_table(run.growth)});
  for (const std::string& part : parts) {
    if (!part.empty()) out += "\n" + part;
  }
  for (const LoadRow& row : run.loads) {
    if (row.failure.empty()) out += load_text(row);
  }
  for (const MovingRow& row : run.moving) {
    if (row.failure.empty()) out += moving_text(row);
  }
  return out;
}

}  // namespace geotherm::bench
