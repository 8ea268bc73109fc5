// SPDX-License-Identifier: MIT
// Sources of the caller as those of the library.
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "app/c/handles.h"
#include "app/session/sources.h"
#include "app/session/wording.h"
#include "app/text/text.h"
#include "solver/core/text.h"

namespace geotherm::c {
namespace {

using app::EachSource;
using app::Model;
using app::ResolvedSources;
using app::Source;

Error about_source(std::int64_t number, const Error& error) {
  return app::about("source " + std::to_string(number), error);
}

Result<void> check_pointers(const geotherm_sources* sources) {
  if (auto there = require(sources, "sources"); !there) return there;
  if (sources->count < 0 || sources->sets < 0) return bad_argument("sources has a negative count");
  if (sources->count > 0) return require(sources->points, "sources.points");
  return {};
}

Result<app::SourceSpec> spec_of(const geotherm_source& point) {
  constexpr std::int64_t kMax = std::numeric_limits<Index>::max();
  if (point.kind != GEOTHERM_XYZ && (point.id < 0 || point.id > kMax)) {
    return bad_argument("there is no " +
                        std::string(point.kind == GEOTHERM_FACE ? "face " : "vertex ") +
                        std::to_string(point.id));
  }
  if (!(point.offset >= 0) || !std::isfinite(point.offset)) {
    return bad_argument("the offset is " + number_text(point.offset),
                        {"give a length that is not negative"});
  }
  const auto id = static_cast<Index>(point.id);
  switch (point.kind) {
    case GEOTHERM_VERTEX:
      return app::SourceSpec(app::VertexList{{id}, point.offset});
    case GEOTHERM_FACE:
      break;
    case GEOTHERM_XYZ:
      return app::SourceSpec(
          app::SpacePoint{Vec3(point.at[0], point.at[1], point.at[2]), point.offset});
    default:
      return bad_argument("the kind " + std::to_string(point.kind) + " is no geotherm_place");
  }
  constexpr double kRound = 1e-6;  // what nine typed digits give
  double sum = 0;
  bool valid = true;
  for (const double weight : point.at) {
    valid = valid && weight >= -kRound;
    sum += weight;
  }
  if (valid && std::abs(sum - 1) <= kRound) {
    std::array<double, 3> weights{};
    for (std::size_t k = 0; k < 3; ++k) weights[k] = std::max(point.at[k], 0.0) / sum;
    return app::SourceSpec(app::FacePoint{id, weights, point.offset});
  }
  return bad_argument("the weights in face " + std::to_string(id) + " are " +
                          number_text(point.at[0]) + ", " + number_text(point.at[1]) + " and " +
                          number_text(point.at[2]),
                      {"give three that are not negative and have the sum 1"});
}

Result<std::vector<Source>> named_sources(const char* text) {
  std::vector<Source> out;
  if (text == nullptr) return out;
  for (const std::string_view line : app::split(text, '\n')) {
    if (line.find_first_not_of(" \t\r") == std::string_view::npos) continue;
    auto spec = app::parse_source(line);
    if (!spec) return spec.error();
    std::string where = "source " + app::to_text(*spec);
    out.push_back({*std::move(spec), std::move(where)});
  }
  return out;
}

/// A set for each point, in their order. Places are searched for.
Result<EachSource> sets_of_points(const geotherm_sources& sources, const Model& model,
                                  const Progress& progress) {
  std::vector<Source> points;
  bool ready = !model.space;  // vertices of a mesh: the methods themselves check them
  for (std::int64_t i = 0; i < sources.count; ++i) {
    const geotherm_source& point = sources.points[i];
    auto spec = spec_of(point);
    if (!spec) return about_source(i, spec.error());
    ready = ready && point.kind == GEOTHERM_VERTEX && point.id < model.mesh->vertex_count();
    points.push_back({*std::move(spec), "source " + std::to_string(i)});
  }
  if (!ready) return app::resolve_each(points, model, progress);
  EachSource out;
  for (std::int64_t i = 0; i < sources.count; ++i) {
    SourceSet& set = out.sets.emplace_back();
    set.points = {SurfacePoint::at_vertex(static_cast<Index>(sources.points[i].id))};
    set.offsets = {sources.points[i].offset};
  }
  return out;
}

}  // namespace

Result<ResolvedSources> one_set(const geotherm_sources* sources, const Model& model,
                                const Progress& progress) {
  if (auto there = check_pointers(sources); !there) return there.error();
  auto points = sets_of_points(*sources, model, progress);
  if (!points) return points.error();
  const auto named = named_sources(sources->text);
  if (!named) return named.error();
  auto placed = app::resolve_sources(*named, model, progress);
  if (!placed) return placed.error();
  app::SetUnion all;
  for (const SourceSet& point : points->sets) all.add(point);
  all.add(placed->set);
  ResolvedSources out{all.take(), std::move(points->warnings)};
  out.warnings.insert(out.warnings.end(), placed->warnings.begin(), placed->warnings.end());
  if (out.set.empty()) return bad_argument("sources is empty", {"name at least one"});
  return out;
}

Result<EachSource> many_sets(const geotherm_sources* sources, const Model& model,
                             const Progress& progress) {
  if (auto there = check_pointers(sources); !there) return there.error();
  const bool single = sources->starts == nullptr;
  const std::int64_t sets = single ? sources->count : sources->sets;
  if (sets == 0 && sources->count > 0) {
    return bad_argument("sources.starts: none of 0 sets has the " +
                        app::counted(sources->count, "point", "points"));
  }
  auto points = sets_of_points(*sources, model, progress);
  if (!points) return points.error();
  EachSource out;
  out.warnings = std::move(points->warnings);
  app::SetUnion one;
  for (std::int64_t k = 0; k < sets; ++k) {
    const std::int64_t from = single ? k : sources->starts[k];
    const std::int64_t to = single ? k + 1 : sources->starts[k + 1];
    if (from < 0 || to <= from || to > sources->count) {
      return bad_argument("sources.starts: set " + std::to_string(k) + " has the points " +
                          std::to_string(from) + " to " + std::to_string(to) + " of " +
                          std::to_string(sources->count));
    }
    for (std::int64_t i = from; i < to; ++i) one.add(points->sets[static_cast<std::size_t>(i)]);
    out.sets.push_back(one.take());
  }
  const auto named = named_sources(sources->text);
  if (!named) return named.error();
  auto each = app::resolve_each(*named, model, progress);
  if (!each) return each.error();
  for (SourceSet& set : each->sets) out.sets.push_back(std::move(set));
  out.warnings.insert(out.warnings.end(), each->warnings.begin(), each->warnings.end());
  return out;
}

}  // namespace geotherm::c
