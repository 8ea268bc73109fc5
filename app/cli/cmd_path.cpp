// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>

#include <sstream>
#include <string>
#include <vector>

#include "app/cli/commands.h"
#include "app/cli/path_report.h"
#include "app/cli/vertex_columns.h"
#include "app/session/model.h"
#include "app/session/model_solver.h"
#include "app/session/progress.h"
#include "app/session/report.h"
#include "app/session/sources.h"
#include "app/session/wording.h"
#include "app/text/text.h"
#include "geotherm/build_method.h"
#include "geotherm/path.h"
#include "solver/core/stopwatch.h"
#include "solver/core/text.h"
#include "solver/mesh/io/input_file.h"

namespace geotherm::app {

namespace {

/// What the words of the command line say.
struct PathTask {
  ModelReading reading;
  PictureSettings picture;
  MethodOptions method;
  PathOptions options;
  std::vector<std::vector<Source>> routes;  ///< the points of each path, in order
  bool tree = false;                        ///< the last source of each may be several vertices
  bool named_method = false;                ///< else the method follows from the number of paths
};

/// The paths from --from by way of --via to each --to, which may name several vertices.
Result<std::vector<std::vector<Source>>> tree_of(const PathArguments& arguments) {
  if (arguments.from.empty() || arguments.to.empty()) {
    return Error{
        ErrorCode::kBadInput, "a path needs two points", {"give --from and --to, or --pairs FILE"}};
  }
  std::vector<Source> shared;
  const auto add = [&shared](const std::string& text, const std::string& option) -> Result<void> {
    auto point = single_point(text, option);
    if (!point) return point.error();
    shared.push_back(*std::move(point));
    return {};
  };
  if (auto added = add(arguments.from, "--from"); !added) return added.error();
  for (const std::string& text : arguments.via) {
    if (auto added = add(text, "--via"); !added) return added.error();
  }
  std::vector<std::vector<Source>> routes;
  for (const std::string& text : arguments.to) {
    auto spec = parse_source(text);
    if (!spec) return about("--to", spec.error());
    if (const double* const offset = offset_of(*spec); offset != nullptr && *offset != 0) {
      return Error{ErrorCode::kBadInput,
                   "--to: '" + one_line(text) + "' has an offset, and a path ends at points",
                   {"leave out what follows @"}};
    }
    routes.push_back(shared);
    routes.back().push_back({*std::move(spec), "--to " + one_line(text)});
  }
  return routes;
}

/// The paths of a file, one a line: two points or more, with blanks between.
Result<std::vector<std::vector<Source>>> pairs_of(const PathArguments& arguments) {
  if (!arguments.from.empty() || !arguments.to.empty() || !arguments.via.empty()) {
    return Error{ErrorCode::kBadInput,
                 "--pairs: the file has all points",
                 {"leave --from, --via and --to out"}};
  }
  const auto file = io::FileBytes::read(arguments.pairs);
  if (!file) return about("--pairs", file.error());
  std::vector<std::vector<Source>> routes;
  std::istringstream lines{std::string(file->bytes())};
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    std::istringstream words(line.substr(0, line.find('#')));
    std::vector<Source> points;
    const std::string where = one_line(arguments.pairs) + ": line " + std::to_string(number);
    for (std::string word; words >> word;) {
      auto point = single_point(word, where);
      if (!point) return Error{ErrorCode::kBadFile, point.error().message, point.error().hint};
      point->blame = ErrorCode::kBadFile;
      points.push_back(*std::move(point));
    }
    if (points.size() == 1) {
      return Error{ErrorCode::kBadFile,
                   where + " has one point",
                   {"a path is two or more, with blanks between"}};
    }
    if (!points.empty()) routes.push_back(std::move(points));
  }
  if (!routes.empty()) return routes;
  return Error{ErrorCode::kBadFile,
               one_line(arguments.pairs) + ": there are no points in it",
               {"write two or more a line"}};
}

Result<PathTask> task_of(const PathArguments& arguments) {
  auto asked = settings_in(arguments.settings);
  if (!asked) return asked.error();
  PathTask task{asked->reading, asked->picture, {}, {}, {}, false, false};
  const auto field = parse<PathField>(arguments.field);
  if (!field) return about("--field", field.error());
  task.options.field = *field;
  task.options.closed = arguments.closed;
  task.options.hold_points = arguments.hold;
  const bool geodesic = task.options.field == PathField::kGeodesic;
  task.method = asked->options;
  task.named_method = arguments.settings.has("method");
  if (geodesic && !task.named_method) task.method.method = MethodKind::kWavefront;
  if (task.options.field == PathField::kHeat && task.method.method != MethodKind::kHeat) {
    return Error{ErrorCode::kBadInput,
                 "--field heat follows the heat u, which --method " + to_text(task.method.method) +
                     " has not",
                 {"use ", SettingHint{"method", {"heat"}}}};
  }
  if (arguments.closed && arguments.pairs.empty() && arguments.to.size() != 1) {
    return Error{
        ErrorCode::kBadInput,
        "--closed: a loop has one --to, and " + std::to_string(arguments.to.size()) + " were given",
        {"name the points between with --via"}};
  }
  if (arguments.hold && (!arguments.closed || !geodesic)) {
    return Error{ErrorCode::kBadInput,
                 "--hold: only a closed geodesic can leave its points",
                 {"add --closed, or leave --hold out"}};
  }
  task.tree = arguments.pairs.empty();
  auto routes = task.tree ? tree_of(arguments) : pairs_of(arguments);
  if (!routes) return routes.error();
  task.routes = *std::move(routes);
  return task;
}

/// A path to be found.
struct Route {
  std::vector<SurfacePoint> stops;
  std::string where;  ///< its end, for messages
};

/// Adds the route to each vertex of the last source, or to its one point.
Result<void> add_routes(const std::vector<Source>& points, bool tree, const TriangleMesh& mesh,
                        std::vector<Route>& routes, std::vector<Warning>& warnings) {
  std::vector<SurfacePoint> shared;
  const auto note = [&warnings](const std::vector<Warning>& more) {
    warnings.insert(warnings.end(), more.begin(), more.end());
  };
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const auto placed = resolve_sources({&points[i], 1}, mesh);
    if (!placed) return placed.error();
    shared.push_back(placed->set.points.front());
    note(placed->warnings);
  }
  const auto ends = resolve_each({&points.back(), 1}, mesh);
  if (!ends) return ends.error();
  note(ends->warnings);
  for (const SourceSet& end : ends->sets) {
    if (end.points.size() != 1 || (!tree && ends->sets.size() != 1)) {
      return Error{
          ErrorCode::kBadInput, points.back().where + " is no point", {"a path ends in one"}};
    }
    routes.push_back({shared, points.back().where});
    routes.back().stops.push_back(end.points.front());
  }
  return {};
}

