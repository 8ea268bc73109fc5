// SPDX-License-Identifier: MIT
// `signed`.
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "app/cli/commands.h"
#include "app/cli/vertex_columns.h"
#include "app/session/model.h"
#include "app/session/model_solver.h"
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

Error bad_line(const std::string& path, std::size_t line) {
  return {ErrorCode::kBadFile,
          one_line(path) + ": line " + std::to_string(line) + " is no point of a curve",
          {"give what geotherm path and isolines write: line,point,x,y,z,face,b0,b1,b2"}};
}

/// Lines as path and isolines write them into .csv.
Result<std::vector<SurfacePath>> curves_in(const std::string& path, const TriangleMesh& mesh) {
  const auto bytes = io::FileBytes::read(path);
  if (!bytes) return about("--curves", bytes.error());
  std::istringstream file{std::string(bytes->bytes())};
  constexpr std::size_t kColumns = 9;
  std::vector<SurfacePath> curves;
  std::string text, last;
  for (std::size_t number = 1; std::getline(file, text); ++number) {
    if (number == 1 || trimmed(text).empty()) continue;
    std::vector<std::string> words;
    std::stringstream row(text);
    for (std::string word; std::getline(row, word, ',');) words.emplace_back(trimmed(word));
    if (words.size() < kColumns) return bad_line(path, number);
    const auto face = number_in<Index>(words[5]);
    SurfacePoint point = SurfacePoint::in_face(face.value_or(kNoIndex), {});
    bool fine = face && *face >= 0 && *face < mesh.face_count();
    for (std::size_t k = 0; k < 3; ++k) {
      const auto weight = number_in<double>(words[6 + k]);
      fine = fine && weight;
      point.weights[k] = weight.value_or(0);
    }
    if (!fine) return bad_line(path, number);
    if (curves.empty() || words[0] != last) curves.emplace_back();
    last = words[0];
    curves.back().points.push_back(point);
  }
  const auto is_one = [](const SurfacePath& curve) { return curve.points.size() > 1; };
  if (std::ranges::any_of(curves, is_one)) return curves;
  return Error{ErrorCode::kBadFile,
               one_line(path) + ": there is no curve with two points or more in it",
               {"give what geotherm path and isolines write"}};
}

/// The points of one curve, joined by geodesics.
Result<SurfacePath> curve_through(const std::vector<std::string>& texts, bool closed,
                                  const Model& model, std::vector<Warning>& warnings,
                                  const Progress& progress) {
  if (texts.size() == 1) {
    return Error{ErrorCode::kBadInput,
                 "--through: a curve has two points or more",
                 {"give it once for each point"}};
  }
  std::vector<SurfacePoint> points;
  for (const std::string& text : texts) {
    const auto source = single_point(text, "--through");
    if (!source) return source.error();
    const auto placed = resolve_sources({&*source, 1}, *model.mesh);
    if (!placed) return placed.error();
    points.push_back(placed->set.points.front());
    warnings.insert(warnings.end(), placed->warnings.begin(), placed->warnings.end());
  }
  MethodOptions options;
  options.method = MethodKind::kWavefront;
  ModelSolver solver(model);
  const auto ready = solver.prepare(options, part_of(progress, 0, 0.3));
  if (!ready) return ready.error();
  auto found = PathFinder(model.mesh, ready->method)
                   .find(points, {PathField::kGeodesic, closed, closed}, part_of(progress, 0.3, 1));
  if (!found) return about_model(model.name, about("--through", found.error()));
  if (found->path.points.size() < 2) {
    return Error{ErrorCode::kBadInput,
                 "--through: the points are in one place, which is no curve",
                 {"give two that are apart"}};
  }
  warnings.insert(warnings.end(), found->warnings.begin(), found->warnings.end());
  return std::move(found->path);
}

Result<std::vector<SurfacePath>> asked_curves(const SignedArguments& arguments, const Model& model,
                                              std::vector<Warning>& warnings,
                                              const Progress& progress) {
  std::vector<SurfacePath> curves;
  if (!arguments.curves.empty()) {
    auto read = curves_in(arguments.curves, *model.mesh);
    if (!read) return read;
    curves = *std::move(read);
  }
  if (!arguments.through.empty()) {
    auto curve = curve_through(arguments.through, arguments.closed, model, warnings, progress);
    if (!curve) return curve.error();
    curves.push_back(*std::move(curve));
  }
  return curves;
}

/// Level sets at some twenty distances, and the curves themselves.
Result<void> write_levels(const std::string& path, const Model& model,
                          const std::vector<SurfacePath>& curves, const SignedDistance& found,
                          const PictureSettings& settings, const Progress& progress,
                          Outputs& outputs, CommandOutput& out) {
  constexpr double kWanted = 20;
  double least = 0, largest = 0;
  for (const double d : found.distances) {
    if (!std::isfinite(d)) continue;
    least = std::min(least, d);
    largest = std::max(largest, d);
  }
  const double step = (largest - least) / kWanted;
  std::vector<double> levels;
  for (double k = std::ceil(least / step); k * step <= largest; ++k) {
    if (k != 0) levels.push_back(k * step);
  }
  const auto lines = find_isolines(*model.mesh, found.distances, levels);
  if (!lines) return lines.error();
  LinePicture picture = picture_on(model, "signed distance");
  picture.least_value = least;
  picture.largest_value = largest;
  for (const Isoline& line : *lines) picture.lines.push_back({&line.path, line.value});
  for (const SurfacePath& curve : curves) picture.lines.push_back({&curve, {}});
  return write_line_files({{path}, ""}, picture, settings, progress, outputs, out);
}

}  // namespace

