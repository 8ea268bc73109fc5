// SPDX-License-Identifier: MIT
// Log maps, straightest lines, vectors and values carried over a surface.
#include "geotherm/directions.h"

#include <memory>
#include <utility>

#include "app/c/handles.h"

namespace geotherm::c {
namespace {

/// One point of a triangle mesh with what directions there need.
struct DirectedPoint {
  SurfacePoint point;
  std::shared_ptr<const Directions> directions;
};

Result<DirectedPoint> directed_point(const HeldModel& model, const geotherm_sources* point,
                                     const char* what, std::vector<Warning>& warnings,
                                     const Progress& progress) {
  if (auto surface = app::refuse_space(model, what); !surface) return surface.error();
  const auto points = points_in_order(point, model, warnings, progress);
  if (!points) return points.error();
  if (points->size() != 1) {
    return bad_argument("point has " + std::to_string(points->size()) + " points", {"give one"});
  }
  auto directions = model.directions(progress);
  if (!directions) return directions.error();
  return DirectedPoint{points->front(), *std::move(directions)};
}

void add_frame(const TangentFrame& frame, std::vector<double>& out) {
  for (const Vec3& axis : {frame.e1, frame.e2, frame.normal}) {
    out.insert(out.end(), axis.begin(), axis.end());
  }
}

Result<SpreadOptions> spread_options(const geotherm_options* options) {
  const auto state = state_of(options);
  if (!state) return state.error();
  const MethodOptions& asked = state->options;
  return SpreadOptions{asked.backend, asked.time_step.factor, asked.threads};
}

/// Each set of points as one curve, which may pass a point several times.
Result<std::vector<SurfacePath>> curves_of(const geotherm_sources* sources, bool closed,
                                           const HeldModel& model, std::vector<Warning>& warnings,
                                           const Progress& progress) {
  const auto sets = many_sets(sources, model, progress);
  if (!sets) return sets.error();
  if (sources->text != nullptr && *sources->text != '\0') {
    return bad_argument("a signed distance takes the points of its curves, not sources as text",
                        {"give the points of each curve in order"});
  }
  if (sources->starts == nullptr) {
    return bad_argument("each of the curves has one point, and a curve needs two or more",
                        {"give all points of each"});
  }
  const auto finder = model.curve_finder(part_of(progress, 0.0, 0.3));
  if (!finder) return finder.error();
  std::vector<SurfacePath> curves;
  const auto count_of_sets = static_cast<double>(sources->sets);
  for (std::int64_t k = 0; k < sources->sets; ++k) {
    const double done = static_cast<double>(k) / count_of_sets;
    const Progress part = part_of(part_of(progress, 0.3, 1.0), done, done + 1 / count_of_sets);
    const std::int64_t from = sources->starts[k], count = sources->starts[k + 1] - from;
    const geotherm_sources stops = {sources->points + from, count, nullptr, 0, nullptr};
    const auto points = points_in_order(&stops, model, warnings, progress);
    if (!points) return points.error();
    auto found = (*finder)->find(*points, {PathField::kGeodesic, closed, closed}, part);
    if (!found) return found.error();
    curves.push_back(std::move(found->path));
  }
  return curves;
}

/// What transport and extend have in common.
struct SpreadCall {
  std::vector<Index> vertices;
  std::vector<double> numbers;
  std::shared_ptr<const VectorHeat> heat;
};

Result<SpreadCall> spread_call(const HeldModel& model, const geotherm_options* options,
                               const geotherm_array* vertices, const geotherm_array* numbers,
                               std::int64_t columns, const char* name, const Progress& progress) {
  if (auto there = require(vertices, "vertices"); !there) return there.error();
  if (auto there = require(numbers, name); !there) return there.error();
  if (auto surface = app::refuse_space(model, "carried vectors and values are"); !surface) {
    return surface.error();
  }
  const auto spread = spread_options(options);
  if (!spread) return spread.error();
  auto at = indices_in(*vertices, 1, "vertices");
  if (!at) return at.error();
  auto values = numbers_in(*numbers, columns, name);
  if (!values) return values.error();
  if (std::ssize(*values) != columns * std::ssize(*at)) {
    return bad_argument(std::string(name) + " has " +
                        std::to_string(std::ssize(*values) / columns) + " rows for " +
                        std::to_string(at->size()) + " vertices");
  }
  auto heat = model.vector_heat(*spread, part_of(progress, 0, 0.7));
  if (!heat) return heat.error();
  return SpreadCall{*std::move(at), *std::move(values), *std::move(heat)};
}

}  // namespace

// Nothing is locked while it is made: the caller's progress may ask the same model.
Result<std::shared_ptr<const Directions>> HeldModel::directions(const Progress& progress) const {
  {
    const std::lock_guard lock(lock_);
    if (directions_) return directions_;
  }
  auto made = Directions::build(mesh, progress);
  if (!made) return made;
  const std::lock_guard lock(lock_);
  directions_ = *made;
  return made;
}

Result<std::shared_ptr<const VectorHeat>> HeldModel::vector_heat(const SpreadOptions& options,
                                                                 const Progress& progress) const {
  {
    const std::lock_guard lock(lock_);
    if (heat_ && heat_options_ == options) return heat_;
  }
  std::shared_ptr<const DistanceMethod> beside;
  {
    const std::lock_guard lock(lock_);
    beside = solver_method_.lock();
  }
  auto made = VectorHeat::build(mesh, options, progress, beside ? beside->heat() : nullptr);
  if (!made) return made;
  const std::lock_guard lock(lock_);
  heat_ = *made;
  heat_options_ = options;
  return made;
}

Result<std::shared_ptr<const PathFinder>> HeldModel::curve_finder(const Progress& progress) const {
  {
    const std::lock_guard lock(lock_);
    if (finder_) return finder_;
  }
  MethodOptions options;
  options.method = MethodKind::kWavefront;
  app::ModelSolver solver(*this);
  const auto ready = solver.prepare(options, progress);
  if (!ready) return ready.error();
  auto made = std::make_shared<const PathFinder>(mesh, ready->method);
  const std::lock_guard lock(lock_);
  finder_ = made;
  return made;
}

void HeldModel::note_method(const std::shared_ptr<const DistanceMethod>& method) const {
  const std::lock_guard lock(lock_);
  solver_method_ = method;
}

}  // namespace geotherm::c

