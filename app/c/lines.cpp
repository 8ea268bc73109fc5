// SPDX-License-Identifier: MIT
// Paths, isolines, samples.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "app/c/handles.h"
#include "app/session/wording.h"
#include "geotherm/path.h"
#include "solver/core/text.h"
#include "solver/path/shorten.h"

namespace geotherm::c {
namespace {

using app::Model;

Result<PathField> field_of(const char* text) {
  return text == nullptr ? Result<PathField>(PathField::kGeodesic) : parse<PathField>(text);
}

bool is_near_exact(const Solver& solver) {
  const MethodKind kind = solver.options.method;
  return kind != MethodKind::kHeat && kind != MethodKind::kFastMarching;
}

/// Led by exact distances, whatever the solver's own are.
Result<std::shared_ptr<const PathFinder>> exact_finder_of(const Solver& solver,
                                                          const Progress& progress) {
  if (solver.exact_paths) return solver.exact_paths;
  const auto ready =
      solver.solver.prepare(app::better_options(solver.options, MethodKind::kExact), progress);
  if (!ready) return ready.error();
  solver.exact_paths = std::make_shared<const PathFinder>(solver.model().mesh, ready->method);
  return solver.exact_paths;
}

/// Streamlines follow the solver's own distances, geodesics are led by near-exact ones.
Result<std::shared_ptr<const PathFinder>> finder_of(const Solver& solver, PathField field,
                                                    const Progress& progress) {
  if (field != PathField::kGeodesic) {
    return std::make_shared<const PathFinder>(solver.model().mesh, solver.ready.method);
  }
  if (solver.geodesics) return solver.geodesics;
  auto method = solver.ready.method;
  if (!is_near_exact(solver)) {
    auto ready = solver.solver.prepare(app::better_options(solver.options, MethodKind::kWavefront),
                                       progress);
    if (!ready) return ready.error();
    method = ready->method;
  }
  solver.geodesics = std::make_shared<const PathFinder>(solver.model().mesh, std::move(method));
  return solver.geodesics;
}

/// The geodesics from one point to each of others.
Result<std::vector<Isoline>> tree_of(const PathFinder& finder, const SurfacePoint& from,
                                     std::span<const SurfacePoint> ends,
                                     std::vector<Warning>& warnings, const Progress& progress) {
  std::vector<Isoline> lines;
  const auto count = static_cast<double>(ends.size());
  for (const SurfacePoint& end : ends) {
    const auto done = static_cast<double>(lines.size());
    const std::array<SurfacePoint, 2> stops = {from, end};
    auto found = finder.find(stops, {}, part_of(progress, done / count, (done + 1) / count));
    if (!found) return found.error();
    warnings.insert(warnings.end(), found->warnings.begin(), found->warnings.end());
    lines.push_back({0, std::move(found->path)});
  }
  return lines;
}

}  // namespace

void keep_lines(const Answer& answer) {
  const Lines& lines = *answer.lines;
  std::vector<double> points, weights, lengths, values;
  std::vector<Index> faces, closed;
  std::vector<std::int64_t> starts = {0};
  for (const Isoline& line : lines.all) {
    for (const Vec3& p : positions_of(*lines.mesh, line.path)) {
      points.insert(points.end(), p.begin(), p.end());
    }
    for (const SurfacePoint& point : points_in_faces(*lines.mesh, line.path)) {
      faces.push_back(point.face);
      weights.insert(weights.end(), point.weights.begin(), point.weights.end());
    }
    starts.push_back(std::ssize(faces));
    lengths.push_back(line.path.length);
    closed.push_back(line.path.closed ? 1 : 0);
    values.push_back(line.value);
  }
  keep(answer, "points", std::move(points), 3);
  keep(answer, "faces", std::move(faces));
  keep(answer, "weights", std::move(weights), 3);
  keep(answer, "starts", std::move(starts));
  keep(answer, "lengths", std::move(lengths));
  keep(answer, "closed", std::move(closed));
  if (lines.have_values) keep(answer, "values", std::move(values));
}

Result<std::vector<SurfacePoint>> points_in_order(const geotherm_sources* sources,
                                                  const Model& model,
                                                  std::vector<Warning>& warnings,
                                                  const Progress& progress) {
  const auto each = many_sets(sources, model, progress);
  if (!each) return each.error();
  warnings.insert(warnings.end(), each->warnings.begin(), each->warnings.end());
  std::vector<SurfacePoint> points;
  for (const SourceSet& set : each->sets) {
    const SurfacePoint* const point = app::only_point(set);
    if (point == nullptr || !set.offsets.empty()) {
      return bad_argument(
          "point " + std::to_string(points.size()) +
              (point == nullptr ? " is several, or none"
                                : " has the offset " + number_text(set.offsets.front())),
          {"give a vertex, a point in a face or a place, without offset"});
    }
    points.push_back(*point);
  }
  return points;
}

}  // namespace geotherm::c

