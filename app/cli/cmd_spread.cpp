// SPDX-License-Identifier: MIT
// `transport` and `extend`.
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <sstream>

#include "app/cli/commands.h"
#include "app/cli/vertex_columns.h"
#include "app/session/model.h"
#include "app/session/progress.h"
#include "app/session/report.h"
#include "app/session/sources.h"
#include "app/session/wording.h"
#include "app/text/text.h"
#include "geotherm/directions.h"
#include "solver/core/stopwatch.h"
#include "solver/core/text.h"
#include "solver/mesh/io/input_file.h"

namespace geotherm::app {
namespace {

/// A vertex and the numbers behind it.
struct AtVertex {
  Index vertex = kNoIndex;
  std::vector<double> numbers;
  Source source;  ///< the vertex, for the words when there is none such
};

/// What is given, and where that is said.
struct GivenText {
  std::string text, where;
  ErrorCode blame = ErrorCode::kBadInput;
};

/// The lines of a file, whose numbers blanks or commas divide, as they would be typed.
Result<void> add_lines(const std::string& path, const std::string& option,
                       std::vector<GivenText>& out) {
  const auto file = io::FileBytes::read(path);
  if (!file) return about(option, file.error());
  std::istringstream lines{std::string(file->bytes())};
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    line.erase(std::min(line.find('#'), line.size()));
    std::ranges::replace(line, ',', ' ');
    std::istringstream words(line);
    std::string joined;
    for (std::string word; words >> word;) joined += (joined.empty() ? "" : ":") + word;
    if (!joined.empty())
      out.push_back(
          {joined, one_line(path) + ": line " + std::to_string(number), ErrorCode::kBadFile});
  }
  return {};
}

/// Its numbers as they may be typed.
std::string numbers_text(const AtVertex& given) {
  std::string text;
  for (const double x : given.numbers) text += (text.empty() ? "" : ":") + number_text(x);
  return text;
}

/// V:X or V:X:Y. `option`: of a single one; that of the file has an s behind it.
Result<std::vector<AtVertex>> given_in(const SpreadArguments& arguments, const std::string& option,
                                       std::size_t numbers) {
  std::vector<GivenText> texts;
  for (const std::string& text : arguments.given) texts.push_back({text, option});
  if (!arguments.file.empty()) {
    if (auto added = add_lines(arguments.file, option + "s", texts); !added) return added.error();
  }
  if (texts.empty()) {
    return Error{ErrorCode::kBadInput,
                 "nothing was given",
                 {"give some with " + option + ", or " + option + "s FILE"}};
  }
  std::vector<AtVertex> out;
  for (const auto& [text, where, blame] : texts) {
    AtVertex& given = out.emplace_back();
    const std::vector<std::string_view> parts = split(text, ':');
    const auto vertex = number_in<Index>(parts.front());
    given.vertex = vertex.value_or(kNoIndex);
    bool fine = vertex && *vertex >= 0 && parts.size() == numbers + 1;
    for (std::size_t k = 1; k < parts.size(); ++k) {
      const auto number = number_in<double>(parts[k]);
      fine = fine && number && std::isfinite(*number);
      given.numbers.push_back(number.value_or(0));
    }
    const std::string named = where == option ? option + ' ' + one_line(text) : where;
    given.source = {VertexList{{given.vertex}}, named, blame};
    if (fine) continue;
    return Error{blame,
                 where + ": '" + one_line(text) + "' is no " + (numbers == 2 ? "vector" : "value") +
                     " at a vertex",
                 {std::string("write ") +
                  (numbers == 2 ? "VERTEX:X:Y, along e1 and e2 of the vertex" : "VERTEX:VALUE") +
                  (where == option ? "" : ", or the numbers with blanks between")}};
  }
  return out;
}

/// Refuses two things that differ at one vertex, or at several that were merged into one.
Result<void> one_at_each(const std::vector<AtVertex>& given, const TriangleMesh& mesh) {
  std::map<Index, const AtVertex*> first;
  for (const AtVertex& each : given) {
    const auto [known, is_new] = first.try_emplace(mesh.standing_for(each.vertex), &each);
    const AtVertex& other = *known->second;
    if (is_new || other.numbers == each.numbers) continue;
    const std::string vertex = std::to_string(each.vertex);
    return Error{
        ErrorCode::kBadInput,
        each.source.where + ": " +
            (other.vertex == each.vertex ? "vertex " + vertex + " was"
                                         : "vertices " + std::to_string(other.vertex) + " and " +
                                               vertex + ", which are one, were") +
            " given " + numbers_text(other) + " and " + numbers_text(each),
        {"give one for each vertex"}};
  }
  return {};
}

struct SpreadWork {
  Model model;
  std::shared_ptr<const VectorHeat> heat;
  Spread spread;
  double setup_ms = 0, solve_ms = 0;
};

using Ask = std::function<Result<Spread>(const VectorHeat& heat, const Progress& progress)>;

Result<SpreadWork> spread_over(const SpreadArguments& arguments, const ViewerState& asked,
                               const std::vector<AtVertex>& given, const char* what, const Ask& ask,
                               const Progress& progress) {
  auto model = load_model(arguments.model, asked.reading, progress);
  if (!model) return model.error();
  if (auto surface = refuse_space(*model, what); !surface) return surface.error();
  for (const AtVertex& each : given) {
    const auto placed = resolve_sources({&each.source, 1}, *model->mesh);
    if (!placed) return placed.error();
  }
  if (auto single = one_at_each(given, *model->mesh); !single) return single.error();
  SpreadWork work{*std::move(model), {}, {}, 0, 0};
  const Stopwatch setup;
  const SpreadOptions options{asked.options.backend, asked.options.time_step.factor,
                              asked.options.threads};
  auto heat = VectorHeat::build(work.model.mesh, options, part_of(progress, 0, 0.7));
  if (!heat) return about_model(work.model.name, heat.error());
  work.heat = *std::move(heat);
  work.setup_ms = setup.milliseconds();
  const Stopwatch solving;
  auto spread = ask(*work.heat, part_of(progress, 0.7, 1));
  if (!spread) return about_model(work.model.name, spread.error());
  work.spread = *std::move(spread);
  work.solve_ms = solving.milliseconds();
  work.spread.warnings.insert(work.spread.warnings.begin(), work.model.notes.begin(),
                              work.model.notes.end());
  return work;
}

Json spread_json(const SpreadWork& work, const std::vector<AtVertex>& given, Index reached) {
  Json from = Json::array();
  for (const AtVertex& each : given) {
    from.push_back({{"vertex", each.vertex}, {"numbers", each.numbers}});
  }
  return {{"model", brief_model_json(work.model)},
          {"given", std::move(from)},
          {"reached", reached},
          {"t", work.spread.t},
          {"timing_ms",
           {{"load", work.model.load_ms}, {"setup", work.setup_ms}, {"solve", work.solve_ms}}},
          {"warnings", to_text(work.spread.warnings)}};
}

/// Arrows along the vectors of vertices that lie evenly, the longest as long as their spacing.
Result<std::vector<SurfacePath>> arrows(const SpreadWork& work) {
  constexpr double kCells = 18, kBarb = 0.3, kBarbAngle = 0.5;
  const TriangleMesh& mesh = *work.model.mesh;
  const auto directions = Directions::build(work.model.mesh);
  if (!directions) return directions.error();
  Vec3 low = Vec3::Constant(kUnreached), high = -low;
  double longest = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const double norm = work.spread.vectors[v].norm();
    if (!std::isfinite(norm)) continue;
    longest = std::max(longest, norm);
    low = low.cwiseMin(mesh.positions()[v]);
    high = high.cwiseMax(mesh.positions()[v]);
  }
  const double cell = (high - low).maxCoeff() / kCells;
  std::set<std::array<int, 3>> taken;
  std::vector<SurfacePath> lines;
  const auto draw = [&](const SurfacePoint& from, double direction, double length) {
    auto line = (*directions)->trace(from, direction, length);
    const bool drawn = line && line->path.length > 0;  // else it leaves the surface
    if (drawn) lines.push_back(line->path);
    return drawn ? *line : TracedLine{};
  };
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const auto [x, y] = work.spread.components[v];
    const double length = 0.8 * cell * std::hypot(x, y) / longest;
    if (!std::isfinite(x) || !(length > 0)) continue;
    const Vec3 place = (mesh.positions()[v] - low) / cell;
    if (!taken.insert({int(place.x()), int(place.y()), int(place.z())}).second) continue;
    const TracedLine line = draw(SurfacePoint::at_vertex(v), std::atan2(y, x), length);
    if (line.path.points.empty() || std::isnan(line.direction)) continue;
    for (const double hand : {-1, 1}) {
      draw(line.path.points.back(), line.direction + std::numbers::pi + hand * kBarbAngle,
           kBarb * length);
    }
  }
  return lines;
}