/// Holds the distances from the start, which lead the way, against better ones. Errors: kCancelled.
Result<void> check_way(const SurfacePoint& start, const ReadyMethod& ready, ModelSolver& solver,
                       Check check, const Progress& progress, PathFigures& figures) {
  if (check == Check::kOff) return {};
  SourceSet from;
  from.points.push_back(start);
  auto checked = solver.check_method(ready, {&from, 1}, {check}, part_of(progress, 0.9, 1.0));
  if (!checked) return checked.error();
  AccuracyReport& report = checked->error;
  if (auto warning = accuracy_warning(report, accuracy_line(report))) {
    figures.warnings.push_back(*std::move(warning));
  }
  figures.error = std::move(report);
  return {};
}

/// Paths that begin in one point follow each other, so that its distances are computed once.
Result<void> find_routes(const std::vector<Route>& routes, Check check, const Progress& progress,
                         PathFigures& figures) {
  Stopwatch watch;
  ModelSolver solver(figures.model);
  const auto ready = solver.prepare(figures.method, part_of(progress, 0, 0.5));
  if (!ready) return ready.error();
  const auto& about_method = ready->method->warnings();
  figures.warnings.insert(figures.warnings.end(), about_method.begin(), about_method.end());
  const PathFinder finder(figures.model.mesh, ready->method);
  figures.setup_ms = watch.milliseconds();
  const Stopwatch finding;
  const auto count = static_cast<double>(routes.size());
  for (std::size_t i = 0; i < routes.size(); ++i) {
    const double begin = static_cast<double>(i) / count, end = static_cast<double>(i + 1) / count;
    auto found = finder.find(routes[i].stops, figures.options,
                             part_of(progress, 0.5 + 0.5 * begin, 0.5 + 0.5 * end));
    if (!found) {
      // The points are on the mesh: that no way leads there is a failure of the work.
      return about_model(figures.model.name, about(routes[i].where, found.error()));
    }
    figures.warnings.insert(figures.warnings.end(), found->warnings.begin(), found->warnings.end());
    figures.paths.push_back({routes[i].stops, std::move(found->path)});
  }
  figures.path_ms = finding.milliseconds();
  const SurfacePoint start = figures.paths.front().stops.front();
  return check_way(start, *ready, solver, check, progress, figures);
}