using namespace geotherm;     // NOLINT: the functions below are C
using namespace geotherm::c;  // NOLINT

geotherm_status geotherm_log_map(const geotherm_model* model, const geotherm_sources* point,
                                 const char* method, double max_distance,
                                 const geotherm_watch* watch, geotherm_answer** map) {
  auto fill = [&](const HeldModel& held, const Progress& progress, Answer& made) -> Result<void> {
    LogMapOptions options;
    if (method != nullptr) {
      const auto kind = parse<MethodKind>(method);
      if (!kind) return kind.error();
      options.method = *kind;
    }
    options.max_distance = max_distance;
    const auto from =
        directed_point(held, point, "log maps are", made.warnings, part_of(progress, 0.0, 0.2));
    if (!from) return from.error();
    auto found = from->directions->log_map(from->point, options, part_of(progress, 0.2, 1.0));
    if (!found) return found.error();
    std::vector<double> frame;
    add_frame(found->frame, frame);
    keep(made, "frame", std::move(frame), 9);
    keep(made, "distances", std::move(found->distances));
    keep(made, "directions", std::move(found->directions));
    add_warnings(made, found->warnings);
    return {};
  };
  return answering<const HeldModel>(model, "model", map, "the answer", watch, fill);
}

geotherm_status geotherm_trace(const geotherm_model* model, const geotherm_sources* point,
                               double direction, double length, const geotherm_watch* watch,
                               geotherm_answer** line) {
  auto fill = [&](const HeldModel& held, const Progress& progress, Answer& made) -> Result<void> {
    const auto from = directed_point(held, point, "straightest lines are", made.warnings,
                                     part_of(progress, 0.0, 0.5));
    if (!from) return from.error();
    auto found =
        from->directions->trace(from->point, direction, length, part_of(progress, 0.5, 1.0));
    if (!found) return found.error();
    made.texts = {{"end", to_text(found->end)}};
    made.lines = Lines{held.mesh, {{0, std::move(found->path)}}, false};
    keep_lines(made);
    return {};
  };
  return answering<const HeldModel>(model, "model", line, "the answer", watch, fill);
}

