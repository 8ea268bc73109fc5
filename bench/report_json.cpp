// SPDX-License-Identifier: MIT
#include <cmath>
#include <nlohmann/json.hpp>

#include "bench/report.h"

namespace geotherm::bench {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kMegabyte = 1024 * 1024;

/// A number of JSON, or null.
Json value(double number) { return std::isfinite(number) ? Json(number) : Json(); }

/// Why there are no figures; empty: there are.
const std::string& message(const Figures& figures) {
  return figures.failure.empty() ? figures.not_run : figures.failure;
}

Json limits_object(const MachineLimits& limits) {
  Json out = {{"fma_gflops", {value(limits.one_gflops), value(limits.all_gflops)}},
              {"dgemm_gflops", {value(limits.one_dgemm_gflops), value(limits.all_dgemm_gflops)}},
              {"read_gbs", {value(limits.memory_gbs(1)), value(limits.memory_gbs(2))}},
              {"last_cache_mb", limits.cache_bytes / kMegabyte},
              {"threads", {1, limits.threads}}};
  for (const MachineLimits::Reading& reading : limits.reading) {
    out["read_gbs_by_size"].push_back(
        {{"mb", reading.bytes / kMegabyte}, {"gbs", {reading.one_gbs, reading.all_gbs}}});
  }
  return out;
}

Json exponents(const Exponents& e) {
  return {{"setup_exponent", value(e.setup)}, {"query_exponent", value(e.query)}};
}

Json solve_row(const BenchRun& run, const SolveGroup& group, const Figures& ours) {
  const Figures* theirs = group.baseline();
  const Ratios ratios = ratios_of(ours, theirs);
  const Shares shares = shares_of(ours.rates, run.limits, run.threads);
  Json row = {{"mesh", group.mesh},
              {"vertices", group.vertices},
              {"faces", group.faces},
              {"regular", group.regular},
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
              {"peak_ratio", value(ratios.peak)},
              {"factor_gflops", value(ours.rates.factor_gflops)},
              {"factor_gflops_share", value(shares.factor)},
              {"solve_gbs", value(ours.rates.solve_gbs)},
              {"solve_gbs_share", value(shares.solve)},
              {"solve_gbs_share_of_memory", value(shares.memory)}};
  if (theirs != nullptr) {
    row["baseline"] = {{"setup_ms", value(theirs->setup_ms)},
                       {"query_ms", value(theirs->query_ms)},
                       {"batch16_ms_per_source", value(theirs->batch_ms_per_source)},
                       {"factor_mb", value(theirs->factor_mb)},
                       {"peak_mb", value(theirs->peak_mb)},
                       {"difference", value(group.disagreement)},
                       {"message", message(*theirs)}};
  }
  row["status"] = !ours.failure.empty() ? "failed" : ours.not_run.empty() ? "ok" : "not run";
  row["message"] = message(ours);
  if (!ours.rates.failure.empty()) row["rates_message"] = ours.rates.failure;
  return row;
}

}  // namespace

std::string to_json(const BenchRun& run) {
  Json out;
  const Machine& machine = run.machine;
  out["machine"] = {{"cpu", machine.cpu},           {"cores", machine.cores},
                    {"threads", run.threads},       {"blas", machine.blas},
                    {"compiler", machine.compiler}, {"load", machine.load}};
  if (run.limits.measured()) out["machine"]["limits"] = limits_object(run.limits);
  out["quick"] = run.quick;
  for (const SolveGroup& group : run.groups) {
    if (!group.failure.empty()) {
      out["solve"].push_back(
          {{"mesh", group.mesh}, {"status", "failed"}, {"message", group.failure}});
    }
    for (const Figures& figures : group.figures) {
      if (&figures != group.baseline()) out["solve"].push_back(solve_row(run, group, figures));
    }
  }
  for (const Growth& g : run.growth) {
    out["growth"].push_back({{"backend", g.name},
                             {"setup_exponent", value(g.all.setup)},
                             {"query_exponent", value(g.all.query)},
                             {"regular", exponents(g.regular)},
                             {"irregular", exponents(g.irregular)}});
  }
  for (const LoadRow& row : run.loads) {
    out["load"].push_back({{"mesh", row.mesh},
                           {"faces", row.faces},
                           {"ms", value(row.ms)},
                           {"tinyobjloader_ms", value(row.tinyobjloader_ms)},
                           {"tinyobjloader_ratio", value(row.ratio())},
                           {"message", row.failure}});
  }
  for (const MovingRow& row : run.moving) {
    out["moving"].push_back({{"method", to_text(row.method)},
                             {"mesh", row.mesh},
                             {"faces", row.faces},
                             {"frames", row.frames},
                             {"fresh_ms", value(row.fresh_ms)},
                             {"moved_ms", value(row.moved_ms)},
                             {"query_ms", value(row.query_ms)},
                             {"ratio", value(row.ratio())},
                             {"difference", value(row.difference)},
                             {"message", row.failure}});
  }
  for (const RenderRow& row : run.render.rows) {
    out["render"].push_back({{"view", row.view},
                             {"triangles", row.triangles},
                             {"samples", row.samples},
                             {"frame_ms", value(row.frame_ms)},
                             {"fill_ms", value(row.fill_ms)},
                             {"fill_ratio", value(row.ratio())},
                             {"form_ms", value(row.form_ms)},
                             {"form_ratio", value(row.form_ratio())}});
  }
  if (!run.render.rows.empty()) {
    out["render_device"] = {{"name", run.render.device}, {"peak_mb", run.render.peak_mb}};
  }
  for (const ExploreRow& row : run.explore.rows) {
    out["explore"].push_back({{"mesh", row.mesh},
                              {"faces", row.faces},
                              {"drag_ms", value(row.drag_ms)},
                              {"query_ms", value(row.query_ms)},
                              {"upload_ms", value(row.upload_ms)},
                              {"frame_ms", value(row.frame_ms)},
                              {"drag_ratio", value(row.drag_ratio())},
                              {"stroke_pictures_per_second", value(row.stroke_pictures)},
                              {"stroke_setup_ms", value(row.stroke_setup_ms)},
                              {"switch_ms", value(row.switch_ms)},
                              {"longest_frame_ms", value(row.longest_frame_ms)},
                              {"frame_ratio", value(row.frame_ratio())},
                              {"turn_pictures_per_second", value(row.turn_pictures)},
                              {"full_frame_ms", value(row.full_frame_ms)},
                              {"hover_ms", value(row.hover_ms)}});
  }
  return out.dump(2) + "\n";
}

}  // namespace geotherm::bench
