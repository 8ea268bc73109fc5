// SPDX-License-Identifier: MIT
// Means and medians of points, and points moved to the means of their cells.
#include <limits>
#include <memory>
#include <utility>

#include "app/c/handles.h"
#include "geotherm/directions.h"

namespace geotherm::c {
namespace {

/// The arrays points, faces and weights.
void keep_points(const Answer& answer, const TriangleMesh& mesh,
                 std::span<const SurfacePoint> points) {
  std::vector<double> places, weights;
  std::vector<Index> faces;
  for (const SurfacePoint& point : points) {
    const Vec3 place = position_at(mesh, point);
    places.insert(places.end(), place.begin(), place.end());
    const SurfacePoint in_face = points_in_faces(mesh, {{point}, {}, 0, false}).front();
    faces.push_back(in_face.face);
    weights.insert(weights.end(), in_face.weights.begin(), in_face.weights.end());
  }
  keep(answer, "points", std::move(places), 3);
  keep(answer, "faces", std::move(faces));
  keep(answer, "weights", std::move(weights), 3);
}

Result<CentreOptions> centre_options(const char* kind, const char* method) {
  CentreOptions options;
  if (kind != nullptr) {
    const auto parsed = parse<CentreKind>(kind);
    if (!parsed) return parsed.error();
    options.kind = *parsed;
  }
  if (method != nullptr) {
    const auto parsed = parse<MethodKind>(method);
    if (!parsed) return parsed.error();
    options.method = *parsed;
  }
  return options;
}

/// The solver's method, or wavefront where that is heat.
Result<std::shared_ptr<const DistanceMethod>> method_with_labels(const Solver& solver,
                                                                 const Progress& progress) {
  if (solver.ready.method->heat() == nullptr) return solver.ready.method;
  const auto lock = lock_of(solver, progress);
  if (!lock) return lock.error();
  auto ready =
      solver.solver.prepare(app::better_options(solver.options, MethodKind::kWavefront), progress);
  if (!ready) return ready.error();
  return ready->method;
}

}  // namespace
}  // namespace geotherm::c

using namespace geotherm;     // NOLINT: the functions below are C
using namespace geotherm::c;  // NOLINT

geotherm_status geotherm_centres(const geotherm_model* model, const geotherm_sources* points,
                                 const geotherm_array* weights, const char* kind,
                                 const char* method, const geotherm_watch* watch,
                                 geotherm_answer** centres) {
  auto fill = [&](const HeldModel& held, const Progress& progress, Answer& made) -> Result<void> {
    if (auto surface = app::refuse_space(held, "centres are"); !surface) return surface;
    const auto options = centre_options(kind, method);
    if (!options) return options.error();
    const auto of = points_in_order(points, held, made.warnings, progress);
    if (!of) return of.error();
    std::vector<double> given;
    if (weights != nullptr) {
      auto numbers = numbers_in(*weights, 1, "weights");
      if (!numbers) return numbers.error();
      given = *std::move(numbers);
    }
    const TriangleMesh& mesh = *held.mesh;
    auto found = find_centres(held.mesh, *of, given, *options, progress);
    if (!found) return found.error();
    std::vector<SurfacePoint> at;
    std::vector<double> energies, residuals, distances;
    std::vector<Index> converged;
    for (const Centre& centre : found->found) {
      at.push_back(centre.point);
      energies.push_back(centre.energy);
      residuals.push_back(centre.residual);
      converged.push_back(centre.converged ? 1 : 0);
      distances.insert(distances.end(), centre.distances.begin(), centre.distances.end());
    }
    keep_points(made, mesh, at);
    keep(made, "energies", std::move(energies));
    keep(made, "residuals", std::move(residuals));
    keep(made, "converged", std::move(converged));
    keep(made, "distances", std::move(distances), std::ssize(*of));
    add_warnings(made, found->warnings);
    return {};
  };
  return answering<const HeldModel>(model, "model", centres, "centres", watch, fill);
}

geotherm_status geotherm_relax(const geotherm_solver* solver, const geotherm_sources* points,
                               int64_t steps, const geotherm_watch* watch,
                               geotherm_answer** relaxed) {
  auto fill = [&](const Solver& held, const Progress& progress, Answer& made) -> Result<void> {
    const app::Model& model = held.model();
    if (auto surface = app::refuse_space(model, "samples are"); !surface) return surface;
    const auto begin = points_in_order(points, model, made.warnings, progress);
    if (!begin) return begin.error();
    if (steps < 0 || steps > std::numeric_limits<int>::max()) {
      return bad_argument("steps is " + std::to_string(steps), {"give 0 or more"});
    }
    const auto method = method_with_labels(held, part_of(progress, 0.0, 0.1));
    if (!method) return method.error();
    auto found = relax_points(**method, model.mesh, *begin, static_cast<int>(steps),
                              part_of(progress, 0.1, 1.0), held.options.threads);
    if (!found) return found.error();
    keep_points(made, *model.mesh, found->points);
    keep(made, "distances", std::move(found->distances));
    keep(made, "nearest_source", std::move(found->nearest));
    keep(made, "energies", std::move(found->energies));
    keep(made, "moves", std::move(found->moves));
    keep(made, "settled", std::vector<Index>{found->settled ? 1 : 0});
    return {};
  };
  return answering<const Solver>(solver, "solver", relaxed, "relaxed", watch, fill);
}
