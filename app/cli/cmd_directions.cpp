// SPDX-License-Identifier: MIT
// `logmap` and `trace`.
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "app/cli/commands.h"
#include "app/cli/many_work.h"
#include "app/cli/path_report.h"
#include "app/cli/vertex_columns.h"
#include "app/picture/direction_picture.h"
#include "app/session/model.h"
#include "app/session/progress.h"
#include "app/session/report.h"
#include "app/session/sources.h"
#include "app/session/wording.h"
#include "app/text/text.h"
#include "geotherm/directions.h"
#include "solver/core/memory.h"
#include "solver/core/stopwatch.h"
#include "solver/core/text.h"

namespace geotherm::app {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// What both commands begin with.
struct DirectionWork {
  Model model;
  SurfacePoint point;
  std::shared_ptr<const Directions> directions;
  TangentFrame frame;
  double setup_ms = 0;
  std::vector<Warning> warnings;
};

Result<DirectionWork> begin(const std::string& name, const ModelReading& reading,
                            const Source& source, const char* what, const Progress& progress) {
  auto model = load_model(name, reading, progress);
  if (!model) return model.error();
  if (auto surface = refuse_space(*model, what); !surface) return surface.error();
  DirectionWork work{*std::move(model), {}, {}, {}, 0, {}};
  work.warnings = work.model.notes;
  const auto placed = resolve_sources({&source, 1}, *work.model.mesh);
  if (!placed) return placed.error();
  work.warnings.insert(work.warnings.end(), placed->warnings.begin(), placed->warnings.end());
  work.point = placed->set.points.front();
  const Stopwatch watch;
  auto directions = Directions::build(work.model.mesh, part_of(progress, 0, 0.2));
  if (!directions) return about_model(work.model.name, directions.error());
  work.directions = *std::move(directions);
  auto frame = work.directions->frame_at(work.point);
  if (!frame) return about(source.where, frame.error());
  work.frame = *frame;
  work.setup_ms = watch.milliseconds();
  return work;
}

Json work_json(const DirectionWork& work, const char* stage, double ms) {
  const TangentFrame& f = work.frame;
  Json frame = {{"e1", vector_json(f.e1)},
                {"e2", vector_json(f.e2)},
                {"normal", vector_json(f.normal)},
                {"angle", f.angle},
                {"border", f.on_boundary}};
  if (f.first != kNoIndex) frame["first"] = f.first;
  return {{"model", brief_model_json(work.model)},
          {"from", point_json(work.point)},
          {"frame", std::move(frame)},
          {"timing_ms", {{"load", work.model.load_ms}, {"setup", work.setup_ms}, {stage, ms}}},
          {"warnings", to_text(work.warnings)}};
}

TextTable work_table(const DirectionWork& work) {
  TextTable table({{"", TextTable::Align::kLeft}, {"", TextTable::Align::kLeft}});
  table.add_row({"model", brief_model_text(work.model)});
  table.add_row({"frame", "e1 " + vector_text(work.frame.e1) + "; e2 " +
                              vector_text(work.frame.e2) + "; normal " +
                              vector_text(work.frame.normal)});
  table.add_row({"angle", significant(work.frame.angle, 7) + " round the point" +
                              (work.frame.on_boundary ? ", on the boundary" : "")});
  return table;
}

/// Columns distance, direction, map_x, map_y.
std::vector<VertexColumn> map_columns(const LogMap& map) {
  std::vector<VertexColumn> columns = {
      {"distance", map.distances}, {"direction", map.directions}, {"map_x", {}}, {"map_y", {}}};
  for (std::size_t v = 0; v < map.distances.size(); ++v) {
    const bool has = std::isfinite(map.distances[v]);
    columns[2].values.push_back(has ? map.distances[v] * std::cos(map.directions[v]) : kNone);
    columns[3].values.push_back(has ? map.distances[v] * std::sin(map.directions[v]) : kNone);
  }
  return columns;
}

/// The squares of the map: lines of its two coordinates.
Result<std::vector<Isoline>> map_grid(const TriangleMesh& mesh, const LogMap& map) {
  constexpr double kSquares = 12;  // from the point to the farthest vertex
  const auto columns = map_columns(map);
  double most = 0;
  for (const double d : map.distances) most = std::isfinite(d) ? std::max(most, d) : most;
  std::vector<double> levels;
  for (double k = -kSquares; k <= kSquares; ++k) levels.push_back(k * most / kSquares);
  const std::array<double, 2> axes = {0, std::numbers::pi / 2};
  return map_lines(mesh, columns[2].values, columns[3].values, axes, levels);
}

}  // namespace