std::string spread_table(const SpreadWork& work, const char* what, Index reached) {
  TextTable table({{"", TextTable::Align::kLeft}, {"", TextTable::Align::kLeft}});
  table.add_row({"model", brief_model_text(work.model)});
  table.add_row({what, "at " + counted(reached, "vertex", "vertices")});
  table.add_row({"t", significant(work.spread.t)});
  table.add_row({"set-up", milliseconds(work.setup_ms) + " ms"});
  table.add_row({"solve", milliseconds(work.solve_ms) + " ms"});
  return table.text();
}

Result<void> write_arrows(const std::string& path, const SpreadWork& work,
                          const PictureSettings& settings, const Progress& progress,
                          Outputs& outputs, CommandOutput& out) {
  LinePicture picture = picture_on(work.model, "transported vectors");
  picture.shows_hidden = false;
  const auto lines = arrows(work);
  if (!lines) return lines.error();
  for (const SurfacePath& line : *lines) picture.lines.push_back({&line, 0.0});
  return write_line_files({{path}, ""}, picture, settings, progress, outputs, out);
}

void add_spread_options(CLI::App& command, SpreadArguments& arguments, const char* option,
                        const char* form, const char* help, const char* what, bool pictures) {
  add_model_option(command, arguments.model, arguments.settings)->required();
  may_repeat(command.add_option(option, arguments.given, help), form);
  command
      .add_option(std::string(option) + "s", arguments.file,
                  std::string("a file of them, one a line: ") + form +
                      ", or the numbers with blanks or commas between")
      ->type_name("FILE");
  add_column_options(command, arguments.outputs, arguments.json, what, pictures);
  if (pictures) add_line_picture_options(command, arguments.settings);
  add_quiet_option(command, arguments.quiet);
  add_setting_options(command, arguments.settings, {"backend", "time-factor", "threads"});
}

}  // namespace