geotherm_status geotherm_transport(const geotherm_model* model, const geotherm_options* options,
                                   const geotherm_array* vertices, const geotherm_array* vectors,
                                   const geotherm_watch* watch, geotherm_answer** answer) {
  auto fill = [&](const HeldModel& held, const Progress& progress, Answer& made) -> Result<void> {
    const auto asked = spread_call(held, options, vertices, vectors, 2, "vectors", progress);
    if (!asked) return asked.error();
    std::vector<TangentVector> given;
    for (std::size_t i = 0; i < asked->vertices.size(); ++i) {
      given.push_back({asked->vertices[i], asked->numbers[2 * i], asked->numbers[2 * i + 1]});
    }
    auto found = asked->heat->transport(given, part_of(progress, 0.7, 1.0));
    if (!found) return found.error();
    const auto tangents = asked->heat->frames();
    if (!tangents) return tangents.error();
    std::vector<double> space, components, frames;
    for (const Vec3& v : found->vectors) space.insert(space.end(), v.begin(), v.end());
    for (const auto& v : found->components) components.insert(components.end(), v.begin(), v.end());
    for (const TangentFrame& frame : *tangents) add_frame(frame, frames);
    keep(made, "vectors", std::move(space), 3);
    keep(made, "components", std::move(components), 2);
    keep(made, "frames", std::move(frames), 9);
    made.warnings = std::move(found->warnings);
    return {};
  };
  return answering<const HeldModel>(model, "model", answer, "answer", watch, fill);
}

geotherm_status geotherm_extend(const geotherm_model* model, const geotherm_options* options,
                                const geotherm_array* vertices, const geotherm_array* values,
                                const geotherm_watch* watch, geotherm_answer** answer) {
  auto fill = [&](const HeldModel& held, const Progress& progress, Answer& made) -> Result<void> {
    const auto asked = spread_call(held, options, vertices, values, 1, "values", progress);
    if (!asked) return asked.error();
    auto found = asked->heat->extend(asked->vertices, asked->numbers, part_of(progress, 0.7, 1.0));
    if (!found) return found.error();
    keep(made, "values", std::move(found->values));
    made.warnings = std::move(found->warnings);
    return {};
  };
  return answering<const HeldModel>(model, "model", answer, "answer", watch, fill);
}

geotherm_status geotherm_signed_distance(const geotherm_model* model,
                                         const geotherm_options* options,
                                         const geotherm_sources* curves, int closed,
                                         const char* rule, const geotherm_watch* watch,
                                         geotherm_answer** answer) {
  auto fill = [&](const HeldModel& held, const Progress& progress, Answer& made) -> Result<void> {
    if (auto surface = app::refuse_space(held, "signed distances are"); !surface) return surface;
    const auto side = rule == nullptr ? Result<SideRule>(SideRule::kAuto) : parse<SideRule>(rule);
    if (!side) return side.error();
    const auto spread = spread_options(options);
    if (!spread) return spread.error();
    const auto lines =
        curves_of(curves, closed != 0, held, made.warnings, part_of(progress, 0.0, 0.3));
    if (!lines) return lines.error();
    const SignedSetup setup = {
        [&](const Progress& part) { return held.directions(part); },
        [&](const Progress& part) { return held.vector_heat(*spread, part); }};
    auto found = signed_distance(setup, *lines, *side, part_of(progress, 0.3, 1.0));
    if (!found) return found.error();
    keep(made, "distances", std::move(found->distances));
    made.texts = {{"rule", to_text(found->rule)}};
    add_warnings(made, found->warnings);
    return {};
  };
  return answering<const HeldModel>(model, "model", answer, "answer", watch, fill);
}
