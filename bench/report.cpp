// SPDX-License-Identifier: MIT
#include "bench/report.h"

#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace geotherm::bench {
namespace {

using Json = nlohmann::ordered_json;

__attribute__((format(printf, 1, 2))) std::string format(const char* pattern, ...) {
  char text[512];
  va_list arguments;
  va_start(arguments, pattern);
  std::vsnprintf(text, sizeof text, pattern, arguments);
  va_end(arguments);
  return text;
}

/// A number in `width` columns, a dash where there is none.
std::string number(double value, int width, int decimals, const char* unit = "") {
  if (!std::isfinite(value)) return format("%*s", width, "-");
  const std::string digits = format("%.*f%s", decimals, value, unit);
  return format("%*s", width, digits.c_str());
}

/// Three significant digits where that takes no more than two decimals.
std::string milliseconds(double value, int width) {
  return number(value, width, value < 10 ? 2 : value < 100 ? 1 : 0);
}

struct Ratios {
  double setup = kNotMeasured, query = kNotMeasured, batch = kNotMeasured;
  double memory = kNotMeasured, peak = kNotMeasured;
};

Ratios ratios_of(const Figures& ours, const Figures* baseline) {
  if (baseline == nullptr) return {};
  return {baseline->setup_ms / ours.setup_ms, baseline->query_ms / ours.query_ms,
          baseline->batch_ms_per_source / ours.batch_ms_per_source,
          ours.factor_mb / baseline->factor_mb, ours.peak_mb / baseline->peak_mb};
}

/// A number of JSON, or null.
Json value(double number) { return std::isfinite(number) ? Json(number) : Json(); }

Json solve_row(const SolveGroup& group, const Figures& ours) {
  const Figures* theirs = group.baseline();
  const Ratios ratios = ratios_of(ours, theirs);
  Json row = {{"mesh", group.mesh},
              {"vertices", group.vertices},
              {"faces", group.faces},
              {"backend", ours.name},
              {"setup_ms", value(ours.setup_ms)},
              {"query_ms", value(ours.query_ms)},
              {"batch16_ms_per_source", value(ours.batch_ms_per_source)},
              {"factor_mb", value(ours.factor_mb)},
              {"peak_mb", value(ours.peak_mb)},
              {"setup_ratio", value(ratios.setup)},
              {"query_ratio", value(ratios.query)},
              {"batch16_ratio", value(ratios.batch)},
              {"memory_ratio", value(ratios.memory)},
              {"peak_ratio", value(ratios.peak)}};
  if (theirs != nullptr) {
    row["baseline"] = {{"setup_ms", value(theirs->setup_ms)},
                       {"query_ms", value(theirs->query_ms)},
                       {"batch16_ms_per_source", value(theirs->batch_ms_per_source)},
                       {"factor_mb", value(theirs->factor_mb)},
                       {"peak_mb", value(theirs->peak_mb)},
                       {"difference", value(group.disagreement)},
                       {"message", theirs->failure}};
  }
  row["status"] = ours.failure.empty() ? "ok" : "failed";
  row["message"] = ours.failure;
  return row;
}

}  // namespace

std::string machine_text(const Machine& machine, int threads) {
  return format("%s, %d cores, load %.1f; %d threads (the baseline 1)\nBLAS %s; %s\n",
                machine.cpu.c_str(), machine.cores, machine.load, threads, machine.blas.c_str(),
                machine.compiler.c_str());
}

std::string solve_heading() {
  return "\nMilliseconds and MB; xN: the baseline's time over ours (more is better); %: ours of "
         "the\n"
         "baseline's (less is better). Batch: a source's share of 16. Peak: set-up and a query.\n\n"
         "mesh      faces     backend      setup          query          batch          "
         "factor        peak\n";
}

std::string solve_text(const SolveGroup& group) {
  if (!group.failure.empty()) return format("%-9s %s\n", group.mesh.c_str(), group.failure.c_str());
  std::string out;
  for (const Figures& f : group.figures) {
    const bool ours = &f != group.baseline();
    const Ratios r = ours ? ratios_of(f, group.baseline()) : Ratios{};
    const auto ratio = [&](double x) {
      return std::isfinite(x) ? format(" x%-5.*f", x < 10 ? 2 : 1, x) : std::string(7, ' ');
    };
    const auto share = [&](double x) {
      return std::isfinite(x) ? format(" %3.0f%%", 100 * x) : std::string(5, ' ');
    };
    out += format("%-9s %-9d %-10s", group.mesh.c_str(), group.faces, f.name.c_str());
    if (!f.failure.empty()) {
      out += " failed: " + f.failure + "\n";
      continue;
    }
    out += milliseconds(f.setup_ms, 8) + ratio(r.setup) + milliseconds(f.query_ms, 8) +
           ratio(r.query) + milliseconds(f.batch_ms_per_source, 8) + ratio(r.batch) +
           number(f.factor_mb, 9, 1) + share(r.memory) + number(f.peak_mb, 8, 0) + share(r.peak) +
           "\n";
  }
  if (std::isfinite(group.disagreement)) {
    out += format("%-20sdiscretised alike, cholmod and baseline differ by %.1e of the largest\n",
                  "", group.disagreement);
  }
  return out;
}

