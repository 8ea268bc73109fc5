// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>

#include <limits>

#include "app/cli/commands.h"
#include "app/picture/picture_text.h"
#include "app/session/model_solver.h"
#include "app/session/report.h"
#include "app/session/sources.h"
#include "app/session/wording.h"
#include "app/text/text.h"
#include "geotherm/path.h"

namespace geotherm::app {
namespace {

constexpr int kMaxLevels = 100000;

/// Where the lines are to be, before the distances are known.
struct Levels {
  double spacing = 0;
  int count = 0;               ///< 0: by spacing
  std::vector<double> values;  ///< that were asked for, instead of both
};

Result<Levels> levels_in(const IsolinesArguments& arguments) {
  const int given =
      !arguments.spacing.empty() + !arguments.count.empty() + !arguments.values.empty();
  if (given != 1) {
    return Error{ErrorCode::kBadInput,
                 std::string("--spacing, --count and --values: ") +
                     (given == 0   ? "none"
                      : given == 2 ? "two"
                                   : "all") +
                     " of them given",
                 {"give one, such as --spacing 0.1, --count 20 or --values 0.1,0.2,0.5"}};
  }
  Levels levels;
  if (!arguments.values.empty()) {
    auto values = parse_values(arguments.values);
    if (!values) return about("--values", values.error());
    if (values->empty() || values->front() <= 0) {
      return Error{ErrorCode::kBadInput,
                   "--values: '" + one_line(arguments.values) + "' are no distances of lines",
                   {"give numbers above 0, in model units, such as 0.1,0.2,0.5"}};
    }
    levels.values = *std::move(values);
    return levels;
  }
  if (!arguments.count.empty()) {
    const auto count = whole_in("--count", arguments.count, "number of levels", 1, kMaxLevels);
    if (!count) return count.error();
    levels.count = *count;
    return levels;
  }
  const auto spacing =
      real_in("--spacing", arguments.spacing, "distance between lines",
              "give a number above 0, in model units", std::numeric_limits<double>::denorm_min());
  if (!spacing) return spacing.error();
  levels.spacing = *spacing;
  return levels;
}

/// Multiples of the spacing, or as many as were asked for evenly between 0 and the largest distance
/// (both left out).
Result<std::vector<double>> levels_up_to(double largest, const Levels& asked) {
  if (!asked.values.empty()) return asked.values;
  std::vector<double> levels;
  if (asked.count > 0) {
    for (int i = 1; i <= asked.count; ++i) {
      levels.push_back(largest * (static_cast<double>(i) / (asked.count + 1)));
    }
    return levels;
  }
  const double number = largest / asked.spacing;
  if (number > kMaxLevels) {
    return Error{ErrorCode::kBadInput,
                 "--spacing: " + significant(asked.spacing) + " makes " + significant(number) +
                     " lines up to the largest "
                     "distance " +
                     significant(largest) + ", more than " + grouped(kMaxLevels),
                 {"give a larger one"}};
  }
  for (int i = 1; i * asked.spacing < largest; ++i) levels.push_back(i * asked.spacing);
  return levels;
}

/// Why there is none.
Warning no_line(const std::vector<double>& levels, double spacing, const Answer& figures) {
  const std::string largest = significant(figures.distance.max);
  if (!levels.empty()) {
    return {"there is no line: no triangle is crossed by a level, of distances up to " + largest,
            {"give values below that"}};
  }
  return {"there is no line: the largest distance is " + largest + ", the first level " +
              significant(spacing),
          {"give a smaller spacing"}};
}

Json isolines_json(const Answer& figures, const std::vector<double>& levels,
                   const std::vector<Isoline>& lines) {
  Json json = {{"model", model_json(figures.model, figures.mesh)},
               {"method", to_text(figures.method->kind())},
               {"sources", sources_json(figures.sources)},
               {"levels", levels},
               {"lines", Json::array()},
               {"warnings", to_text(figures.warnings)}};
  if (figures.error) json["error"] = error_json(*figures.error);
  double total = 0;
  for (const Isoline& line : lines) {
    total += line.path.length;
    json["lines"].push_back({{"value", line.value},
                             {"length", line.path.length},
                             {"closed", line.path.closed},
                             {"points", line.path.points.size()}});
  }
  json["length"] = total;
  return json;
}

std::string isolines_table(const Answer& figures, const std::vector<double>& levels,
                           const std::vector<Isoline>& lines) {
  TextTable table({{"value", TextTable::Align::kRight},
                   {"lines", TextTable::Align::kRight},
                   {"closed", TextTable::Align::kRight},
                   {"length", TextTable::Align::kRight}});
  std::size_t next = 0;
  for (const double level : levels) {
    std::int64_t count = 0, closed = 0;
    double length = 0;
    for (; next < lines.size() && lines[next].value == level; ++next) {
      ++count;
      closed += lines[next].path.closed ? 1 : 0;
      length += lines[next].path.length;
    }
    table.add_row({significant(level), grouped(count), grouped(closed), significant(length)});
  }
  return one_line(figures.model.name) + ": " +
         counted(static_cast<std::int64_t>(lines.size()), "line", "lines") + " at " +
         counted(static_cast<std::int64_t>(levels.size()), "level", "levels") +
         ", distances up to " + significant(figures.distance.max) + " (" +
         to_text(figures.method->kind()) + ")\n" +
         (figures.error ? "error: " + to_text(accuracy_line(*figures.error)) + '\n' : "") +
         table.text();
}

LinePicture picture_of_lines(const Answer& figures, const std::vector<Isoline>& lines) {
  LinePicture picture = picture_on(
      figures.model, to_text(figures.method->kind()) + ", " +
                         counted(static_cast<std::int64_t>(lines.size()), "line", "lines"));
  for (const Isoline& line : lines) picture.lines.push_back({&line.path, line.value});
  for (const SurfacePoint& source : figures.sources.points) {
    picture.markers.push_back(position_at(*figures.model.mesh, source));
  }
  picture.largest_value = figures.distance.max;
  return picture;
}

}  // namespace

void add_isolines_options(CLI::App& command, IsolinesArguments& arguments) {
  add_model_option(command, arguments.model, arguments.settings)->required();
  add_source_options(command, arguments.sources);
  command.add_option("--spacing", arguments.spacing, "between lines, in model units")
      ->type_name("D");
  command
      .add_option("--count", arguments.count,
                  "of levels, evenly between 0 and the largest distance")
      ->type_name("N");
  command
      .add_option("--values", arguments.values,
                  "of the lines, in model units, such as 0.1,0.2,0.5; up to 64")
      ->type_name("V1,V2,...");
  add_setting_options(command, arguments.settings, {"bar-label", "units", "number-format"});
  add_line_file_options(command, arguments.files, arguments.settings, "the lines");
  add_check_options(command, arguments.check);
  add_quiet_option(command, arguments.quiet);
  add_setting_options(command, arguments.settings, names_of(SettingGroup::kMethod));
  command.footer(
      "Examples:\n"
      "  geotherm isolines bunny -s 0 --count 20 -o lines.obj\n"
      "  geotherm isolines bunny -s 0 --values 0.1,0.2,0.5 -o lines.csv\n"
      "  geotherm isolines terrain -s boundary --spacing 0.05 -o lines.svg --azimuth 60");
}

Result<CommandOutput> run_isolines(const IsolinesArguments& arguments, const Progress& progress) {
  const auto asked = settings_in(arguments.settings);
  if (!asked) return asked.error();
  const MethodOptions& options = asked->options;
  PictureSettings picture = asked->picture;
  const auto wanted = levels_in(arguments);
  if (!wanted) return wanted.error();
  const auto check = check_settings(arguments.check);
  if (!check) return check.error();
  Outputs outputs;
  const auto expected = expect_line_files(arguments.files, outputs);
  if (!expected) return expected.error();
  const auto named = some_sources_of(arguments.sources);
  if (!named) return named.error();
  auto model = load_model(arguments.model, asked->reading, progress);
  if (!model) return model.error();
  const auto sources = resolve_sources(*named, *model);
  if (!sources) return sources.error();
  ModelSolver solver(*std::move(model));
  auto figures = solver.solve(options, *sources, {{}, *check}, progress);
  if (!figures) return figures.error();
  note_unused_settings(arguments.settings, options, figures->warnings);
  note_unused_picture(arguments.settings, arguments.files.outputs, figures->warnings);
  const auto levels = levels_up_to(figures->distance.max, *wanted);
  if (!levels) return levels.error();
  const auto found = find_isolines(*figures->model.mesh, figures->result.distances, *levels);
  if (!found) return found.error();
  const std::vector<Isoline>& lines = *found;

  const Model& shown = figures->model;
  face_head_on(shown, arguments.settings, picture);
  if (lines.empty()) figures->warnings.push_back(no_line(*levels, wanted->spacing, *figures));
  const std::string unseen = shown.space ? shown.space->unseen() : "";
  if (!unseen.empty()) figures->warnings.push_back({unseen});
  CommandOutput out{"", figures->warnings, {}};
  const auto written = write_line_files(arguments.files, picture_of_lines(*figures, lines), picture,
                                        progress, outputs, out);
  if (!written) return written.error();
  out.note = accuracy_note(arguments.files.json, outputs, arguments.quiet, figures->error);
  return finish_command(
      std::move(out), outputs, arguments.files.json,
      [&] { return isolines_json(*figures, *levels, lines); },
      [&] { return isolines_table(*figures, *levels, lines); });
}

}  // namespace geotherm::app