void add_transport_options(CLI::App& command, SpreadArguments& arguments) {
  add_spread_options(
      command, arguments, "--vector", "V:X:Y",
      "a vector at a vertex by its components along e1 and e2 there, which the "
      "outputs say of every vertex; may be repeated",
      "the vectors, in space (vx, vy, vz) and in the frames (u, v), and e1 and e2 of "
      "each vertex",
      true);
  command.footer(
      "The vector heat method: each vertex gets the vector of the nearest of those given, carried "
      "along the shortest path. A picture has arrows on the surface.\n"
      "Examples:\n"
      "  geotherm transport bunny --vector 17:1:0 -o vectors.npy\n"
      "  geotherm transport bunny --vector 17:1:0 --vector 900:0:2 -o vectors.svg");
}

Result<CommandOutput> run_transport(const SpreadArguments& arguments, const Progress& progress) {
  const auto asked = settings_in(arguments.settings);
  if (!asked) return asked.error();
  const auto given = given_in(arguments, "--vector", 2);
  if (!given) return given.error();
  Outputs outputs;
  const auto expected = expect_columns(arguments.outputs, arguments.json, true, outputs);
  if (!expected) return expected.error();
  std::vector<TangentVector> vectors;
  for (const AtVertex& v : *given) vectors.push_back({v.vertex, v.numbers[0], v.numbers[1]});
  auto work = spread_over(
      arguments, *asked, *given, "vectors are",
      [&](const VectorHeat& heat, const Progress& part) { return heat.transport(vectors, part); },
      progress);
  if (!work) return work.error();
  note_unused_picture(arguments.settings, arguments.outputs, work->spread.warnings);

  std::vector<VertexColumn> columns;
  for (const char* name : {"vx", "vy", "vz", "u", "v", "e1x", "e1y", "e1z", "e2x", "e2y", "e2z"}) {
    columns.push_back({name, {}});
  }
  Index reached = 0;
  const auto frames = work->heat->frames();
  if (!frames) return frames.error();
  for (std::size_t v = 0; v < work->spread.vectors.size(); ++v) {
    const TangentFrame& frame = (*frames)[v];
    for (int k = 0; k < 3; ++k) {
      columns[k].values.push_back(work->spread.vectors[v][k]);
      columns[5 + k].values.push_back(frame.e1[k]);
      columns[8 + k].values.push_back(frame.e2[k]);
    }
    for (int k = 0; k < 2; ++k) columns[3 + k].values.push_back(work->spread.components[v][k]);
    reached += std::isfinite(work->spread.components[v][0]) ? 1 : 0;
  }
  CommandOutput out{"", work->spread.warnings, {}};
  for (const std::string& path : arguments.outputs) {
    const auto written = io::file_extension(path) == ".svg"
                             ? write_arrows(path, *work, asked->picture, progress, outputs, out)
                             : write_columns(path, *work->model.mesh, columns, outputs, out.text);
    if (!written) return written.error();
  }
  const auto report = [&] {
    Json json = spread_json(*work, *given, reached);
    json["components"] = work->spread.components;
    json["vectors"] = json["tangent_frames"]["e1"] = json["tangent_frames"]["e2"] = Json::array();
    for (const Vec3& v : work->spread.vectors) json["vectors"].push_back(vector_json(v));
    for (const TangentFrame& frame : *frames) {
      json["tangent_frames"]["e1"].push_back(vector_json(frame.e1));
      json["tangent_frames"]["e2"].push_back(vector_json(frame.e2));
    }
    return json;
  };
  return finish_command(std::move(out), outputs, arguments.json, report,
                        [&] { return spread_table(*work, "vectors", reached); });
}