using namespace geotherm;     // NOLINT: the functions below are C
using namespace geotherm::c;  // NOLINT

geotherm_status geotherm_path(const geotherm_solver* solver, const geotherm_sources* through,
                              const char* field, int closed, const geotherm_watch* watch,
                              geotherm_answer** lines) {
  auto fill = [&](const Solver& held, const Progress& progress, Answer& made) -> Result<void> {
    const auto follows = field_of(field);
    if (!follows) return follows.error();
    const bool loose = closed == 2;
    if (closed < 0 || closed > 2 || (loose && *follows != PathField::kGeodesic)) {
      return bad_argument("closed is " + std::to_string(closed),
                          {"give 0, 1 or, for a geodesic, 2"});
    }
    const Model& model = held.model();
    if (auto surface = app::refuse_space(model, "paths are"); !surface) return surface;
    const auto points = points_in_order(through, model, made.warnings, progress);
    if (!points) return points.error();
    auto lock = lock_of(held, progress);
    if (!lock) return lock.error();
    const auto finder = finder_of(held, *follows, part_of(progress, 0.0, 0.5));
    lock->unlock();
    if (!finder) return finder.error();
    PathOptions options;
    options.field = *follows;
    options.closed = closed == 1;
    auto found = (*finder)->find(*points, options, part_of(progress, 0.5, 0.9));
    if (!found) return found.error();
    if (loose) {
      auto shorter = shorten((*finder)->surface(), found->path, false, part_of(progress, 0.9, 1.0));
      if (!shorter) return shorter.error();
      found->path = *std::move(shorter);
    }
    add_warnings(made, found->warnings);
    made.lines = Lines{model.mesh, {{0, std::move(found->path)}}, false};
    keep_lines(made);
    return {};
  };
  return answering<const Solver>(solver, "solver", lines, "lines", watch, fill);
}

geotherm_status geotherm_paths(const geotherm_solver* solver, const geotherm_sources* from,
                               const geotherm_sources* to, const geotherm_watch* watch,
                               geotherm_answer** lines) {
  auto fill = [&](const Solver& held, const Progress& progress, Answer& made) -> Result<void> {
    const Model& model = held.model();
    if (auto surface = app::refuse_space(model, "paths are"); !surface) return surface;
    const auto begin = points_in_order(from, model, made.warnings, progress);
    if (!begin) return begin.error();
    const auto ends = points_in_order(to, model, made.warnings, progress);
    if (!ends) return ends.error();
    if (begin->size() != 1 || ends->empty()) {
      return bad_argument("from has " + std::to_string(begin->size()) + " points, and to " +
                              std::to_string(ends->size()),
                          {"give one, and one or more"});
    }
    const auto led_by = [&](bool exact) -> Result<std::vector<Isoline>> {
      const auto prepared = [&]() -> Result<std::shared_ptr<const PathFinder>> {
        const auto lock = lock_of(held, progress);
        if (!lock) return lock.error();
        const Progress part = part_of(progress, 0.0, 0.5);
        return exact ? exact_finder_of(held, part) : finder_of(held, PathField::kGeodesic, part);
      };
      const auto finder = prepared();
      if (!finder) return finder.error();
      return tree_of(**finder, begin->front(), *ends, made.warnings, part_of(progress, 0.5, 1.0));
    };
    const bool exact = !is_near_exact(held) && app::exact_leads_tree(ends->size(), model);
    auto found = led_by(exact);
    if (exact && !found && found.error().code == ErrorCode::kBudgetEnded) found = led_by(false);
    if (!found) return found.error();
    made.lines = Lines{model.mesh, *std::move(found), false};
    keep_lines(made);
    return {};
  };
  return answering<const Solver>(solver, "solver", lines, "lines", watch, fill);
}