void add_log_map_options(CLI::App& command, LogMapArguments& arguments) {
  add_model_option(command, arguments.model, arguments.settings)->required();
  command
      .add_option("-s,--source", arguments.source,
                  "the point: a vertex id, face:ID:b0:b1:b2 or xyz:x:y:z (the closest point of the "
                  "surface)")
      ->required()
      ->type_name("POINT");
  add_column_options(command, arguments.outputs, arguments.json,
                     "distance, direction (radians from e1 towards e2) and both as map_x and map_y "
                     "of every vertex",
                     true);
  add_line_picture_options(command, arguments.settings);
  add_max_distance_option(command, arguments.max_distance);
  add_target_option(command, arguments.targets, "the places");
  add_setting_options(command, arguments.settings, {"method"});
  command.get_option("--method")
      ->description("what finds the paths: exact (default), wavefront, wavefront-fine");
  add_quiet_option(command, arguments.quiet);
  command.footer(
      "Paths are exact on the faces, and so are directions; behind a vertex that bends a path they "
      "are those of its first piece. --method wavefront and wavefront-fine are near exact, and "
      "fast on large models. A picture shows squares of the map.\n"
      "Examples:\n"
      "  geotherm logmap gargoyle -s 17 --method wavefront --max-distance 0.5 -o map.svg\n"
      "  geotherm logmap bunny -s 17 -o map.npy --json -\n"
      "  geotherm logmap bunny -s 17 -o map.svg");
}

Result<CommandOutput> run_log_map(const LogMapArguments& arguments, const Progress& progress) {
  const auto asked = settings_in(arguments.settings);
  if (!asked) return asked.error();
  const auto source = single_point(arguments.source, "--source");
  if (!source) return source.error();
  const auto largest = max_distance_in(arguments.max_distance);
  if (!largest) return largest.error();
  LogMapOptions options{MethodKind::kExact, *largest, {}};
  if (arguments.settings.has("method")) options.method = asked->options.method;
  Outputs outputs;
  const auto expected = expect_columns(arguments.outputs, arguments.json, true, outputs);
  if (!expected) return expected.error();
  auto work = begin(arguments.model, asked->reading, *source, "log maps are", progress);
  if (!work) return work.error();
  const TriangleMesh& mesh = *work->model.mesh;
  auto targets = targets_of(arguments.targets, work->model);
  if (!targets) return targets.error();
  options.targets = *std::move(targets);
  const Stopwatch watch;
  const auto map = work->directions->log_map(work->point, options, part_of(progress, 0.2, 1));
  if (!map) return about_model(work->model.name, map.error());
  const double map_ms = watch.milliseconds();
  work->warnings.insert(work->warnings.end(), map->warnings.begin(), map->warnings.end());
  note_unused_picture(arguments.settings, arguments.outputs, work->warnings);
  const auto reached =
      std::ranges::count_if(map->distances, [](double d) { return std::isfinite(d); });
  if (options.max_distance == kUnreached && options.targets.empty()) {
    note_unreached(mesh, map->distances, "a source", work->warnings);
  }

  CommandOutput out{"", work->warnings, {}};
  for (const std::string& path : arguments.outputs) {
    if (io::file_extension(path) != ".svg") {
      const auto written = write_columns(path, mesh, map_columns(*map), outputs, out.text);
      if (!written) return written.error();
      continue;
    }
    const auto grid = map_grid(mesh, *map);
    if (!grid) return grid.error();
    LinePicture picture = picture_on(work->model, "squares of the log map");
    picture.markers = {position_at(mesh, work->point)};
    for (const Isoline& line : *grid) picture.lines.push_back({&line.path, line.value});
    const LineFileArguments file{{path}, ""};
    const auto written = write_line_files(file, picture, asked->picture, progress, outputs, out);
    if (!written) return written.error();
  }
  const auto report = [&] {
    Json json = work_json(*work, "log_map", map_ms);
    json["reached"] = reached;
    json["method"] = to_text(options.method);
    json["in_doubt"] = map->in_doubt;
    json["log_map"] = {{"distances", map->distances}, {"directions", map->directions}};
    return json;
  };
  const auto table = [&] {
    TextTable rows = work_table(*work);
    rows.add_row({"log map",
                  counted(reached, "vertex", "vertices") + " in " + milliseconds(map_ms) + " ms"});
    if (map->in_doubt > 0) {
      rows.add_row({"in doubt", counted(map->in_doubt, "direction", "directions")});
    }
    return rows.text();
  };
  return finish_command(std::move(out), outputs, arguments.json, report, table);
}

void add_trace_options(CLI::App& command, TraceArguments& arguments) {
  add_model_option(command, arguments.model, arguments.settings)->required();
  command
      .add_option("--from", arguments.from,
                  "where lines begin: a vertex id, face:ID:b0:b1:b2 or xyz:x:y:z (the closest "
                  "point of the surface)")
      ->required()
      ->type_name("POINT")
      ->group("Lines");
  may_repeat(command.add_option(
                 "--direction", arguments.directions,
                 "radians from e1 towards e2 of the frame that the report says; may be repeated; "
                 "default: 0"),
             "A")
      ->group("Lines");
  command
      .add_option("--fan", arguments.fan, "so many lines, in directions spread evenly all round")
      ->type_name("N")
      ->group("Lines");
  command.add_option("--length", arguments.length, "of each line, in the model's units")
      ->required()
      ->type_name("L")
      ->group("Lines");
  add_line_file_options(command, arguments.files, arguments.settings, "the lines");
  add_quiet_option(command, arguments.quiet);
  command.footer(
      "A line runs straight across edges and leaves the same angle on both sides of a vertex. It "
      "ends at the boundary, and where three faces meet.\n"
      "Examples:\n"
      "  geotherm trace bunny --from 17 --direction 0.5 --length 0.8 -o line.obj --json -\n"
      "  geotherm trace sleeve --from 0 --fan 24 --length 1 -o fan.svg");
}

