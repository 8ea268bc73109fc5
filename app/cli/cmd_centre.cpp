// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "app/cli/commands.h"
#include "app/session/model.h"
#include "app/session/progress.h"
#include "app/session/report.h"
#include "app/session/source_centre.h"
#include "app/session/sources.h"
#include "app/session/wording.h"
#include "app/text/text.h"
#include "geotherm/directions.h"
#include "solver/core/stopwatch.h"
#include "solver/core/text.h"
#include "solver/mesh/io/input_file.h"

namespace geotherm::app {
namespace {

/// What was asked for and what came out.
struct CentreFigures {
  Model model;
  CentreOptions options;
  std::vector<SurfacePoint> points;
  std::vector<double> weights;  ///< none: all 1
  Centres centres;
  std::vector<SurfacePath> paths;  ///< from the best to the points, where lines are written
  double centre_ms = 0;
  std::vector<Warning> warnings;
};

Result<std::vector<Source>> named_points(const CentreArguments& arguments) {
  std::vector<Source> out;
  for (const std::string& text : arguments.of) {
    auto spec = parse_source(text);
    if (!spec) return about("--of", spec.error());
    out.push_back({*std::move(spec), "--of " + one_line(text)});
  }
  if (!arguments.points.empty()) {
    auto more = read_source_file(arguments.points, false);
    if (!more) return more.error();
    out.insert(out.end(), more->begin(), more->end());
  }
  if (!out.empty()) return out;
  return Error{ErrorCode::kBadInput, "no point was given", {"name some with --of or --points"}};
}

/// Numbers with commas or blanks between: the text itself, or that of a file.
Result<std::vector<double>> weights_in(const std::string& text) {
  std::vector<double> out;
  if (text.empty()) return out;
  std::string numbers = text;
  const auto is_number = [](const std::string& word) {
    return number_in<double>(word).has_value();
  };
  const bool in_file = !is_number(numbers.substr(0, numbers.find(',')));
  const std::string where = in_file ? one_line(text) : "--weights";
  if (in_file) {
    const auto file = io::FileBytes::read(text);
    if (!file) return about("--weights", file.error());
    numbers = std::string(file->bytes());
  }
  std::ranges::replace(numbers, ',', ' ');
  std::istringstream words(numbers);
  for (std::string word; words >> word;) {
    const auto number = number_in<double>(word);
    if (!number || !(*number >= 0) || !std::isfinite(*number)) {
      return Error{in_file ? ErrorCode::kBadFile : ErrorCode::kBadInput,
                   where + ": '" + one_line(word) + "' is no weight",
                   {"give numbers from 0 on with commas between, or a file of them"}};
    }
    out.push_back(*number);
  }
  if (std::ranges::any_of(out, [](double weight) { return weight > 0; })) return out;
  return Error{in_file ? ErrorCode::kBadFile : ErrorCode::kBadInput,
               where + ": none is above 0",
               {"give one that is"}};
}

Result<void> place(const std::vector<Source>& named, CentreFigures& figures) {
  const auto placed = resolve_each(named, *figures.model.mesh);
  if (!placed) return placed.error();
  figures.warnings.insert(figures.warnings.end(), placed->warnings.begin(), placed->warnings.end());
  for (const SourceSet& set : placed->sets) {
    const SurfacePoint* const point = only_point(set);
    if (point == nullptr || !set.offsets.empty()) {
      return Error{ErrorCode::kBadInput,
                   "--of: point " + std::to_string(figures.points.size()) + " is none",
                   {"write vertex ids, random:K, face:ID:b0:b1:b2 or xyz:x:y:z, without offsets"}};
    }
    figures.points.push_back(*point);
  }
  const std::ptrdiff_t points = std::ssize(figures.points), weights = std::ssize(figures.weights);
  if (weights == 0 || weights == points) return {};
  return Error{ErrorCode::kBadInput,
               "--weights: " + counted(weights, "weight", "weights") + " for " +
                   counted(points, "point", "points"),
               {"give one for each, or none"}};
}

Json centre_json(const TriangleMesh& mesh, const Centre& centre) {
  const Json at = vector_json(position_at(mesh, centre.point));
  return {{"point", point_json(centre.point)}, {"position", at},
          {"energy", centre.energy},           {"residual", centre.residual},
          {"converged", centre.converged},     {"energies", centre.energies},
          {"distances", centre.distances}};
}

Json centres_json(const CentreFigures& f) {
  Json of = Json::array(), centres = Json::array();
  for (std::size_t i = 0; i < f.points.size(); ++i) {
    of.push_back(
        {{"point", point_json(f.points[i])}, {"weight", f.weights.empty() ? 1.0 : f.weights[i]}});
  }
  for (const Centre& centre : f.centres.found) {
    centres.push_back(centre_json(*f.model.mesh, centre));
  }
  return {{"model", brief_model_json(f.model)},
          {"method", to_text(f.options.method)},
          {"kind", to_text(f.options.kind)},
          {"of", std::move(of)},
          {"centres", std::move(centres)},
          {"timing_ms", {{"load", f.model.load_ms}, {"centre", f.centre_ms}}},
          {"warnings", to_text(f.warnings)}};
}

std::string centres_table(const CentreFigures& f) {
  TextTable figures({{"", TextTable::Align::kLeft}, {"", TextTable::Align::kLeft}});
  figures.add_row({"model", one_line(f.model.name) + ": " +
                                counted(f.model.mesh->vertex_count(), "vertex", "vertices")});
  figures.add_row({to_text(f.options.kind), "of " +
                                                counted(std::ssize(f.points), "point", "points") +
                                                ", " + milliseconds(f.centre_ms) + " ms"});
  constexpr auto kRight = TextTable::Align::kRight;
  TextTable list({{"at", TextTable::Align::kLeft},
                  {"energy", kRight},
                  {"farthest", kRight},
                  {"steps", kRight},
                  {"step left", kRight}});
  for (const Centre& centre : f.centres.found) {
    list.add_row({vector_text(position_at(*f.model.mesh, centre.point)), significant(centre.energy),
                  significant(*std::ranges::max_element(centre.distances)),
                  std::to_string(centre.energies.size() - 1), significant(centre.residual, 2)});
  }
  return figures.text() + '\n' + list.text();
}

LinePicture picture_of(const CentreFigures& f) {
  LinePicture picture = picture_on(f.model, to_text(f.options.kind));
  for (const SurfacePath& path : f.paths) picture.lines.push_back({&path, {}});
  picture.markers.push_back(position_at(*f.model.mesh, f.centres.found.front().point));
  for (const SurfacePoint& point : f.points) {
    picture.markers.push_back(position_at(*f.model.mesh, point));
  }
  return picture;
}

}  // namespace

void add_centre_options(CLI::App& command, CentreArguments& arguments) {
  add_model_option(command, arguments.model, arguments.settings)->required();
  may_repeat(command.add_option(
                 "--of", arguments.of,
                 "the points: 17 or 3,99,512 (vertex ids), random:K[:SEED], face:ID:b0:b1:b2 or "
                 "xyz:x:y:z (the closest point of the surface); may be repeated"),
             "POINTS")
      ->group("Points");
  command
      .add_option("--points", arguments.points,
                  "more of them, one a line: a vertex id, face:..., xyz:..., or x y z")
      ->type_name("FILE")
      ->group("Points");
  command
      .add_option("--weights", arguments.weights,
                  "of the points in their order, 0 or more: W1,W2,... or a file of them; default: "
                  "all 1")
      ->type_name("WEIGHTS")
      ->group("Points");
  command
      .add_flag("--median", arguments.median,
                "the sum of the distances is least, in place of that of their squares")
      ->group("Points");
  add_line_file_options(command, arguments.files, arguments.settings,
                        "the shortest paths from the centre to the points");
  add_quiet_option(command, arguments.quiet);
  add_setting_options(command, arguments.settings, {"method", "threads"});
  command.get_option("--method")
      ->description("what finds log maps: exact (default), wavefront, wavefront-fine");
  command.footer(
      "The report has the centre, further minima that are about as low, and the energy of each "
      "step. Log maps are exact unless --method names wavefront or wavefront-fine.\n"
      "Examples:\n"
      "  geotherm centre bunny --of 17,900,1500 --json -\n"
      "  geotherm centre bunny --of random:20 --median -o centre.svg");
}

Result<CommandOutput> run_centre(const CentreArguments& arguments, const Progress& progress) {
  const auto asked = settings_in(arguments.settings);
  if (!asked) return asked.error();
  const auto named = named_points(arguments);
  if (!named) return named.error();
  auto weights = weights_in(arguments.weights);
  if (!weights) return weights.error();
  Outputs outputs;
  const auto expected = expect_line_files(arguments.files, outputs);
  if (!expected) return expected.error();
  auto model = load_model(arguments.model, asked->reading, progress);
  if (!model) return model.error();
  if (auto surface = refuse_space(*model, "centres are"); !surface) return surface.error();

  CentreFigures figures{*std::move(model), {}, {}, *std::move(weights), {}, {}, 0, {}};
  figures.warnings = figures.model.notes;
  if (arguments.median) figures.options.kind = CentreKind::kMedian;
  if (arguments.settings.has("method")) figures.options.method = asked->options.method;
  figures.options.threads = asked->options.threads;
  if (auto placed = place(*named, figures); !placed) return placed.error();
  const Stopwatch watch;
  auto centres = find_centres(figures.model.mesh, figures.points, figures.weights, figures.options,
                              part_of(progress, 0, 0.8));
  if (!centres) return about_model(figures.model.name, centres.error());
  figures.centre_ms = watch.milliseconds();
  figures.centres = *std::move(centres);
  const auto& notes = figures.centres.warnings;
  figures.warnings.insert(figures.warnings.end(), notes.begin(), notes.end());
  note_unused_picture(arguments.settings, arguments.files.outputs, figures.warnings);

  CommandOutput out{"", figures.warnings, {}};
  if (!arguments.files.outputs.empty()) {
    auto ways = ways_from(figures.model, figures.centres.found.front(), figures.points,
                          figures.options.threads, part_of(progress, 0.8, 1));
    if (!ways) return ways.error();
    figures.paths = *std::move(ways);
    const auto written = write_line_files(arguments.files, picture_of(figures), asked->picture,
                                          progress, outputs, out);
    if (!written) return written.error();
  }
  return finish_command(
      std::move(out), outputs, arguments.files.json, [&] { return centres_json(figures); },
      [&] { return centres_table(figures); });
}

}  // namespace geotherm::app
