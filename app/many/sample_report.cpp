// SPDX-License-Identifier: MIT
#include "app/many/sample_report.h"

#include <algorithm>
#include <cmath>

#include "app/text.h"
#include "app/text_table.h"
#include "geotherm/heat_method.h"
#include "solver/core/parallel.h"
#include "solver/core/text.h"

namespace geotherm::app {
namespace {

constexpr std::size_t kMaxShown = 20;

/// How many vertices each sample is the nearest of.
std::vector<Index> cell_sizes(const FarthestPoints& points) {
  std::vector<Index> sizes(points.samples.size(), 0);
  for (const Index sample : points.nearest) {
    if (sample != kNoIndex) ++sizes[sample];
  }
  return sizes;
}

Json position_json(const Vec3& p) { return Json::array({p[0], p[1], p[2]}); }

}  // namespace

Json sample_json(const SampleFigures& f) {
  const std::vector<Index> cells = cell_sizes(f.points);
  Json samples = Json::array();
  for (std::size_t i = 0; i < f.points.samples.size(); ++i) {
    const FarthestSample& sample = f.points.samples[i];
    samples.push_back({{"vertex", sample.vertex},
                       {"position", position_json(f.model.mesh->positions()[sample.vertex])},
                       {"distance", sample.distance},
                       {"distance_back", sample.back},
                       {"radius", sample.radius},
                       {"cell", cells[i]}});
  }
  Json json = {{"model", model_json(f.model.name, f.mesh)},
               {"options", options_json(*f.method, f.options, f.points.first)},
               {"count", f.points.samples.size()},
               {"radius", f.points.radius()},
               {"separation", f.points.separation()},
               {"unreached", std::ranges::count(f.points.distances, kUnreached)},
               {"samples", std::move(samples)},
               {"timing_ms",
                {{"load", f.model.load_ms},
                 {"setup", f.method->timing().setup},
                 {"sampling", f.sampling_ms},
                 {"query", f.points.query_ms}}},
               {"memory_mb", {{"factor", f.method->memory_mb()}, {"peak_rss", f.peak_rss_mb}}},
               {"warnings", f.warnings}};
  if (f.error) json["error"] = error_json(*f.error);
  if (f.replaced) json["replaced"] = error_json(*f.replaced);
  return json;
}

std::string sample_table(const SampleFigures& f) {
  const FarthestPoints& points = f.points;
  TextTable figures({{"", TextTable::Align::kLeft}, {"", TextTable::Align::kLeft}});
  const std::string count =
      counted(static_cast<std::int64_t>(points.samples.size()), "sample", "samples");
  figures.add_row(
      {"model", one_line(f.model.name) + ", " + counted(f.mesh.vertices, "vertex", "vertices")});
  figures.add_row({"radius", std::isfinite(points.radius())
                                 ? significant(points.radius()) +
                                       ": every vertex of a face lies that near to one of " + count
                                 : "infinite: " + count + " for " +
                                       counted(f.mesh.components, "component", "components")});
  if (std::isfinite(points.separation())) {
    figures.add_row({"separation", significant(points.separation()) +
                                       " between two samples at least, in either direction"});
  }
  figures.add_row({"method", to_text(f.method->kind()) +
                                 (f.method->heat() ? ", " + points.first.backend : std::string()) +
                                 ", " +
                                 counted(thread_count(f.options.threads), "thread", "threads")});
  figures.add_row({"set-up", milliseconds(f.method->timing().setup) + " ms"});
  figures.add_row({"sampling", milliseconds(f.sampling_ms) + " ms, " +
                                   milliseconds(points.query_ms) + " ms each"});
  if (f.error) figures.add_row({"error", accuracy_line(*f.error)});
  constexpr auto kRight = TextTable::Align::kRight;
  TextTable list({{"sample", kRight}, {"vertex", kRight}, {"radius", kRight}, {"cell", kRight}});
  const std::vector<Index> cells = cell_sizes(points);
  const std::size_t shown = std::min(points.samples.size(), kMaxShown);
  for (std::size_t i = 0; i < shown; ++i) {
    list.add_row({std::to_string(i), std::to_string(points.samples[i].vertex),
                  significant(points.samples[i].radius), grouped(cells[i])});
  }
  std::string text = figures.text() + '\n' + list.text();
  if (shown < points.samples.size()) {
    text += "and " + grouped(static_cast<std::int64_t>(points.samples.size() - shown)) +
            " more; --samples FILE.csv holds all\n";
  }
  return text;
}

std::vector<double> sample_row(const SampleFigures& f, std::size_t sample) {
  const FarthestSample& s = f.points.samples[sample];
  const Vec3& p = f.model.mesh->positions()[s.vertex];
  return {static_cast<double>(s.vertex), p[0], p[1], p[2], s.distance, s.radius};
}

std::string samples_csv(const SampleFigures& f) {
  std::string text = "sample,vertex,x,y,z,distance,radius\n";
  for (std::size_t i = 0; i < f.points.samples.size(); ++i) {
    text += std::to_string(i) + ',' + std::to_string(f.points.samples[i].vertex);
    const std::vector<double> row = sample_row(f, i);
    for (std::size_t c = 1; c < row.size(); ++c) text += ',' + number_text(row[c]);
    text += '\n';
  }
  return text;
}

}  // namespace geotherm::app