namespace {

Result<std::vector<double>> directions_of(const TraceArguments& arguments,
                                          const TangentFrame& frame) {
  std::vector<double> out;
  for (const std::string& text : arguments.directions) {
    const auto angle = real_in("--direction", text, "angle in radians");
    if (!angle) return angle.error();
    out.push_back(*angle);
  }
  if (!arguments.fan.empty()) {
    constexpr Index kMax = 1000000;
    const auto count = whole_in("--fan", arguments.fan, "number of lines", 1, kMax);
    if (!count) return count.error();
    for (Index i = 0; i < *count; ++i) {
      out.push_back(frame.on_boundary ? frame.angle * (i + 0.5) / *count
                                      : 2 * std::numbers::pi * i / *count);
    }
  }
  if (out.empty()) out.push_back(0);
  return out;
}

/// Whether so many lines like the first fit into memory.
Result<void> check_lines_fit(const TracedLine& first, std::size_t count) {
  constexpr double kPiece = sizeof(SurfacePoint) + sizeof(Index), kMegabyte = 1024 * 1024;
  const double bytes =
      static_cast<double>(count) *
      (sizeof(TracedLine) + kPiece * static_cast<double>(first.path.points.size()));
  const auto free = free_memory();
  if (!free || bytes < static_cast<double>(*free)) return {};
  return Error{ErrorCode::kOutOfMemory,
               grouped(count) + " lines of some " + grouped(first.path.points.size()) +
                   " points take " + grouped(std::llround(bytes / kMegabyte)) + " MB, and " +
                   grouped(std::llround(static_cast<double>(*free) / kMegabyte)) + " MB are free",
               {"trace fewer or shorter ones"}};
}

Json lines_json(const TriangleMesh& mesh, const std::vector<double>& directions,
                const std::vector<TracedLine>& lines) {
  Json json = Json::array();
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const SurfacePath& path = lines[i].path;
    json.push_back({{"direction", directions[i]},
                    {"length", path.length},
                    {"end", to_text(lines[i].end)},
                    {"to", point_json(path.points.back())}});
    json.back().update(points_json(mesh, path));
  }
  return json;
}

}  // namespace

Result<CommandOutput> run_trace(const TraceArguments& arguments, const Progress& progress) {
  const auto asked = settings_in(arguments.settings);
  if (!asked) return asked.error();
  const auto source = single_point(arguments.from, "--from");
  if (!source) return source.error();
  const auto length = real_in("--length", arguments.length, "length");
  if (!length) return length.error();
  if (*length < 0) {
    return Error{ErrorCode::kBadInput,
                 "--length: " + one_line(arguments.length) + " is below 0",
                 {"give a length of 0 or more, in model units"}};
  }
  Outputs outputs;
  const auto expected = expect_line_files(arguments.files, outputs);
  if (!expected) return expected.error();
  auto work = begin(arguments.model, asked->reading, *source, "straightest lines are", progress);
  if (!work) return work.error();
  note_unused_picture(arguments.settings, arguments.files.outputs, work->warnings);
  const TriangleMesh& mesh = *work->model.mesh;
  const auto directions = directions_of(arguments, work->frame);
  if (!directions) return directions.error();
  const Stopwatch watch;
  std::vector<TracedLine> lines;
  for (const double direction : *directions) {
    auto line = work->directions->trace(work->point, direction, *length);
    if (!line) return about("--direction " + number_text(direction), line.error());
    lines.push_back(*std::move(line));
    if (lines.size() > 1) continue;
    if (auto room = check_lines_fit(lines.front(), directions->size()); !room) return room.error();
  }
  const double trace_ms = watch.milliseconds();

  CommandOutput out{"", work->warnings, {}};
  LinePicture picture = picture_on(work->model, counted(static_cast<std::int64_t>(lines.size()),
                                                        "straightest line", "straightest lines"));
  picture.markers = {position_at(mesh, work->point)};
  for (const TracedLine& line : lines) picture.lines.push_back({&line.path, {}});
  const auto written =
      write_line_files(arguments.files, picture, asked->picture, progress, outputs, out);
  if (!written) return written.error();
  const auto report = [&] {
    Json json = work_json(*work, "trace", trace_ms);
    json["traced"] = lines_json(mesh, *directions, lines);
    return json;
  };
  const auto table = [&] {
    TextTable rows = work_table(*work);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const TracedLine& line = lines[i];
      const bool whole = line.end == TraceEnd::kLength;
      rows.add_row(
          {"line",
           "direction " + significant((*directions)[i]) + ": " + significant(line.path.length, 7) +
               (whole                             ? ""
                : line.end == TraceEnd::kBoundary ? ", where the boundary is"
                                                  : ", where three faces or several fans meet")});
    }
    return rows.text();
  };
  return finish_command(std::move(out), outputs, arguments.files.json, report, table);
}

}  // namespace geotherm::app
