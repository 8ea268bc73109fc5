// SPDX-License-Identifier: MIT
#include "app/cli/sample_report.h"

#include <algorithm>
#include <cmath>

#include "app/session/sources.h"
#include "app/session/wording.h"
#include "app/text/text.h"
#include "geotherm/build_method.h"
#include "geotherm/path.h"
#include "solver/core/parallel.h"
#include "solver/core/text.h"
#include "solver/directions/pointed_mesh.h"
#include "solver/mesh/connectivity.h"

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

/// How far the farthest vertex of each cell is.
std::vector<double> cell_radii(const RelaxedPoints& relaxed) {
  std::vector<double> radii(relaxed.points.size(), 0.0);
  for (std::size_t v = 0; v < relaxed.nearest.size(); ++v) {
    if (relaxed.nearest[v] == kNoIndex) continue;
    double& radius = radii[static_cast<std::size_t>(relaxed.nearest[v])];
    radius = std::max(radius, relaxed.distances[v]);
  }
  return radii;
}

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
                      {"position", vector_json(position_at(mesh, relaxed.points[i]))},
                      {"cell", cells[i]}});
  }
  return {{"energies", relaxed.energies},
          {"moves", relaxed.moves},
          {"settled", relaxed.settled},
          {"points", std::move(points)}};
}

}  // namespace

Result<double> separation_of(const std::vector<SurfacePoint>& points, const MethodOptions& options,
                             const std::shared_ptr<const TriangleMesh>& mesh,
                             const Progress& progress) {
  if (points.size() < 2) return kUnreached;
  const auto pointed = pointed_mesh(mesh, points);
  if (!pointed) return pointed.error();
  const auto method = build_method(pointed->mesh, options, part_of(progress, 0, 0.2));
  if (!method) return method.error();
  double least = kUnreached;
  for (std::size_t i = 0; i < points.size() && least > 0; ++i) {
    const double share = 0.2 + 0.8 * static_cast<double>(i) / static_cast<double>(points.size());
    const auto from = (*method)->solve(SourceSet::of_vertices({pointed->vertices[i]}),
                                       {.quality = false, .reach = {.max_distance = least}},
                                       part_of(progress, share, share));
    if (!from) return from.error();
    for (std::size_t k = 0; k < points.size(); ++k) {
      if (k != i) least = std::min(least, from->distances[pointed->vertices[k]]);
    }
  }
  return least;
}

double SampleFigures::radius() const {
  if (!relaxed) return points.radius();
  const std::vector<char> used = vertices_in_faces(model.mesh->vertex_count(), model.mesh->faces());
  double farthest = 0;
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (used[v] != 0) farthest = std::max(farthest, relaxed->distances[v]);
  }
  return farthest;
}

Json sample_json(const SampleFigures& f) {
  const std::vector<Index> cells = cell_sizes(f.points.samples.size(), f.nearest());
  const std::vector<double> radii = f.relaxed ? cell_radii(*f.relaxed) : std::vector<double>();
  Json samples = Json::array();
  for (std::size_t i = 0; i < f.points.samples.size(); ++i) {
    if (f.relaxed) {
      const SurfacePoint point = in_face(*f.model.mesh, f.relaxed->points[i]);
      samples.push_back({{"vertex", nullptr},
                         {"point", point_json(point)},
                         {"position", vector_json(position_at(*f.model.mesh, point))},
                         {"distance", nullptr},
                         {"distance_back", nullptr},
                         {"radius", radii[i]},
                         {"cell", cells[i]}});
      continue;
    }
    const FarthestSample& sample = f.points.samples[i];
    samples.push_back({{"vertex", sample.vertex},
                       {"position", vector_json(f.model.mesh->positions()[sample.vertex])},
                       {"distance", sample.distance},
                       {"distance_back", sample.back},
                       {"radius", sample.radius},
                       {"cell", cells[i]}});
  }
  Json json = {{"model", model_json(f.model, f.mesh)},
               {"options", options_json(*f.method, f.options, f.points.first)},
               {"count", f.points.samples.size()},
               {"radius", f.radius()},
               {"separation", f.separation()},
               {"unreached", std::ranges::count(f.distances(), kUnreached)},
               {"samples", std::move(samples)},
               {"timing_ms",
                {{"load", f.model.load_ms},
                 {"setup", f.method->timing().setup},
                 {"sampling", f.sampling_ms},
                 {"query", f.points.query_ms}}},
               {"memory_mb", {{"factor", f.method->memory_mb()}, {"peak_rss", f.peak_rss_mb}}},
               {"warnings", to_text(f.warnings)}};
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
  const double radius = f.radius();
  figures.add_row({"radius", std::isfinite(radius)
                                 ? significant(radius) +
                                       ": every vertex of a face lies that near to one of " + count
                                 : "infinite: " + count + " for " +
                                       counted(f.mesh.components, "component", "components")});
  if (std::isfinite(f.separation())) {
    figures.add_row({"separation", significant(f.separation()) +
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
  if (f.error) figures.add_row({"error", to_text(accuracy_line(*f.error))});
  if (f.relaxed) {
    const RelaxedPoints& relaxed = *f.relaxed;
    figures.add_row({"relaxation", counted(std::ssize(relaxed.moves), "step", "steps") + " in " +
                                       milliseconds(f.relaxing_ms) + " ms" +
                                       (relaxed.settled ? ", settled" : "") + ", by distances of " +
                                       to_text(f.relaxed_by)});
    figures.add_row({"energy", significant(relaxed.energies.front()) + " to " +
                                   significant(relaxed.energies.back()) +
                                   ", the sum of area x distance^2"});
  }
  constexpr auto kRight = TextTable::Align::kRight;
  TextTable list({{"sample", kRight},
                  {f.relaxed ? "face" : "vertex", kRight},
                  {"radius", kRight},
                  {"cell", kRight}});
  const std::vector<Index> cells = cell_sizes(points.samples.size(), f.nearest());
  const std::vector<double> radii = f.relaxed ? cell_radii(*f.relaxed) : std::vector<double>();
  const std::size_t shown = std::min(points.samples.size(), kMaxShown);
  for (std::size_t i = 0; i < shown; ++i) {
    const Index place =
        f.relaxed ? in_face(*f.model.mesh, f.relaxed->points[i]).face : points.samples[i].vertex;
    list.add_row({std::to_string(i), std::to_string(place),
                  significant(f.relaxed ? radii[i] : points.samples[i].radius), grouped(cells[i])});
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
