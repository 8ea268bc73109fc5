// SPDX-License-Identifier: MIT
#include "app/solve_model.h"

#include "app/machine.h"
#include "app/resolve_sources.h"
#include "app/text.h"

namespace geotherm::app {
namespace {

/// What the library finds wrong with a mesh is a failure of the work, not of the command line.
Error about_model(const std::string& name, const Error& error) {
  const ErrorCode code = error.code == ErrorCode::kBadInput ? ErrorCode::kBadFile : error.code;
  return {code, one_line(name) + ": " + error.message};
}

Result<void> check_pin(const Constraint& constraint, const TriangleMesh& mesh) {
  if (constraint.mode != ConstraintMode::kPinVertex || constraint.pin_vertex == kNoIndex) return {};
  const Source pin{VertexList{{constraint.pin_vertex}},
                   "--constraint pin-vertex:" + std::to_string(constraint.pin_vertex),
                   ErrorCode::kBadInput};
  const auto placed = resolve_sources({&pin, 1}, mesh);
  if (!placed) return placed.error();
  return {};
}

void note_unreached(SolveFigures& figures) {
  const Index loose = figures.mesh.unreferenced_vertices;
  if (loose > 0) {
    figures.warnings.push_back(counted(loose, "vertex belongs", "vertices belong") +
                               " to no face; their distance is infinite");
  }
  const Index lost = figures.distance.unreached - loose;
  if (lost > 0) {
    figures.warnings.push_back(counted(lost, "vertex lies", "vertices lie") +
                               " in components without a source (there are " +
                               counted(figures.mesh.components, "component", "components") +
                               "); their distance is infinite");
  }
}

}  // namespace

Result<SolveFigures> solve_model(Model model, const HeatOptions& options,
                                 const std::vector<Source>& named, const QueryOptions& query,
                                 const Progress& progress) {
  if (auto pin = check_pin(options.constraint, *model.mesh); !pin) return pin.error();
  auto sources = resolve_sources(named, *model.mesh);
  if (!sources) return sources.error();
  auto method = HeatMethod::build(model.mesh, options, progress);
  if (!method) return about_model(model.name, method.error());
  if (!report(progress, "solve", 0.9))
    return Error{ErrorCode::kCancelled, "the work was cancelled"};
  auto result = method->solve(sources->set, query);
  if (!result) return about_model(model.name, result.error());

  const double peak = peak_rss_mb();  // of the solve, not of the report
  const MeshReport mesh = inspect_mesh(*model.mesh);
  SolveFigures figures{std::move(model),
                       mesh,
                       *std::move(method),
                       std::move(sources->set),
                       *std::move(result),
                       {},
                       peak,
                       {}};
  figures.distance = summarize(figures.result.distances);
  const auto add_warnings = [&figures](const std::vector<std::string>& more) {
    figures.warnings.insert(figures.warnings.end(), more.begin(), more.end());
  };
  add_warnings(figures.model.notes);
  add_warnings(figures.method.warnings());
  add_warnings(sources->warnings);
  add_warnings(figures.result.warnings);
  note_unreached(figures);
  return figures;
}

}  // namespace geotherm::app
