// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>

#include "app/cli/commands.h"
#include "app/cli/study.h"
#include "app/picture/chart.h"
#include "app/session/answer.h"
#include "app/session/outputs.h"
#include "app/session/sources.h"
#include "app/text/text.h"
#include "geotherm/accuracy.h"
#include "geotherm/options.h"
#include "solver/core/text.h"

namespace geotherm::app {
namespace {

using chart::Panel;
using chart::Series;

std::string tick_percent(double error) { return significant(100 * error, 2) + " %"; }

/// No powers of ten in letters where digits are as short.
std::string tick_number(double value) {
  return value >= 1 && value < 1e5 ? grouped(std::llround(value)) : significant(value, 2);
}

/// A class of the style sheet: a colour, and dashes, so that curves that lie on each other can be
/// told apart.
std::string kind_of(std::size_t colour, std::size_t dashes) {
  return "k" + std::to_string(colour) + " d" + std::to_string(dashes);
}

/// The curve of the rows that `belongs` takes.
template <class Belongs, class X>
Series series_of(const Study& study, std::string name, std::string kind, Belongs belongs, X x) {
  Series series{.kind = std::move(kind), .name = std::move(name)};
  for (const StudyRow& row : study.rows) {
    if (!belongs(row) || !row.mean_error) continue;
    series.joined.push_back({x(row), *row.mean_error, chart::Mark::kSmallDot});
  }
  std::ranges::sort(series.joined, {}, &chart::Point::x);
  return series;
}

Panel panel_of(std::string title, std::string x_label) {
  return {std::move(title), std::move(x_label), tick_number, tick_percent, {}, {}, 1};
}

/// One curve for each time rule and boundary rule, with the default constraint.
template <class X>
Panel rules_panel(const Study& study, std::string title, std::string x_label, X x) {
  Panel panel = panel_of(std::move(title), std::move(x_label));
  std::size_t colour = 0;
  for (const TimeRule rule : {TimeRule::kMeanEdge, TimeRule::kMeanFaceArea}) {
    std::size_t dashes = 0;
    for (const BoundaryRule boundary :
         {BoundaryRule::kNeumann, BoundaryRule::kDirichlet, BoundaryRule::kAverage}) {
      const auto belongs = [&](const StudyRow& row) {
        return row.rule == rule && row.boundary == boundary &&
               row.constraint == ConstraintMode::kPinSources;
      };
      const std::string kind = kind_of(colour, dashes++);
      if (std::ranges::none_of(study.rows, belongs)) continue;
      panel.series.push_back(series_of(
          study, to_text(TimeStep{rule, 1, 0}) + ", " + to_text(boundary), kind, belongs, x));
    }
    ++colour;
  }
  return panel;
}

Panel constraints_panel(const Study& study) {
  Panel panel = panel_of("Constraint modes, mean-edge", "time factor m");
  std::size_t i = 0;
  for (const Constraint& constraint : study_constraints()) {
    const auto belongs = [&](const StudyRow& row) {
      return row.rule == TimeRule::kMeanEdge && row.boundary == BoundaryRule::kNeumann &&
             row.constraint == constraint.mode;
    };
    panel.series.push_back(series_of(study, to_text(constraint), kind_of(i, i), belongs,
                                     [](const StudyRow& row) { return row.factor; }));
    ++i;
  }
  return panel;
}

}  // namespace

std::string study_svg(const std::string& model, const Study& study) {
  constexpr double kWidth = 290, kHeight = 250, kLeft = 62, kTop = 110, kStep = 370;
  std::vector<Panel> panels = {
      rules_panel(study, "Both time rules over m", "time factor m",
                  [](const StudyRow& row) { return row.factor; }),
      rules_panel(study, "The same over t: one curve", "t / h\u00b2, h the mean edge length",
                  [](const StudyRow& row) { return row.unit_t; }),
      constraints_panel(study)};
  std::vector<double> errors;
  for (const StudyRow& row : study.rows) errors.push_back(row.mean_error.value_or(0));
  const StudyRow* best = best_row(study);
  const std::string found = best == nullptr
                                ? ""
                                : "; least: " + percent_text(*best->mean_error) +
                                      " at t = " + significant(best->unit_t, 3) + " h\u00b2";
  std::string body =
      chart::text(kLeft, 36, "start", "head",
                  "Mean error of the heat method on " + one_line(model)) +
      chart::text(kLeft, 60, "start", "soft", "against " + to_text(study.reference) + found);
  double left = kLeft;
  for (Panel& panel : panels) {
    panel.y_values = errors;
    body += panel_svg(panel, {left, kTop, kWidth, kHeight});
    left += kStep;
  }
  return chart::page(1110, 560, body);
}

namespace {

constexpr double kMinFactor = 1e-6, kMaxFactor = 1e6;
constexpr int kMaxFactors = 200;

/// LEAST:MOST:COUNT.
Result<std::vector<double>> parse_factors(const std::string& text) {
  const std::vector<std::string_view> parts = split(text, ':');
  if (parts.size() == 3) {
    const auto least = number_in<double>(parts[0]), most = number_in<double>(parts[1]);
    const auto count = number_in<int>(parts[2]);
    if (least && most && count && *least >= kMinFactor && *most <= kMaxFactor && *least < *most &&
        *count >= 2 && *count <= kMaxFactors) {
      return study_factors(*least, *most, *count);
    }
  }
  return Error{ErrorCode::kBadInput,
               "--factors: '" + one_line(text) + "' is no range of time factors",
               {"write LEAST:MOST:COUNT such as 0.1:100:13, within 1e-6 to 1e6, COUNT 2 to 200"}};
}

Result<SourceSet> sources_on(const Model& model, const std::vector<Source>& named,
                             std::vector<Warning>& warnings) {
  if (named.empty()) {
    const auto vertex = random_vertices(model, 1, 1);
    if (!vertex) return about_model(model.name, vertex.error());
    warnings.push_back(
        {"no source was given: vertex " + std::to_string(vertex->front()) + " was taken",
         {"choose others with -s"}});
    return SourceSet::of_vertices(*vertex);
  }
  auto resolved = resolve_sources(named, model);
  if (!resolved) return resolved.error();
  warnings.insert(warnings.end(), resolved->warnings.begin(), resolved->warnings.end());
  return std::move(resolved->set);
}

Result<void> expect_outputs(const StudyArguments& arguments, Outputs& outputs) {
  if (!arguments.svg.empty() && arguments.svg != "-" &&
      io::file_extension(arguments.svg) != ".svg") {
    return Error{ErrorCode::kBadInput,
                 "--svg: " + one_line(arguments.svg) + ": the plot is written as .svg"};
  }
  if (auto fits = expect_report(arguments.json, outputs); !fits) return fits;
  return expect_report(arguments.svg, outputs, "--svg");
}

}  // namespace

void add_study_options(CLI::App& command, StudyArguments& arguments) {
  add_model_option(command, arguments.model, arguments.settings)->required();
  command
      .add_option("--factors", arguments.factors,
                  "time factors m that are tried, the same ratio apart, default 0.1:100:13")
      ->type_name("LEAST:MOST:COUNT");
  add_json_option(command, arguments.json);
  command.add_option("--svg", arguments.svg, "the error as curves, .svg; - is standard output")
      ->type_name("FILE");
  add_quiet_option(command, arguments.quiet);
  add_source_options(command, arguments.sources);
  add_setting_options(command, arguments.settings,
                      names_of(SettingGroup::kMethod, {"method", "time-step", "time-factor",
                                                       "constraint", "boundary"}));  // swept
  command.footer(
      "Sweeps m over both time rules, all constraint modes and, where there is a boundary, the "
      "boundary rules; each answer is held against exact distances, or wavefront-fine on large "
      "meshes, and in volumes, grids and on polygons against their near-exact method.\n"
      "Examples:\n"
      "  geotherm study bunny -s 0 --svg study.svg\n"
      "  geotherm study terrain -s boundary --variant classic --json -");
}

Result<CommandOutput> run_study(const StudyArguments& arguments, const Progress& progress) {
  StudyTask task;
  const auto asked = settings_in(arguments.settings);
  if (!asked) return asked.error();
  const MethodOptions& options = asked->options;
  task.options = options;
  auto factors = parse_factors(arguments.factors);
  if (!factors) return factors.error();
  task.factors = *std::move(factors);
  Outputs outputs;
  if (auto expected = expect_outputs(arguments, outputs); !expected) return expected.error();
  const auto named = sources_of(arguments.sources);
  if (!named) return named.error();
  const auto model = load_model(arguments.model, asked->reading, progress);
  if (!model) return model.error();
  CommandOutput out{"", model->notes, {}};
  auto sources = sources_on(*model, *named, out.warnings);
  if (!sources) return sources.error();
  task.sources = *std::move(sources);
  bool has_boundary = model->space && !model->space->boundary_vertices().empty();
  if (!model->space) {
    const MeshReport mesh = inspect_mesh(*model->mesh);
    task.mean_edge = mesh.mean_edge_length;
    has_boundary = mesh.boundary_edges > 0;
  }
  task.boundaries = {BoundaryRule::kNeumann};
  if (has_boundary) {
    task.boundaries.insert(task.boundaries.end(),
                           {BoundaryRule::kDirichlet, BoundaryRule::kAverage});
  }
  const auto study = study_of(*model, task, progress);
  if (!study) return study.error();
  if (!outputs.uses_stdout()) out.text = study_table(model->name, *study);
  const auto write = [&](const std::string& path, std::string text) -> Result<void> {
    return path.empty() ? Result<void>() : outputs.write_text(path, std::move(text), out.text);
  };
  const std::string json = report_text(study_json(model->name, task.sources, *study));
  if (auto done = write(arguments.json, json); !done) return done.error();
  if (auto done = write(arguments.svg, study_svg(model->name, *study)); !done) return done.error();
  out.made = outputs.made();
  return out;
}

}  // namespace geotherm::app
