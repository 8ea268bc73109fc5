// SPDX-License-Identifier: MIT
// `geotherm solve` on one source set.
#include <CLI/CLI.hpp>

#include <algorithm>
#include <string>
#include <vector>

#include "app/cli/commands.h"
#include "app/cli/film.h"
#include "app/cli/many_work.h"
#include "app/cli/render_work.h"
#include "app/cli/scene_output.h"
#include "app/cli/sequence_work.h"
#include "app/cli/solve_fields.h"
#include "app/session/answer.h"
#include "app/session/model_solver.h"
#include "app/session/outputs.h"
#include "app/session/progress.h"
#include "app/session/ranks.h"
#include "app/session/report.h"
#include "app/session/wording.h"
#include "app/text/text.h"
#include "geotherm/error.h"
#include "geotherm/heat_method.h"
#include "geotherm/io.h"
#include "solver/core/text.h"
#include "solver/mesh/io/format_writers.h"
#include "solver/mesh/output_file.h"

namespace geotherm::app {

namespace {

/// Files that `render` alone writes.
bool is_of_render(const std::string& path) {
  return io::file_extension(path) == ".png" || figure_format(path) || is_film(path) ||
         scene_format(path);
}

Result<void> check_extensions(const SolveArguments& arguments) {
  for (const std::string& path : arguments.outputs) {
    if (is_of_render(path)) {
      return Error{
          ErrorCode::kNotAvailable,
          "--output: " + one_line(path) + ": solve writes distances as numbers",
          {"geotherm render draws them, with the same model, sources and -o " + one_line(path)}};
    }
    // What a space writes beside is known when the model is.
    const bool known_of_space = check_tet_distances_path(path) || check_grid_distances_path(path);
    if (auto known = check_distance_path(path); !known && !known_of_space) return known;
  }
  return {};
}

Result<void> check_outputs_of(const Model& model, const std::vector<std::string>& paths) {
  for (const std::string& path : paths) {
    if (auto fits = check_answer_path(model, path); !fits) return about("--output", fits.error());
  }
  return {};
}

bool is_ply(const std::string& path) { return io::file_extension(path) == ".ply"; }

/// Before the work: whether there will be colours, and a file for them.
Result<void> check_bake(const SolveArguments& arguments, const Drawing& drawing) {
  if (arguments.bake.empty()) return {};
  if (std::ranges::none_of(arguments.outputs, is_ply)) {
    return Error{ErrorCode::kBadInput,
                 "--bake-colours: colours are written into .ply files",
                 {"give -o FILE.ply"}};
  }
  const auto known = drawing.colours(arguments.bake);
  return known ? Result<void>() : about("--bake-colours", known.error());
}

/// Whether there is a place for labels: JSON has the regions.
Result<void> check_labels(const SolveArguments& arguments) {
  if (!arguments.labels || !arguments.outputs.empty() || !arguments.json.empty()) return {};
  return Error{ErrorCode::kBadInput,
               "--labels: they are written beside the distances",
               {"give -o FILE.csv or --json FILE"}};
}

bool needs_nearest(const std::vector<std::string>& paths) {
  return std::ranges::any_of(paths, holds_mesh);
}

/// That a file of polygons' distances has no polygons in it.
void note_triangulation(const std::vector<std::string>& paths, Answer& figures) {
  const auto file = std::ranges::find_if(paths, holds_mesh);
  const Model& model = figures.model;
  if (file == paths.end() || domain_name(model) != "polygons") return;
  if (model.space->cell_count() == model.mesh->face_count()) return;  // all are triangles
  figures.warnings.push_back({one_line(*file) +
                              " holds the triangles that the polygons are drawn by: distances on "
                              "these, read as a model, are others"});
}

bool has_several_sources(const Answer& figures) { return source_groups(figures.sources).count > 1; }

}  // namespace

void add_many_options(CLI::App& command, SolveArguments& arguments) {
  command
      .add_flag(
          "--each", arguments.each,
          "solves for each source point by itself: one row of distances a point, in the order "
          "of the sources, into -o FILE.npy (sources x vertices), written as rows come; a "
          "curve and the boundary are one row each; -o FILE.npz holds what is reached alone, as "
          "sparse rows for SciPy")
      ->group("Many sources");
  command
      .add_flag("--pairs", arguments.pairs,
                "distances between each two of the source vertices alone: a square matrix, from "
                "the row's vertex to the column's")
      ->group("Many sources");
  command
      .add_flag("--symmetric", arguments.symmetric,
                "with --pairs: both directions become their mean; otherwise they differ by the "
                "error of the method, which the report says")
      ->group("Many sources");
  command
      .add_option("--dtype", arguments.dtype, "numbers of .npy arrays: float64 (default), float32")
      ->type_name("TYPE")
      ->group("Many sources");
  command.add_flag("--float32", arguments.float32, "the same as --dtype float32")
      ->group("Many sources");
}

void add_solve_options(CLI::App& command, SolveArguments& arguments) {
  add_model_option(command, arguments.model, arguments.settings)->required();
  add_source_options(command, arguments.sources);
  may_repeat(command.add_option(
                 "-o,--output", arguments.outputs,
                 "where the distances go: .csv .npy .ply .vtp, of a volume .vtu, of a grid .vti, "
                 "or - for CSV on "
                 "standard output; "
                 "may be repeated; with --each .npy and .npz, with --pairs .npy and .csv, with "
                 "--sequence .npy "
                 "and .pvd"),
             "FILE");
  add_json_option(command, arguments.json);
  command
      .add_flag("--check", arguments.check.check,
                "holds the distances against the most accurate method that fits, and looks for a "
                "better setting where they are not good")
      ->group("Accuracy");
  add_check_options(command, arguments.check);
  command
      .add_option(
          "--fields", arguments.fields,
          "writes numbers beside the distances that say where they are right: all, or some "
          "of error (implies --check), eikonal-error, gradient-angle, lost-gradients, "
          "triangle-quality, non-delaunay; .ply and .vtp hold all, .vtu those of tets, .csv "
          "and .vti error alone")
      ->type_name("NAMES");
  command.add_flag(
      "--bake-colours{red-blue},--bake-colors{red-blue}", arguments.bake,
      "colours of the distances in .ply files as well (red, green, blue), for programs "
      "that show nothing else, such as Blender; --bake-colours=viridis takes another "
      "map");
  command.add_flag("--labels", arguments.labels,
                   "which source is the nearest, in .csv and .npy as well; .ply and .vtp have it "
                   "wherever there are several sources");
  add_max_distance_option(command, arguments.max_distance);
  add_target_option(command, arguments.targets, "the distances");
  add_many_options(command, arguments);
  add_sequence_options(command, arguments.sequence);
  add_quiet_option(command, arguments.quiet);
  add_setting_options(command, arguments.settings, names_of(SettingGroup::kMethod));
  command.footer(
      "Examples:\n"
      "  geotherm solve model.obj -s 17 -o distances.ply --json figures.json\n"
      "  geotherm solve terrain -s boundary --time-factor 2 -o - | head\n"
      "  geotherm solve bunny -s 0 --check\n"
      "  geotherm solve bunny -s 0 --fields all -o bunny.vtp\n"
      "  geotherm solve bunny -s 0@0.5 -s 1200 --method wavefront --labels -o regions.csv\n"
      "  geotherm solve bunny -s random:500 --each --float32 -o rows.npy\n"
      "  geotherm solve bunny -s random:500 --each --method wavefront --max-distance 0.2 -o "
      "near.npz\n"
      "  geotherm solve bunny -s 17 --target 3,99 --method exact -o -\n"
      "  geotherm solve bunny -s 3,99,512 --pairs -o matrix.csv\n"
      "  geotherm solve body.obj --sequence 'frame_%04d.obj' -s 17 -o rows.npy\n"
      "  mpirun -n 8 geotherm solve huge.ply -s 17 --backend petsc -o distances.npy\n"
      "  mpirun -n 8 geotherm solve huge.ply -s 17 --method wavefront -o distances.npy");
}

namespace {

/// Options of many sources, where one set is solved for.
Result<void> refuse_options_of_many(const SolveArguments& arguments) {
  const bool typed = arguments.float32 || !arguments.dtype.empty();
  if (!typed && !arguments.symmetric) return {};
  return Error{ErrorCode::kBadInput,
               typed ? "--dtype and --float32 are about --each, --pairs and --sequence"
                     : "--symmetric is about --pairs",
               {typed ? "leave them out" : "leave it out"}};
}

Result<void> refuse_both(const SolveArguments& arguments) {
  if (!arguments.each || !arguments.pairs) return {};
  return Error{ErrorCode::kBadInput,
               "--each and --pairs were both given: --each writes whole rows, --pairs those of the "
               "sources' vertices",
               {"leave one of them out"}};
}

/// A field of the error needs a thorough check; fields of the heat need the heat.
Result<CheckSettings> settings_of(const SolveArguments& arguments, const MethodOptions& options,
                                  const WantedFields& wanted) {
  auto settings = check_settings(arguments.check);
  if (!settings) return settings;
  if (wanted.has_error() && settings->against == Check::kOn) {
    settings->against = Check::kAuto;
  }
  if (wanted.has_heat() && options.method == MethodKind::kHeat) {
    if (auto fits = refuse_better(*settings, "--fields " + one_line(arguments.fields)); !fits) {
      return fits.error();
    }
  }
  return settings;
}

}  // namespace

namespace {

Error refuse_fields_of_targets() {
  return {ErrorCode::kBadInput,
          "--fields are of all vertices, and --target asks for some",
          {"write a .ply or .vtp, or leave one of them out"}};
}

/// The rows of the targets alone, as .npy or .csv.
std::string target_bytes(const std::string& path, const std::vector<Index>& targets,
                         const std::vector<double>& distances, const std::vector<Index>& nearest) {
  std::vector<double> at;
  std::vector<Index> labels;
  for (const Index v : targets) {
    at.push_back(distances[static_cast<std::size_t>(v)]);
    if (!nearest.empty()) labels.push_back(nearest[static_cast<std::size_t>(v)]);
  }
  if (io::file_extension(path) == ".npy") return io::npy_bytes(at, labels);
  std::string text = nearest.empty() ? "vertex,distance\n" : "vertex,distance,nearest_source\n";
  for (std::size_t i = 0; i < targets.size(); ++i) {
    text += std::to_string(targets[i]) + ',' + number_text(at[i]);
    if (!labels.empty()) text += ',' + std::to_string(labels[i]);
    text += '\n';
  }
  return text;
}

}  // namespace

Result<void> check_solve(const SolveArguments& arguments) {
  if (auto fits = refuse_both(arguments); !fits) return fits;
  if (arguments.each) return check_each(arguments);
  if (arguments.pairs) return check_pairs(arguments);
  if (auto fits = refuse_options_of_many(arguments); !fits) return fits;
  return check_extensions(arguments);
}

Result<CommandOutput> run_solve(const SolveArguments& arguments, const Drawing& drawing,
                                const Progress& progress, const Announce& announce) {
  if (auto fits = refuse_both(arguments); !fits) return fits.error();
  if (auto fits = refuse_with_sequence(arguments.sequence, arguments.check); !fits) {
    return fits.error();
  }
  if (is_shared(arguments)) return run_shared(arguments, progress);
  if (!arguments.each && !arguments.pairs) {
    if (auto alone = refuse_ranks("geotherm solve on one source set"); !alone) {
      return alone.error();
    }
  }
  if (!arguments.sequence.frames.empty()) return run_sequence(arguments, progress, announce);
  if (arguments.each) return run_each(arguments, progress, announce);
  if (arguments.pairs) return run_pairs(arguments, progress, announce);
  if (auto fits = check_solve(arguments); !fits) return fits.error();
  const auto asked = settings_in(arguments.settings);
  if (!asked) return asked.error();
  const MethodOptions& options = asked->options;
  Outputs outputs;
  const auto expected = expect_files(arguments.outputs, arguments.json, outputs);
  if (!expected) return expected.error();
  const auto wanted = wanted_fields(arguments.fields, options.method, arguments.outputs);
  if (!wanted) return wanted.error();
  if (auto fits = check_bake(arguments, drawing); !fits) return fits.error();
  if (auto fits = check_labels(arguments); !fits) return fits.error();
  const auto check = settings_of(arguments, options, *wanted);
  if (!check) return check.error();
  const auto named = some_sources_of(arguments.sources);
  if (!named) return named.error();
  auto model = load_model(arguments.model, asked->reading, progress);
  if (!model) return model.error();
  if (auto writable = check_outputs_of(*model, arguments.outputs); !writable) {
    return writable.error();
  }
  const auto sources = resolve_sources(*named, *model);
  if (!sources) return sources.error();
  auto reach = reach_of(arguments, *model);
  if (!reach) return reach.error();
  QueryOptions query;
  query.reach = *std::move(reach);
  query.nearest = arguments.labels || needs_nearest(arguments.outputs);
  query.fields = wanted->has_heat();
  ModelSolver solver(*std::move(model));
  auto figures = solver.solve(options, *sources, {query, *check}, progress);
  if (!figures) return figures.error();
  note_unused_settings(arguments.settings, options, figures->warnings);
  note_triangulation(arguments.outputs, *figures);
  const auto fields = make_fields(*wanted, *figures);
  if (!fields) return fields.error();

  const std::vector<double>& distances = figures->result.distances;
  const auto colours = arguments.bake.empty()
                           ? Result<std::vector<DataField>>(std::vector<DataField>())
                           : baked_colours(drawing, arguments.bake, distances);
  if (!colours) return colours.error();

  CommandOutput out;
  out.warnings = figures->warnings;
  for (const std::string& path : arguments.outputs) {
    if (!report(progress, "writing " + path, 1.0)) {
      outputs.remove_written();
      return cancelled_error();
    }
    const bool labels = arguments.labels || (holds_mesh(path) && has_several_sources(*figures));
    const std::vector<Index> nearest =
        labels ? figures->result.nearest_source : std::vector<Index>();
    const auto written = outputs.write(path, [&]() -> Result<void> {
      if (tets_of(figures->model) && io::file_extension(path) == ".vtu") {
        const auto of_tets = fields_of_tets(*wanted, *figures, *fields);
        return write_answer(path, figures->model, distances, nearest, of_tets);
      }
      std::vector<DataField> held = fields_of_file(path, *fields, out.warnings);
      if (is_ply(path)) held.insert(held.end(), colours->begin(), colours->end());
      const std::vector<Index>& targets = figures->reach.targets;
      if (!targets.empty() && !holds_mesh(path)) {
        if (!held.empty()) return refuse_fields_of_targets();
        std::string bytes = target_bytes(path, targets, distances, nearest);
        if (path != "-") return write_file(path, bytes);
        out.text = std::move(bytes);
        return {};
      }
      if (path != "-") return write_answer(path, figures->model, distances, nearest, held);
      out.text = io::csv_bytes(distances, nearest, held);
      return {};
    });
    if (!written) return written.error();
  }
  out.note = accuracy_note(arguments.json, outputs, arguments.quiet, figures->error);
  return finish_command(
      std::move(out), outputs, arguments.json, [&] { return solve_json(*figures); },
      [&] { return solve_table(*figures); });
}

}  // namespace geotherm::app