std::string growth_text(const std::vector<Growth>& growth) {
  if (growth.empty()) return {};
  std::string out = "\nGrowth: time ~ faces^exponent\nbackend        setup   query\n";
  for (const Growth& g : growth) {
    out += format("%-12s", g.name.c_str()) + number(g.setup_exponent, 8, 2) +
           number(g.query_exponent, 8, 2) + "\n";
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

std::string render_text(const RenderBench& bench) {
  std::string text;
  if (!bench.rows.empty()) {
    text += format("\nDrawing on %s, 1280x720; ratio to a bare shaded fill\n%-15s",
                   bench.device.c_str(), "view");
    text += format("%10s%9s%10s%8s\n", "triangles", "samples", "ms", "ratio");
  }
  for (const RenderRow& row : bench.rows) {
    text += format("%-15s%10d%9d", row.view.c_str(), row.triangles, row.samples) +
            milliseconds(row.frame_ms, 10) + number(row.ratio(), 8, 2, "x") + "\n";
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
        "consists of; the longest frame while t is switched, beside the usual one\n" +
        format("%-12s%10s%10s%9s%9s%9s%8s%11s%9s%8s\n", "mesh", "faces", "drag ms", "query",
               "upload", "frame", "ratio", "switch ms", "longest", "ratio");
  }
  for (const ExploreRow& row : bench.rows) {
    text += format("%-12s%10d", row.mesh.c_str(), row.faces) + milliseconds(row.drag_ms, 10) +
            milliseconds(row.query_ms, 9) + milliseconds(row.upload_ms, 9) +
            milliseconds(row.frame_ms, 9) + number(row.drag_ratio(), 8, 2, "x") +
            milliseconds(row.switch_ms, 11) + milliseconds(row.longest_frame_ms, 9) +
            number(row.frame_ratio(), 8, 2, "x") + "\n";
  }
  if (!bench.failure.empty()) text += "Exploring was not measured: " + bench.failure + "\n";
  return text;
}

std::string to_json(const Machine& machine, int threads, const std::vector<SolveGroup>& groups,
                    const std::vector<Growth>& growth, const std::vector<LoadRow>& loads,
                    const RenderBench& render, const ExploreBench& explore) {
  Json out;
  out["machine"] = {{"cpu", machine.cpu},   {"cores", machine.cores},       {"threads", threads},
                    {"blas", machine.blas}, {"compiler", machine.compiler}, {"load", machine.load}};
  for (const SolveGroup& group : groups) {
    if (!group.failure.empty()) {
      out["solve"].push_back(
          {{"mesh", group.mesh}, {"status", "failed"}, {"message", group.failure}});
    }
    for (const Figures& figures : group.figures) {
      if (&figures != group.baseline()) out["solve"].push_back(solve_row(group, figures));
    }
  }
  for (const Growth& g : growth) {
    out["growth"].push_back({{"backend", g.name},
                             {"setup_exponent", value(g.setup_exponent)},
                             {"query_exponent", value(g.query_exponent)}});
  }
  for (const LoadRow& row : loads) {
    out["load"].push_back({{"mesh", row.mesh},
                           {"faces", row.faces},
                           {"ms", value(row.ms)},
                           {"tinyobjloader_ms", value(row.tinyobjloader_ms)},
                           {"tinyobjloader_ratio", value(row.ratio())},
                           {"message", row.failure}});
  }
  for (const RenderRow& row : render.rows) {
    out["render"].push_back({{"view", row.view},
                             {"triangles", row.triangles},
                             {"samples", row.samples},
                             {"frame_ms", value(row.frame_ms)},
                             {"fill_ms", value(row.fill_ms)},
                             {"fill_ratio", value(row.ratio())}});
  }
  if (!render.rows.empty()) {
    out["render_device"] = {{"name", render.device}, {"peak_mb", render.peak_mb}};
  }
  for (const ExploreRow& row : explore.rows) {
    out["explore"].push_back({{"mesh", row.mesh},
                              {"faces", row.faces},
                              {"drag_ms", value(row.drag_ms)},
                              {"query_ms", value(row.query_ms)},
                              {"upload_ms", value(row.upload_ms)},
                              {"frame_ms", value(row.frame_ms)},
                              {"drag_ratio", value(row.drag_ratio())},
                              {"switch_ms", value(row.switch_ms)},
                              {"longest_frame_ms", value(row.longest_frame_ms)},
                              {"frame_ratio", value(row.frame_ratio())}});
  }
  return out.dump(2) + "\n";
}

}  // namespace geotherm::bench