void add_signed_options(CLI::App& command, SignedArguments& arguments) {
  add_model_option(command, arguments.model, arguments.settings)->required();
  may_repeat(command.add_option(
                 "--through", arguments.through,
                 "a point of a curve: a vertex id, face:ID:b0:b1:b2 or xyz:x:y:z; repeated, in "
                 "order, geodesics between them"),
             "POINT")
      ->group("Curves");
  command
      .add_flag("--closed", arguments.closed, "that curve goes on from its last point to the first")
      ->group("Curves");
  command
      .add_option("--curves", arguments.curves,
                  "curves as geotherm path and isolines write them into .csv")
      ->type_name("FILE")
      ->group("Curves");
  command
      .add_option("--rule", arguments.rule,
                  "auto (default: sides, or heat where the curves do not separate the surface), "
                  "sides (exact), heat (the signed heat method, which closes gaps)")
      ->type_name("NAME");
  add_column_options(command, arguments.outputs, arguments.json, "signed distances", true);
  add_line_picture_options(command, arguments.settings);
  add_quiet_option(command, arguments.quiet);
  add_setting_options(command, arguments.settings, {"backend", "time-factor", "threads"});
  command.footer(
      "Distances are negative to the left of the curves, so inside a loop that runs "
      "counterclockwise.\n"
      "Examples:\n"
      "  geotherm signed bunny --through 495 --through 905 --through 1878 --closed -o signed.npy\n"
      "  geotherm signed bunny --curves isolines.csv --rule heat -o signed.svg");
}

Result<CommandOutput> run_signed(const SignedArguments& arguments, const Progress& progress) {
  const auto asked = settings_in(arguments.settings);
  if (!asked) return asked.error();
  const auto rule =
      arguments.rule.empty() ? Result<SideRule>(SideRule::kAuto) : parse<SideRule>(arguments.rule);
  if (!rule) return about("--rule", rule.error());
  if (arguments.through.empty() && arguments.curves.empty()) {
    return Error{
        ErrorCode::kBadInput, "there is no curve", {"give --through points, or --curves FILE.csv"}};
  }
  Outputs outputs;
  const auto expected = expect_columns(arguments.outputs, arguments.json, true, outputs);
  if (!expected) return expected.error();
  const auto model = load_model(arguments.model, asked->reading, progress);
  if (!model) return model.error();
  if (auto surface = refuse_space(*model, "signed distances are"); !surface) return surface.error();
  std::vector<Warning> warnings = model->notes;
  const auto curves = asked_curves(arguments, *model, warnings, part_of(progress, 0, 0.3));
  if (!curves) return curves.error();
  const Stopwatch watch;
  const SpreadOptions options{asked->options.backend, asked->options.time_step.factor,
                              asked->options.threads};
  const auto found =
      signed_distance(model->mesh, *curves, *rule, options, part_of(progress, 0.3, 1));
  if (!found) return about_model(model->name, found.error());
  const double ms = watch.milliseconds();
  warnings.insert(warnings.end(), found->warnings.begin(), found->warnings.end());
  note_unused_picture(arguments.settings, arguments.outputs, warnings);
  if (found->rule == SideRule::kSides) {
    std::vector<std::string> unused;
    for (const char* const name : {"backend", "time-factor"}) {
      if (arguments.settings.has(name)) unused.push_back(std::string("--") + name);
    }
    if (!unused.empty()) {
      warnings.push_back({"the rule sides does not use " + joined(unused) + ": it has no heat",
                          {"leave it out, or use ", SettingHint{"rule", {"heat"}}}});
    }
  }
  double least = 0, most = 0;
  Index reached = 0;
  for (const double d : found->distances) {
    if (!std::isfinite(d)) continue;
    ++reached;
    least = std::min(least, d);
    most = std::max(most, d);
  }
  note_unreached(*model->mesh, found->distances, "a curve", warnings);

  CommandOutput out{"", warnings, {}};
  for (const std::string& path : arguments.outputs) {
    const auto written =
        io::file_extension(path) == ".svg"
            ? write_levels(path, *model, *curves, *found, asked->picture, progress, outputs, out)
            : write_columns(path, *model->mesh, {{"distance", found->distances}}, outputs,
                            out.text);
    if (!written) return written.error();
  }
  const auto report = [&]() -> Json {
    double length = 0;
    for (const SurfacePath& curve : *curves) length += length_of(*model->mesh, curve.points);
    return {{"model", brief_model_json(*model)},
            {"rule", to_text(found->rule)},
            {"count", curves->size()},
            {"length", length},
            {"reached", reached},
            {"range", {least, most}},
            {"timing_ms", {{"load", model->load_ms}, {"solve", ms}}},
            {"warnings", to_text(warnings)}};
  };
  const auto table = [&] {
    TextTable rows({{"", TextTable::Align::kLeft}, {"", TextTable::Align::kLeft}});
    rows.add_row({"model", one_line(model->name) + ": " +
                               counted(model->mesh->vertex_count(), "vertex", "vertices")});
    rows.add_row({"curves", counted(static_cast<std::int64_t>(curves->size()), "curve", "curves") +
                                ", by " + to_text(found->rule)});
    rows.add_row({"distances", significant(least) + " to " + significant(most)});
    rows.add_row({"solve", milliseconds(ms) + " ms"});
    return rows.text();
  };
  return finish_command(std::move(out), outputs, arguments.json, report, table);
}

}  // namespace geotherm::app
