// SPDX-License-Identifier: MIT
#include <unistd.h>

#include <CLI/CLI.hpp>

#include <algorithm>

#include "app/cli/commands.h"
#include "app/session/compare.h"
#include "app/session/model.h"
#include "app/session/outputs.h"
#include "app/session/sources.h"
#include "app/session/wording.h"
#include "app/text/text.h"
#include "geotherm/backend.h"

namespace geotherm::app {
namespace {

constexpr Index kBatch = 16;
constexpr Index kMaxQueries = 100'000;
constexpr std::uint64_t kSeed = 1;

struct Plan {
  CompareTask task;  ///< but for the sources, which need the mesh
  std::vector<Source> sources;
  ModelReading reading;
  Index queries = 0;
};

bool is_in(const std::vector<MethodOptions>& solvers, const std::string& name) {
  return std::ranges::any_of(
      solvers, [&](const MethodOptions& solver) { return solver_name(solver) == name; });
}

/// The solvers that were asked for, the reference among them.
Result<void> choose_solvers(const CompareArguments& arguments, const MethodOptions& options,
                            CompareTask& task) {
  const bool other = options.method != MethodKind::kHeat;
  std::string names = arguments.backends;
  if (other) names = to_text(options.method) + (names == "all" ? "" : "," + names);
  auto solvers = solvers_named(names, options);
  if (!solvers) {
    return about("--backends", solvers.error(), ErrorCode::kNotAvailable);
  }
  task.solvers = *std::move(solvers);
  task.reference =
      arguments.reference.empty() ? solver_name(task.solvers.front()) : arguments.reference;
  if (is_in(task.solvers, task.reference)) return {};
  const auto reference = solvers_named(task.reference, options);
  if (!reference) {
    return about("--reference", reference.error(), ErrorCode::kNotAvailable);
  }
  task.solvers.insert(task.solvers.begin(), reference->front());
  return {};
}

/// Finds what is wrong with the command line before any work is done.
Result<Plan> plan_of(const CompareArguments& arguments) {
  Plan plan;
  const auto asked = settings_in(arguments.settings);
  if (!asked) return asked.error();
  const MethodOptions& options = asked->options;
  if (auto chosen = choose_solvers(arguments, options, plan.task); !chosen) return chosen.error();
  plan.reading = asked->reading;
  const auto queries =
      whole_in("--queries", arguments.queries, "number of queries", 1, kMaxQueries);
  if (!queries) return queries.error();
  plan.queries = *queries;
  auto sources = sources_of(arguments.sources);
  if (!sources) return sources.error();
  plan.sources = *std::move(sources);
  for (const std::string& model : arguments.models) {
    const bool there =
        is_bundled(model) ? bundled_file(model).has_value() : ::access(model.c_str(), R_OK) == 0;
    if (there || model == kStandardInput) continue;
    const auto missing = load_model(model);  // for its message
    if (!missing) return missing.error();
  }
  return plan;
}

Result<void> expect_outputs(const CompareArguments& arguments, Outputs& outputs) {
  if (auto fits = expect_report(arguments.json, outputs); !fits) return fits;
  if (auto fits = expect_report(arguments.csv, outputs, "--csv"); !fits) return fits;
  return expect_report(arguments.html, outputs, "--html");
}

/// The sources that were named, the same for each query; or single vertices at random.
Result<void> choose_sources(const Model& model, const Plan& plan, CompareTask& task,
                            std::vector<Warning>& warnings) {
  if (!plan.sources.empty()) {
    auto resolved = resolve_sources(plan.sources, model);
    if (!resolved) return about(one_line(model.name), resolved.error());
    warnings.insert(warnings.end(), resolved->warnings.begin(), resolved->warnings.end());
    task.queries.assign(static_cast<std::size_t>(plan.queries), resolved->set);
    task.batch.assign(kBatch, resolved->set);
    return {};
  }
  const auto pool = random_vertices(
      *model.mesh, std::min(std::max(plan.queries, kBatch), model.mesh->vertex_count()), kSeed);
  const auto vertices = pool ? pool : random_vertices(model, 1, kSeed);
  if (!vertices) {
    return Error{ErrorCode::kBadFile,
                 one_line(model.name) + ": no vertex belongs to a usable face"};
  }
  for (Index i = 0; i < std::max(plan.queries, kBatch); ++i) {
    const Index vertex = (*vertices)[static_cast<std::size_t>(i) % vertices->size()];
    if (i < plan.queries) task.queries.push_back(SourceSet::of_vertices({vertex}));
    if (i < kBatch) task.batch.push_back(SourceSet::of_vertices({vertex}));
  }
  return {};
}

Result<void> write_reports(const CompareArguments& arguments, const std::vector<CompareRow>& rows,
                           Outputs& outputs, CommandOutput& out) {
  const Machine machine = this_machine();
  const auto write = [&](const std::string& path, std::string text) -> Result<void> {
    if (path.empty()) return {};
    return outputs.write_text(path, std::move(text), out.text);
  };
  if (!outputs.uses_stdout()) out.text = compare_table(machine, rows);
  if (auto done = write(arguments.json, compare_json(machine, rows)); !done) return done;
  if (auto done = write(arguments.csv, compare_csv(rows)); !done) return done;
  return write(arguments.html, compare_html(machine, rows));
}

/// What is wrong where no solver has answered, of the rows of one model. A single failure is a row
/// like others.
std::optional<Error> failure_of_all(const std::vector<CompareRow>& rows) {
  const auto answered = [](const CompareRow& row) { return row.status == "ok"; };
  if (std::ranges::any_of(rows, answered)) return {};
  const CompareRow& first = rows.front();
  const std::string what = rows.size() == 1 ? first.name() + " failed: "
                                            : "all " + std::to_string(rows.size()) +
                                                  " solvers failed; " + first.name() + ": ";
  return Error{ErrorCode::kNumericalFailure,
               one_line(first.model) + ": " + what + first.note.message, first.note.hint};
}

}  // namespace

void add_compare_options(CLI::App& command, CompareArguments& arguments) {
  const auto add = [&command](const char* name, std::string& value, const char* type,
                              const std::string& help) {
    command.add_option(name, value, help)->type_name(type);
  };
  command
      .add_option("MODEL", arguments.models,
                  "files (as of solve), bundled models (geotherm models), - is standard "
                  "input")
      ->required()
      ->type_name("");
  add_setting_options(command, arguments.settings, names_of(SettingGroup::kModel));
  add("--backends,--backend", arguments.backends, "A,B",
      "all (default: " + joined(backend_names()) +
          "), or some of them and of wavefront, wavefront-fine, fast-marching, exact");
  add("--queries", arguments.queries, "N",
      "queries a backend, default 10; iterative backends stop after about 5 s");
  add("--reference", arguments.reference, "NAME",
      "the backend from which differences are measured, default the first");
  add_json_option(command, arguments.json);
  add("--csv", arguments.csv, "FILE", "the same as CSV");
  add("--html", arguments.html, "FILE", "table and chart as a page of its own");
  add_quiet_option(command, arguments.quiet);
  add_source_options(command, arguments.sources);
  add_setting_options(command, arguments.settings,
                      names_of(SettingGroup::kMethod, {"backend", "strict"}));
  command.footer(
      std::string("A solver that fails is a row with its message. Where all fail on a model the "
                  "exit code is 1,\nand the rows are written all the same.\n"
                  "Without sources each query starts at another vertex, chosen at random, the same "
                  "in each run.\n"
                  "Errors are those of the first ") +
      std::to_string(kErrorQueries) +
      " queries, against the best method that fits: exact, on large meshes "
      "wavefront-fine, in volumes, on polygons and grids fast-marching.\n"
      "Examples:\n  geotherm compare bunny terrain --backends all --csv table.csv\n"
      "  geotherm compare bunny --backends all,wavefront,fast-marching,exact");
}

Result<CommandOutput> run_compare(const CompareArguments& arguments, const Progress& progress) {
  const auto plan = plan_of(arguments);
  if (!plan) return plan.error();
  Outputs outputs;
  if (auto expected = expect_outputs(arguments, outputs); !expected) return expected.error();
  CommandOutput out;
  std::vector<CompareRow> rows;
  for (const std::string& name : arguments.models) {
    const auto model = load_model(name, plan->reading, progress);
    if (!model) return model.error();
    out.warnings.insert(out.warnings.end(), model->notes.begin(), model->notes.end());
    CompareTask task = plan->task;
    if (auto chosen = choose_sources(*model, *plan, task, out.warnings); !chosen) {
      return chosen.error();
    }
    auto some = compare_backends(*model, task, progress);
    if (!some) return some.error();
    if (!out.failure) out.failure = failure_of_all(*some);
    rows.insert(rows.end(), some->begin(), some->end());
  }
  const auto& solvers = plan->task.solvers;
  const auto heat = std::ranges::find(solvers, MethodKind::kHeat, &MethodOptions::method);
  note_unused_settings(arguments.settings, heat == solvers.end() ? solvers.front() : *heat,
                       out.warnings);
  if (auto done = write_reports(arguments, rows, outputs, out); !done) return done.error();
  out.made = outputs.made();
  return out;
}

}  // namespace geotherm::app