void add_extend_options(CLI::App& command, SpreadArguments& arguments) {
  add_spread_options(command, arguments, "--value", "V:X", "a value at a vertex; may be repeated",
                     "the values", false);
  command.footer(
      "Each vertex gets the value of the nearest of those given; where two are almost as near, one "
      "between them.\n"
      "Example:\n"
      "  geotherm extend bunny --value 17:1 --value 900:5 -o values.ply");
}

Result<CommandOutput> run_extend(const SpreadArguments& arguments, const Progress& progress) {
  const auto asked = settings_in(arguments.settings);
  if (!asked) return asked.error();
  const auto given = given_in(arguments, "--value", 1);
  if (!given) return given.error();
  Outputs outputs;
  const auto expected = expect_columns(arguments.outputs, arguments.json, false, outputs);
  if (!expected) return expected.error();
  std::vector<Index> vertices;
  std::vector<double> values;
  for (const AtVertex& each : *given) {
    vertices.push_back(each.vertex);
    values.push_back(each.numbers[0]);
  }
  const auto work = spread_over(
      arguments, *asked, *given, "carried values are",
      [&](const VectorHeat& heat, const Progress& part) {
        return heat.extend(vertices, values, part);
      },
      progress);
  if (!work) return work.error();
  const std::vector<double>& all = work->spread.values;
  const auto reached =
      static_cast<Index>(std::ranges::count_if(all, [](double x) { return std::isfinite(x); }));
  CommandOutput out{"", work->spread.warnings, {}};
  for (const std::string& path : arguments.outputs) {
    const auto written =
        write_columns(path, *work->model.mesh, {{"value", all}}, outputs, out.text);
    if (!written) return written.error();
  }
  const auto report = [&] {
    Json json = spread_json(*work, *given, reached);
    json["values"] = all;
    return json;
  };
  return finish_command(std::move(out), outputs, arguments.json, report,
                        [&] { return spread_table(*work, "values", reached); });
}

}  // namespace geotherm::app
