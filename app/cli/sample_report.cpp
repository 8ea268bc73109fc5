// SPDX-License-Identifier: MIT
#include "app/cli/sample_report.h"

#include <algorithm>
#include <cmath>

#include "app/session/sources.h"
#include "app/session/wording.h"
#include "app/text/text.h"
#include "geotherm/path.h"
#include "solver/core/parallel.h"
#include "solver/core/text.h"

namespace geotherm::app {
namespace {

constexpr std::size_t kMaxShown = 20;

/// How many vertices each sample is the nearest of.
std::vector<Index> cell_sizes(std::size_t samples, const std::vector<Index>& nearest) {
  std::vector<Index> sizes(samples, 0);
  for (const Index sample : nearest) {
    if (sample != kNoIndex) ++sizes[sample];
  }
  return sizes;
}

Json position_json(const Vec3& p) { return Json::array({p[0], p[1], p[2]}); }

/// The point in a face.
SurfacePoint in_face(const TriangleMesh& mesh, const SurfacePoint& point) {
  return points_in_faces(mesh, {{point}, {}, 0, false}).front();
}

Json relaxed_json(const SampleFigures& f) {
  const TriangleMesh& mesh = *f.model.mesh;
  const RelaxedPoints& relaxed = *f.relaxed;
  const std::vector<Index> cells = cell_sizes(relaxed.points.size(), relaxed.nearest);
  Json points = Json::array();
  for (std::size_t i = 0; i < relaxed.points.size(); ++i) {
    points.push_back({{"point", point_json(relaxed.points[i])},
                      {"position", position_json(position_at(mesh, relaxed.points[i]))},
                      {"cell", cells[i]}});
  }
  return {{"energies", relaxed.energies},
          {"moves", relaxed.moves},
          {"settled", relaxed.settled},
          {"points", std::move(points)}};
}

}  // namespace

Json sample_json(const SampleFigures& f) {
  const std::vector<Index> cells = cell_sizes(f.points.samples.size(), f.points.nearest);
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
  Json json = {{"model", model_json(f.model, f.mesh)},
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
               {"warnings", told(f.warnings)}};
  if (f.ranks > 1) json["ranks"] = f.ranks;
  if (f.error) json["error"] = error_json(*f.error);
  if (f.replaced) json["replaced"] = error_json(*f.replaced);
  if (f.relaxed) {
    json["relaxation"] = relaxed_json(f);
    json["timing_ms"]["relaxing"] = f.relaxing_ms;
  }
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
  if (f.ranks > 1) figures.add_row({"ranks", std::to_string(f.ranks)});
  figures.add_row({"set-up", milliseconds(f.method->timing().setup) + " ms"});
  figures.add_row({"sampling", milliseconds(f.sampling_ms) + " ms, " +
                                   milliseconds(points.query_ms) + " ms each"});
  if (f.error) figures.add_row({"error", told(accuracy_line(*f.error))});
  if (f.relaxed) {
    const RelaxedPoints& relaxed = *f.relaxed;
    figures.add_row({"relaxation", counted(std::ssize(relaxed.moves), "step", "steps") + " in " +
                                       milliseconds(f.relaxing_ms) + " ms" +
                                       (relaxed.settled ? ", settled" : "")});
    figures.add_row({"energy", significant(relaxed.energies.front()) + " to " +
                                   significant(relaxed.energies.back()) +
                                   ", the sum of area x distance^2"});
  }
  constexpr auto kRight = TextTable::Align::kRight;
  TextTable list({{"sample", kRight}, {"vertex", kRight}, {"radius", kRight}, {"cell", kRight}});
  const std::vector<Index> cells = cell_sizes(points.samples.size(), points.nearest);
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
  if (f.relaxed) {
    const SurfacePoint point = in_face(*f.model.mesh, f.relaxed->points[sample]);
    const Vec3 at = position_at(*f.model.mesh, point);
    return {static_cast<double>(point.face),
            point.weights[0],
            point.weights[1],
            point.weights[2],
            at[0],
            at[1],
            at[2]};
  }
  const FarthestSample& s = f.points.samples[sample];
  const Vec3& p = f.model.mesh->positions()[s.vertex];
  return {static_cast<double>(s.vertex), p[0], p[1], p[2], s.distance, s.radius};
}

std::string samples_csv(const SampleFigures& f) {
  std::string text =
      f.relaxed ? "sample,face,b0,b1,b2,x,y,z\n" : "sample,vertex,x,y,z,distance,radius\n";
  for (std::size_t i = 0; i < f.points.samples.size(); ++i) {
    const std::vector<double> row = sample_row(f, i);
    text += std::to_string(i) + ',' + std::to_string(static_cast<Index>(row.front()));
    for (std::size_t c = 1; c < row.size(); ++c) text += ',' + number_text(row[c]);
    text += '\n';
  }
  return text;
}

std::string samples_as_sources(const SampleFigures& f) {
  std::string text;
  for (std::size_t i = 0; i < f.points.samples.size(); ++i) {
    SourceSpec source = VertexList{{f.points.samples[i].vertex}};
    if (f.relaxed) {
      const SurfacePoint point = in_face(*f.model.mesh, f.relaxed->points[i]);
      source = FacePoint{point.face, point.weights};
    }
    text += to_text(source) + '\n';
  }
  return text;
}

}  // namespace geotherm::app
