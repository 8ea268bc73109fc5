// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>

#include <optional>
#include <string>
#include <vector>

#include "app/cli/commands.h"
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

namespace geotherm::app {

/// A path with the points it was asked to go through.
struct FoundLine {
  std::vector<SurfacePoint> stops;
  SurfacePath path;
};

/// All there is to say about the paths of one command; one at least.
struct PathFigures {
  Model model;
  MethodOptions method;
  PathOptions options;
  std::vector<FoundLine> paths;
  double setup_ms = 0, path_ms = 0;
  std::vector<Warning> warnings;
  std::optional<AccuracyReport> error;  ///< of the distances from the start that lead the way
};

/// The first path's keys, then those of the work; with several paths each is in `paths`. points[i]
/// has the weights barycentric[i] in faces[i], which also holds the piece up to points[i + 1].
Json path_json(const PathFigures& figures);

/// What is shown to people.
std::string path_table(const PathFigures& figures);

namespace {

Json line_json(const TriangleMesh& mesh, const FoundLine& line, PathField field) {
  Json points = Json::array(), faces = Json::array(), weights = Json::array();
  for (const Vec3& p : positions_of(mesh, line.path)) points.push_back({p.x(), p.y(), p.z()});
  for (const SurfacePoint& point : points_in_faces(mesh, line.path)) {
    faces.push_back(point.face);
    weights.push_back(point.weights);
  }
  Json json = {{"from", point_json(line.stops.front())}, {"to", point_json(line.stops.back())}};
  if (line.stops.size() > 2) {
    json["via"] = Json::array();
    for (std::size_t i = 1; i + 1 < line.stops.size(); ++i) {
      json["via"].push_back(point_json(line.stops[i]));
    }
  }
  json.update({{"length", line.path.length},
               {"field", to_text(field)},
               {"closed", line.path.closed},
               {"points", std::move(points)},
               {"faces", std::move(faces)},
               {"barycentric", std::move(weights)}});
  return json;
}

std::string point_in_words(const SurfacePoint& point) {
  return point.is_vertex() ? "vertex " + std::to_string(point.vertex)
                           : "a point in face " + std::to_string(point.face);
}

std::string line_in_words(const FoundLine& line) {
  std::string text =
      "from " + point_in_words(line.stops.front()) + " to " + point_in_words(line.stops.back());
  if (line.stops.size() > 2) {
    text += " via " + counted(static_cast<std::int64_t>(line.stops.size()) - 2, "point", "points");
  }
  return text + (line.path.closed ? " and back" : "");
}

}  // namespace

Json path_json(const PathFigures& figures) {
  const TriangleMesh& mesh = *figures.model.mesh;
  Json json = line_json(mesh, figures.paths.front(), figures.options.field);
  if (figures.paths.size() > 1) {
    json["paths"] = Json::array();
    for (const FoundLine& line : figures.paths) {
      json["paths"].push_back(line_json(mesh, line, figures.options.field));
    }
  }
  json.update(
      {{"model",
        {{"name", figures.model.name},
         {"vertices", mesh.vertex_count()},
         {"faces", mesh.face_count()}}},
       {"method", to_text(figures.method.method)},
       {"timing_ms",
        {{"load", figures.model.load_ms}, {"setup", figures.setup_ms}, {"path", figures.path_ms}}},
       {"warnings", told(figures.warnings)}});
  if (figures.error) json["error"] = error_json(*figures.error);
  return json;
}

std::string path_table(const PathFigures& figures) {
  TextTable table({{"", TextTable::Align::kLeft}, {"", TextTable::Align::kLeft}});
  table.add_row({"model", one_line(figures.model.name) + ": " +
                              counted(figures.model.mesh->vertex_count(), "vertex", "vertices") +
                              ", " + counted(figures.model.mesh->face_count(), "face", "faces")});
  table.add_row({"field", to_text(figures.options.field) + ", led by distances of " +
                              to_text(figures.method.method)});
  if (figures.error && figures.error->measured) {
    table.add_row({"error", "of the distances: " + told(accuracy_line(*figures.error))});
  }
  table.add_row({"set-up", milliseconds(figures.setup_ms) + " ms"});
  table.add_row({"search", milliseconds(figures.path_ms) + " ms"});
  for (const FoundLine& line : figures.paths) {
    const auto points = static_cast<std::int64_t>(line.path.points.size());
    table.add_row({"path", line_in_words(line)});
    table.add_row(
        {"length", significant(line.path.length, 7) + ", " + counted(points, "point", "points")});
  }
  return table.text();
}

namespace {

/// What the words of the command line say.
struct PathTask {
  ModelReading reading;
  PictureSettings picture;
  MethodOptions method;
  PathOptions options;
  std::vector<Source> points;  ///< from, via, then each to
};

Result<Source> point_of(const std::string& text, const std::string& option) {
  auto spec = parse_source(text);
  if (!spec) return about(option, spec.error());
  if (is_single_point(*spec)) return Source{*std::move(spec), option + " " + one_line(text)};
  return Error{ErrorCode::kBadInput, option + ": '" + one_line(text) +
                                         "' is not one point; write a vertex id, face:ID:b0:b1:b2 "
                                         "or xyz:x:y:z"};
}

Result<std::vector<Source>> points_of(const PathArguments& arguments) {
  std::vector<Source> out;
  const auto add = [&out](const std::string& text, const std::string& option) -> Result<void> {
    auto point = point_of(text, option);
    if (!point) return point.error();
    out.push_back(*std::move(point));
    return {};
  };
  if (auto added = add(arguments.from, "--from"); !added) return added.error();
  for (const std::string& text : arguments.via) {
    if (auto added = add(text, "--via"); !added) return added.error();
  }
  for (const std::string& text : arguments.to) {
    if (auto added = add(text, "--to"); !added) return added.error();
  }
  return out;
}

Result<PathTask> task_of(const PathArguments& arguments) {
  auto asked = settings_in(arguments.settings);
  if (!asked) return asked.error();
  PathTask task{asked->reading, asked->picture, {}, {}, {}};
  const auto field = parse<PathField>(arguments.field);
  if (!field) return about("--field", field.error());
  task.options.field = *field;
  task.options.closed = arguments.closed;
  task.options.hold_points = arguments.hold;
  const bool geodesic = task.options.field == PathField::kGeodesic;
  task.method = asked->options;
  if (geodesic && !arguments.settings.has("method")) task.method.method = MethodKind::kWavefront;
  if (task.options.field == PathField::kHeat && task.method.method != MethodKind::kHeat) {
    return Error{ErrorCode::kBadInput, "--field heat follows the heat u, which --method " +
                                           to_text(task.method.method) +
                                           " has not; use --method heat"};
  }
  if (arguments.closed && arguments.to.size() != 1) {
    return Error{ErrorCode::kBadInput, "--closed: a loop has one --to, and " +
                                           std::to_string(arguments.to.size()) +
                                           " were given; name the points between with --via"};
  }
  if (arguments.hold && (!arguments.closed || !geodesic)) {
    return Error{ErrorCode::kBadInput,
                 "--hold: only a closed geodesic can leave its points; add --closed, or leave "
                 "--hold out"};
  }
  auto points = points_of(arguments);
  if (!points) return points.error();
  task.points = *std::move(points);
  return task;
}

Result<std::vector<SurfacePoint>> place(const std::vector<Source>& points, const TriangleMesh& mesh,
                                        std::vector<Warning>& warnings) {
  std::vector<SurfacePoint> out;
  for (const Source& point : points) {
    const auto placed = resolve_sources({&point, 1}, mesh);
    if (!placed) return placed.error();
    out.push_back(placed->set.points.front());
    warnings.insert(warnings.end(), placed->warnings.begin(), placed->warnings.end());
  }
  return out;
}

/// Holds the distances from the start, which lead the way, against better ones. Errors: kCancelled.
Result<void> check_way(const SurfacePoint& start, const ReadyMethod& ready, ModelSolver& solver,
                       Check check, const Progress& progress, PathFigures& figures) {
  if (check == Check::kOff) return {};
  SourceSet from;
  from.points.push_back(start);
  auto checked = solver.check_method(ready, {&from, 1}, {check}, part_of(progress, 0.9, 1.0));
  if (!checked) return checked.error();
  AccuracyReport& report = checked->error.report;
  if (auto warning = accuracy_warning(report, accuracy_line(report))) {
    figures.warnings.push_back(*std::move(warning));
  }
  figures.error = std::move(report);
  return {};
}

/// One path for each target: they share the start and the way-points.
Result<void> find_paths(const PathTask& task, std::size_t targets, Check check,
                        const Progress& progress, PathFigures& figures) {
  auto points = place(task.points, *figures.model.mesh, figures.warnings);
  if (!points) return points.error();
  Stopwatch watch;
  ModelSolver solver(figures.model);
  const auto ready = solver.prepare(task.method, part_of(progress, 0, 0.5));
  if (!ready) return ready.error();
  const auto& about_method = ready->method->warnings();
  figures.warnings.insert(figures.warnings.end(), about_method.begin(), about_method.end());
  const PathFinder finder(figures.model.mesh, ready->method);
  figures.setup_ms = watch.milliseconds();
  const Stopwatch finding;
  const std::size_t shared = points->size() - targets;
  for (std::size_t i = 0; i < targets; ++i) {
    std::vector<SurfacePoint> stops(points->begin(),
                                    points->begin() + static_cast<std::ptrdiff_t>(shared));
    stops.push_back((*points)[shared + i]);
    const double begin = static_cast<double>(i) / static_cast<double>(targets);
    const double end = static_cast<double>(i + 1) / static_cast<double>(targets);
    auto found =
        finder.find(stops, task.options, part_of(progress, 0.5 + 0.5 * begin, 0.5 + 0.5 * end));
    if (!found) {
      // The points are on the mesh: that no way leads there is a failure of the work.
      return about_model(figures.model.name, about(task.points[shared + i].where, found.error()));
    }
    figures.warnings.insert(figures.warnings.end(), found->warnings.begin(), found->warnings.end());
    figures.paths.push_back({std::move(stops), std::move(found->path)});
  }
  figures.path_ms = finding.milliseconds();
  return check_way(points->front(), *ready, solver, check, progress, figures);
}

LinePicture picture_of_paths(const PathFigures& figures) {
  LinePicture picture;
  picture.mesh = figures.model.mesh;
  for (const FoundLine& line : figures.paths) {
    picture.lines.push_back({&line.path, {}});
    for (const SurfacePoint& stop : line.stops) {
      if (!figures.options.closed || figures.options.hold_points) {
        picture.markers.push_back(position_at(*figures.model.mesh, stop));
      }
    }
  }
  picture.title = figures.model.name + ", " + to_text(figures.options.field) + ", length " +
                  significant(figures.paths.front().path.length);
  return picture;
}

}  // namespace

void add_path_options(CLI::App& command, PathArguments& arguments) {
  add_model_option(command, arguments.model, arguments.settings)->required();
  const auto add_points = [&command](const char* name, std::vector<std::string>& points,
                                     const char* help) {
    return command.add_option(name, points, help)
        ->type_name("POINT")
        ->expected(1)
        ->allow_extra_args(false)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->group("Points");
  };
  command
      .add_option("--from", arguments.from,
                  "where it begins: a vertex id, face:ID:b0:b1:b2 or xyz:x:y:z (the closest point "
                  "of the surface)")
      ->required()
      ->type_name("POINT")
      ->group("Points");
  add_points("--to", arguments.to, "where it ends; may be repeated, for a path to each")
      ->required();
  add_points("--via", arguments.via, "a point on the way; may be repeated, in order");
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
  add_line_file_options(command, arguments.files, arguments.settings, "the path");
  add_no_check_option(command, arguments.check);
  add_quiet_option(command, arguments.quiet);
  add_setting_options(command, arguments.settings, names_of(SettingGroup::kMethod));
  command.footer(
      "The method finds the distances that lead the way: wavefront for a geodesic, heat for the "
      "other fields, unless --method names one.\n"
      "Examples:\n"
      "  geotherm path bunny --from 0 --to 1200 -o path.obj --json -\n"
      "  geotherm path model.obj --from 17 --to xyz:0:1:0 --to face:12:0.2:0.3:0.5 -o paths.csv\n"
      "  geotherm path sleeve --from 0 --via 900 --to 1800 --closed -o loop.svg");
}

Result<CommandOutput> run_path(const PathArguments& arguments, const Progress& progress) {
  const auto task = task_of(arguments);
  if (!task) return task.error();
  const auto check = check_settings(arguments.check);
  if (!check) return check.error();
  Outputs outputs;
  protect_inputs(arguments.model, {}, outputs);
  const auto expected = expect_line_files(arguments.files, outputs);
  if (!expected) return expected.error();
  auto model = load_model(arguments.model, task->reading, progress);
  if (!model) return model.error();
  if (auto surface = refuse_space(*model, "paths are"); !surface) return surface.error();
  PathFigures figures{*std::move(model), task->method, task->options, {}, 0, 0, {}, {}};
  figures.warnings = figures.model.notes;
  if (auto found = find_paths(*task, arguments.to.size(), check->against, progress, figures);
      !found) {
    return found.error();
  }
  note_unused_settings(arguments.settings, task->method, figures.warnings);

  CommandOutput out{"", figures.warnings, {}};
  const auto written = write_line_files(arguments.files, picture_of_paths(figures), task->picture,
                                        progress, outputs, out);
  if (!written) return written.error();
  if (!arguments.files.json.empty()) {
    const auto json =
        outputs.write_text(arguments.files.json, report_text(path_json(figures)), out.text);
    if (!json) return json.error();
  }
  if (!outputs.uses_stdout()) out.text = path_table(figures);
  out.made = outputs.made();
  return out;
}

}  // namespace geotherm::app
