// SPDX-License-Identifier: MIT
#include <cmath>

#include "bench/estimates.h"
#include "bench/report.h"

namespace geotherm::bench {
namespace {

std::string number(double value, int width, int decimals, const char* unit = "") {
  return in_columns(number_text(value, decimals, unit), width);
}

std::string milliseconds(double value, int width) { return in_columns(digits_text(value), width); }

/// Blank where there is none: most rows have no rates.
std::string rate(double value, double share, int width) {
  if (!std::isfinite(value)) return std::string(static_cast<std::size_t>(width) + 5, ' ');
  const std::string part = std::isfinite(share) ? format(" %3.0f%%", 100 * share) : "     ";
  return number(value, width, 1) + part;
}

}  // namespace

std::string machine_text(const Machine& machine, int threads) {
  return format("%s, %d cores, load %.1f; %d threads (the baseline 1)\nBLAS %s; %s\n",
                machine.cpu.c_str(), machine.cores, machine.load, threads, machine.blas.c_str(),
                machine.compiler.c_str());
}

std::string limits_text(const MachineLimits& limits) {
  if (!limits.measured()) return {};
  std::string out =
      format("\nThe machine at best, with 1 thread and %d: multiply-adds %.1f / %.1f GFLOP/s",
             limits.threads, limits.one_gflops, limits.all_gflops);
  if (std::isfinite(limits.one_dgemm_gflops)) {
    out += format(", DGEMM %.1f / %.1f", limits.one_dgemm_gflops, limits.all_dgemm_gflops);
  }
  out += "\nReading, GB/s by size of the array:";
  const char* between = " ";
  for (const MachineLimits::Reading& r : limits.reading) {
    out += between + memory_text(r.bytes / (1024 * 1024)) +
           format(" %.1f / %.1f", r.one_gbs, r.all_gbs);
    between = ", ";
  }
  if (limits.cache_bytes > 0) {
    out += "; the last cache has " + memory_text(limits.cache_bytes / (1024 * 1024));
  }
  return out + "\n";
}

std::string solve_heading() {
  return "\nMilliseconds and MB; xN: the baseline's time over ours (more is better); %: ours of "
         "the\n"
         "baseline's (less is better). Batch: a source's share of 16. Peak: set-up and a query.\n"
         "GFLOP/s of the factorisations, of the machine's multiply-adds; GB/s of a solve, of what\n"
         "reading so much takes.\n\n"
         "mesh      faces    backend            set-up          query          batch          "
         "factor        peak       GFLOP/s     GB/s\n";
}

std::string solve_text(const SolveGroup& group, const MachineLimits& limits, int threads) {
  if (!group.failure.empty()) return format("%-9s ", group.mesh.c_str()) + group.failure + "\n";
  std::string out;
  for (const Figures& f : group.figures) {
    const bool ours = &f != group.baseline();
    const Ratios r = ours ? ratios_of(f, group.baseline()) : Ratios{};
    const Shares s = shares_of(f.rates, limits, threads);
    const auto ratio = [&](double x) {
      return std::isfinite(x) ? format(" x%-5.*f", x < 10 ? 2 : 1, x) : std::string(7, ' ');
    };
    const auto share = [&](double x) {
      return std::isfinite(x) ? format(" %3.0f%%", 100 * x) : std::string(5, ' ');
    };
    out += format("%-9s %-8d %-14s", group.mesh.c_str(), group.faces, f.name.c_str());
    if (!f.failure.empty() || !f.not_run.empty()) {
      out += f.failure.empty() ? " " + f.not_run + "\n" : " failed: " + f.failure + "\n";
      continue;
    }
    out += milliseconds(f.setup_ms, 8) + ratio(r.setup) + milliseconds(f.query_ms, 8) +
           ratio(r.query) + milliseconds(f.batch_ms_per_source, 8) + ratio(r.batch) +
           number(f.factor_mb, 9, 1) + share(r.memory) + number(f.peak_mb, 8, 0) + share(r.peak) +
           rate(f.rates.factor_gflops, s.factor, 9) + rate(f.rates.solve_gbs, s.solve, 7) + "\n";
    if (!f.rates.failure.empty())
      out += format("%-19s", "") + "no rates: " + f.rates.failure + "\n";
  }
  if (std::isfinite(group.disagreement)) {
    out += format("%-19sdiscretised alike, the baseline and we differ by %.1e of the largest\n", "",
                  group.disagreement);
  }
  return out;
}

std::string growth_text(const std::vector<Growth>& growth) {
  if (growth.empty()) return {};
  std::string out =
      "\nGrowth: time ~ vertices^exponent         regular           irregular\n"
      "backend           set-up   query    set-up   query    set-up   query\n";
  for (const Growth& g : growth) {
    out += format("%-14s", g.name.c_str());
    for (const Exponents& e : {g.all, g.regular, g.irregular}) {
      out += number(e.setup, 10, 2) + number(e.query, 8, 2);
    }
    out += "\n";
  }
  return out;
}

std::string load_text(const LoadRow& row) {
  std::string out = format("\nReading OBJ, %s of %d faces: ", row.mesh.c_str(), row.faces);
  if (!row.failure.empty()) return out + "failed: " + row.failure + "\n";
  out += format("%.0f ms", row.ms);
  if (!std::isfinite(row.ratio())) return out + " (built without tinyobjloader: no ratio)\n";
  return out + format(", tinyobjloader %.0f ms, x%.1f\n", row.tinyobjloader_ms, row.ratio());
}

std::string moving_text(const MovingRow& row) {
  std::string out = format("\nA frame of %s waving by %s, %d faces, %d frames: ", row.mesh.c_str(),
                           to_text(row.method).c_str(), row.faces, row.frames);
  if (!row.failure.empty()) return out + "failed: " + row.failure + "\n";
  return out + format(
                   "afresh %.0f ms, after the one before %.0f ms, %.0f of them the query, "
                   "x%.2f (%.1e apart)\n",
                   row.fresh_ms, row.moved_ms, row.query_ms, row.ratio(), row.difference);
}

std::string render_text(const RenderBench& bench) {
  std::string text;
  if (!bench.rows.empty()) {
    text += format(
        "\nDrawing on %s, 1280x720, plain; ratio to a bare shaded fill, and of shading "
        "by form to that\n%-15s",
        bench.device.c_str(), "view");
    text += format("%10s%9s%10s%8s%8s\n", "triangles", "samples", "ms", "ratio", "form");
  }
  for (const RenderRow& row : bench.rows) {
    text += format("%-15s%10d%9d", row.view.c_str(), row.triangles, row.samples) +
            milliseconds(row.frame_ms, 10) + number(row.ratio(), 8, 2, "x") +
            number(row.form_ratio(), 8, 2, "x") + "\n";
  }
  if (bench.peak_mb > 0) text += format("Device memory at most %.0f MB\n", bench.peak_mb);
  if (!bench.failure.empty()) text += "Drawing was not measured: " + bench.failure + "\n";
  return text;
}

std::string explore_text(const ExploreBench& bench) {
  std::string text;
  if (!bench.rows.empty()) {
    text +=
        "\nExploring at 1280x800: a source dragged, from picture to picture, beside what that\n"
        "consists of; pictures a second while the surface is sculpted, beside their set-up; the\n"
        "longest frame while t is switched, beside the usual one; pictures a second while the "
        "model\n"
        "turns, the first frame at rest, and one in which panels alone change\n" +
        format("%-12s%10s%10s%9s%9s%9s%8s%11s%9s%11s%9s%8s%9s%9s%9s\n", "mesh", "faces", "drag ms",
               "query", "upload", "frame", "ratio", "stroke /s", "set-up", "switch ms", "longest",
               "ratio", "turn /s", "rest ms", "hover ms");
  }
  for (const ExploreRow& row : bench.rows) {
    text += format("%-12s%10d", row.mesh.c_str(), row.faces) + milliseconds(row.drag_ms, 10) +
            milliseconds(row.query_ms, 9) + milliseconds(row.upload_ms, 9) +
            milliseconds(row.frame_ms, 9) + number(row.drag_ratio(), 8, 2, "x") +
            number(row.stroke_pictures, 11, 1, "") + milliseconds(row.stroke_setup_ms, 9) +
            milliseconds(row.switch_ms, 11) + milliseconds(row.longest_frame_ms, 9) +
            number(row.frame_ratio(), 8, 2, "x") + number(row.turn_pictures, 9, 1, "") +
            milliseconds(row.full_frame_ms, 9) + milliseconds(row.hover_ms, 9) + "\n";
  }
  if (!bench.failure.empty()) text += "Exploring was not measured: " + bench.failure + "\n";
  return text;
}

}  // namespace geotherm::bench