geotherm_status geotherm_isolines(const geotherm_model* model, const geotherm_array* values,
                                  const geotherm_array* levels, const geotherm_watch* watch,
                                  geotherm_answer** lines) {
  auto fill = [&](const HeldModel& held, const Progress& progress, Answer& made) -> Result<void> {
    if (auto there = require(values, "values"); !there) return there;
    if (auto there = require(levels, "levels"); !there) return there;
    if (auto there = require_places(held); !there) return there;
    const TriangleMesh& mesh = *held.mesh;
    const auto at_vertices = numbers_in(*values, 1, "values");
    if (!at_vertices) return at_vertices.error();
    if (std::ssize(*at_vertices) != mesh.vertex_count()) {
      return bad_argument("values has " + std::to_string(at_vertices->size()) +
                          " numbers, and the model " + std::to_string(mesh.vertex_count()) +
                          " vertices");
    }
    const auto asked = numbers_in(*levels, 1, "levels");
    if (!asked) return asked.error();
    for (std::size_t i = 0; i < asked->size(); ++i) {
      const double level = (*asked)[i];
      if (std::isfinite(level) && (i == 0 || level >= (*asked)[i - 1])) continue;
      return bad_argument("levels: number " + std::to_string(i) + " is " + number_text(level) +
                              (i == 0 ? "" : ", after " + number_text((*asked)[i - 1])),
                          {"give finite numbers that ascend"});
    }
    auto found = find_isolines(mesh, *at_vertices, *asked, progress);
    if (!found) return found.error();
    made.lines = Lines{held.mesh, *std::move(found), true};
    keep_lines(made);
    return {};
  };
  return answering<const HeldModel>(model, "model", lines, "lines", watch, fill);
}

geotherm_status geotherm_samples(const geotherm_solver* solver, int64_t count, int64_t first,
                                 const geotherm_watch* watch, geotherm_answer** samples) {
  auto fill = [&](const Solver& held, const Progress& progress, Answer& made) -> Result<void> {
    const Model& model = held.model();
    if (auto surface = app::refuse_space(model, "samples are"); !surface) return surface;
    const Index vertices = model.mesh->vertex_count();
    if (count < 1 || count > vertices) {
      return bad_argument("count is " + std::to_string(count),
                          {"give 1 to " + std::to_string(vertices) + ", the number of vertices"});
    }
    if (first < kNoIndex || first >= vertices) {
      return bad_argument("first: there is no vertex " + std::to_string(first),
                          {"vertices are 0 to " + std::to_string(vertices - 1)});
    }
    auto found = farthest_points(*held.ready.method, *model.mesh, static_cast<Index>(count),
                                 {static_cast<Index>(first)}, progress);
    if (!found) return found.error();
    std::vector<Index> chosen;
    std::vector<double> radius;
    for (const FarthestSample& sample : found->samples) {
      chosen.push_back(sample.vertex);
      radius.push_back(sample.radius);
    }
    keep(made, "vertices", std::move(chosen));
    keep(made, "radius", std::move(radius));
    keep(made, "distances", std::move(found->distances));
    keep(made, "nearest_source", std::move(found->nearest));
    made.warnings = std::move(found->first.warnings);
    return {};
  };
  return answering<const Solver>(solver, "solver", samples, "samples", watch, fill);
}