Result<void> find_paths(const PathTask& task, Check check, const Progress& progress,
                        PathFigures& figures) {
  std::vector<Route> routes;
  for (const std::vector<Source>& points : task.routes) {
    auto added = add_routes(points, task.tree, *figures.model.mesh, routes, figures.warnings);
    if (!added) return added;
  }
  if (task.options.closed && task.tree && routes.size() != 1) {
    return Error{
        ErrorCode::kBadInput,
        "--closed: a loop has one --to, and " + std::to_string(routes.size()) + " were given",
        {"name the points between with --via"}};
  }
  const bool geodesics = task.options.field == PathField::kGeodesic;
  if (geodesics && !task.named_method && task.tree &&
      exact_leads_tree(routes.size(), figures.model)) {
    figures.method.method = MethodKind::kExact;
    const std::vector<Warning> before = figures.warnings;
    auto done = find_routes(routes, check, progress, figures);
    if (done || done.error().code != ErrorCode::kBudgetEnded) return done;
    figures.method = task.method;
    figures.warnings = before;
    figures.paths.clear();
  }
  return find_routes(routes, check, progress, figures);
}

LinePicture picture_of_paths(const PathFigures& figures) {
  LinePicture picture =
      picture_on(figures.model, to_text(figures.options.field) + ", length " +
                                    significant(figures.paths.front().path.length));
  for (const FoundLine& line : figures.paths) {
    picture.lines.push_back({&line.path, {}});
    for (const SurfacePoint& stop : line.stops) {
      if (!figures.options.closed || figures.options.hold_points) {
        picture.markers.push_back(position_at(*figures.model.mesh, stop));
      }
    }
  }
  return picture;
}

/// A table as CSV, or the lengths alone as an array in .npy.
Result<void> write_lengths(const std::string& path, const PathFigures& figures, Outputs& outputs,
                           std::string& standard_output) {
  if (io::file_extension(path) != ".npy") {
    return outputs.write_text(path, lengths_csv(figures), standard_output);
  }
  std::vector<double> lengths;
  for (const FoundLine& line : figures.paths) lengths.push_back(line.path.length);
  return write_columns(path, *figures.model.mesh, {{"length", std::move(lengths)}}, outputs,
                       standard_output);
}

}  // namespace

