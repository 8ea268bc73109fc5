// SPDX-License-Identifier: MIT
#include "app/solve_model.h"

#include "app/machine.h"
#include "app/nearest_sources.h"
#include "app/progress_bar.h"
#include "app/resolve_sources.h"
#include "app/solve_steps.h"
#include "solver/core/parallel.h"
#include "solver/core/stopwatch.h"

namespace geotherm::app {

Result<SolveFigures> solve_model(Model model, const MethodOptions& options,
                                 const std::vector<Source>& named, const QueryOptions& query,
                                 const Progress& progress) {
  if (auto pin = check_pin(options.constraint, *model.mesh); !pin) return pin.error();
  auto sources = resolve_sources(named, *model.mesh);
  if (!sources) return sources.error();
  auto method = build_method(model.mesh, options, progress);
  if (!method) return about_model(model.name, method.error());
  if (!report(progress, "solve", 0.9)) return cancelled_error();
  auto result = (*method)->solve(sources->set, query, part_of(progress, 0.9, 1.0));
  if (!result) return about_model(model.name, result.error());

  if (query.nearest && result->nearest_source.empty()) {
    auto nearest = nearest_sources(model.mesh, sources->set, result->distances, options.threads,
                                   with_prefix(progress, "nearest sources: "));
    if (!nearest) return about_model(model.name, nearest.error());
    result->nearest_source = *std::move(nearest);
  }

  const double peak = peak_rss_mb();  // of the solve, not of the report
  const Stopwatch watch;
  const MeshSummary mesh = summarize_mesh(*model.mesh, thread_count(options.threads));
  SolveFigures figures{std::move(model),
                       mesh,
                       *std::move(method),
                       options,
                       std::move(sources->set),
                       *std::move(result),
                       {},
                       peak,
                       {}};
  figures.report_ms = watch.milliseconds();
  figures.distance = summarize(figures.result.distances);
  const auto add_warnings = [&figures](const std::vector<std::string>& more) {
    figures.warnings.insert(figures.warnings.end(), more.begin(), more.end());
  };
  add_warnings(figures.model.notes);
  add_warnings(figures.method->warnings());
  add_warnings(sources->warnings);
  add_warnings(figures.result.warnings);
  add_warnings(unreached_notes(figures.mesh, figures.distance.unreached));
  return figures;
}

}  // namespace geotherm::app