void add_path_options(CLI::App& command, PathArguments& arguments) {
  add_model_option(command, arguments.model, arguments.settings)->required();
  const auto add_points = [&command](const char* name, std::vector<std::string>& points,
                                     const char* help) {
    return may_repeat(command.add_option(name, points, help), "POINT")->group("Points");
  };
  command
      .add_option("--from", arguments.from,
                  "where it begins: a vertex id, face:ID:b0:b1:b2 or xyz:x:y:z (the closest point "
                  "of the surface)")
      ->type_name("POINT")
      ->group("Points");
  add_points("--to", arguments.to,
             "where it ends; may be repeated, and be several vertices (3,99 or random:20), for a "
             "path to each");
  add_points("--via", arguments.via, "a point on the way; may be repeated, in order");
  command
      .add_option("--pairs", arguments.pairs,
                  "many paths: the points of each on a line, two or more with blanks between")
      ->type_name("FILE")
      ->group("Points");
  command
      .add_flag("--closed", arguments.closed,
                "goes on from the end to the start; a geodesic loop then leaves its points and is "
                "shortened all round")
      ->group("Points");
  command.add_flag("--hold", arguments.hold, "a closed geodesic stays at its points")
      ->group("Points");
  command
      .add_option("--field", arguments.field,
                  "what it follows: geodesic (default: the shortest path, straight across faces), "
                  "distance (-grad phi), heat (X of the heat method)")
      ->type_name("NAME");
  add_line_file_options(command, arguments.files, arguments.settings, "the paths");
  command
      .add_option("--lengths", arguments.lengths,
                  "where the lengths go: .csv (from, to, points between, length), .npy (lengths "
                  "alone), or - for CSV on standard output")
      ->type_name("FILE");
  add_no_check_option(command, arguments.check);
  add_quiet_option(command, arguments.quiet);
  add_setting_options(command, arguments.settings, names_of(SettingGroup::kMethod));
  command.get_option("--method")
      ->description("what finds the distances that lead the way (default: see below): " +
                    joined(find_setting("method")->values()));
  command.footer(
      "The method finds the distances that lead the way: wavefront for a geodesic (exact for four "
      "and more from one point on up to 500,000 faces), heat for the other fields, unless --method "
      "names one.\n"
      "Examples:\n"
      "  geotherm path bunny --from 0 --to 1200 -o path.obj --json -\n"
      "  geotherm path model.obj --from 17 --to xyz:0:1:0 --to face:12:0.2:0.3:0.5 -o paths.csv\n"
      "  geotherm path bunny --from 17 --to random:20 --lengths lengths.csv\n"
      "  geotherm path bunny --pairs pairs.txt -o paths.obj\n"
      "  geotherm path sleeve --from 0 --via 900 --to 1800 --closed -o loop.svg");
}

Result<CommandOutput> run_path(const PathArguments& arguments, const Progress& progress) {
  const auto task = task_of(arguments);
  if (!task) return task.error();
  const auto check = check_settings(arguments.check);
  if (!check) return check.error();
  Outputs outputs;
  const auto expected = expect_line_files(arguments.files, outputs);
  if (!expected) return expected.error();
  if (!arguments.lengths.empty()) {
    if (auto table = outputs.expect(arguments.lengths, "--lengths"); !table) return table.error();
    const std::string ending = io::file_extension(arguments.lengths);
    if (arguments.lengths != "-" && ending != ".csv" && ending != ".npy") {
      return Error{ErrorCode::kNotAvailable,
                   "--lengths: " + one_line(arguments.lengths) + ": unknown extension '" +
                       one_line(ending) + "'",
                   {"there are .csv .npy"}};
    }
  }
  auto model = load_model(arguments.model, task->reading, progress);
  if (!model) return model.error();
  if (auto surface = refuse_space(*model, "paths are"); !surface) return surface.error();
  PathFigures figures{*std::move(model), task->method, task->options, {}, 0, 0, {}, {}};
  figures.warnings = figures.model.notes;
  if (auto found = find_paths(*task, check->against, progress, figures); !found) {
    return found.error();
  }
  note_unused_settings(arguments.settings, figures.method, figures.warnings);
  note_unused_picture(arguments.settings, arguments.files.outputs, figures.warnings);

  CommandOutput out{"", figures.warnings, {}};
  const auto written = write_line_files(arguments.files, picture_of_paths(figures), task->picture,
                                        progress, outputs, out);
  if (!written) return written.error();
  if (!arguments.lengths.empty()) {
    const auto table = write_lengths(arguments.lengths, figures, outputs, out.text);
    if (!table) return table.error();
  }
  return finish_command(
      std::move(out), outputs, arguments.files.json, [&] { return path_json(figures); },
      [&] { return path_table(figures); });
}

}  // namespace geotherm::app
