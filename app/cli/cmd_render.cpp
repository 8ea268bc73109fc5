// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "app/cli/commands.h"
#include "app/cli/film.h"
#include "app/cli/picture_report.h"
#include "app/cli/render_work.h"
#include "app/cli/scene_output.h"
#include "app/cli/sequence_work.h"
#include "app/picture/picture_scale.h"
#include "app/picture/picture_settings.h"
#include "app/session/model_solver.h"
#include "app/session/outputs.h"
#include "app/session/progress.h"
#include "app/session/sources.h"
#include "app/session/wording.h"
#include "app/text/text.h"
#include "solver/core/text.h"

namespace geotherm::app {
namespace {

Result<void> check_output(const RenderArguments& arguments, const PictureSettings& settings) {
  const std::string& path = arguments.output;
  if (scene_format(path)) {
    if (settings.turntable == 0) return {};
    return Error{ErrorCode::kBadInput,
                 "--turntable: " + one_line(path) + " is turned by whoever looks at it",
                 {"leave it out, or give -o FILE.png"}};
  }
  if (path == "-" && settings.turntable > 0) {
    return Error{ErrorCode::kBadInput,
                 "--turntable: several pictures cannot go to standard output",
                 {"give -o FILE.png"}};
  }
  if (is_film(path) && settings.turntable == 0) {
    return Error{ErrorCode::kBadInput,
                 "--output: " + one_line(path) + ": one picture is no film",
                 {"add --turntable 72 or --sequence, or give -o FILE.png"}};
  }
  if (auto fits = check_film(arguments, settings); !fits) return fits;
  const std::string extension = io::file_extension(path);
  if (path == "-" || extension == ".png" || figure_format(path) || is_film(path)) return {};
  return Error{ErrorCode::kBadInput,
               "--output: " + one_line(path) + ": pictures are written as " +
                   ".png, .pdf or .svg, films as .mp4 and .gif, scenes as .html and "
                   ".glb, not '" +
                   one_line(extension) + "'",
               {"give -o FILE.png"}};
}

Result<void> expect_outputs(const RenderArguments& arguments, const PictureSettings& settings,
                            Outputs& outputs) {
  if (auto known = check_output(arguments, settings); !known) return known;
  return expect_files(picture_paths(arguments.output, settings), arguments.json, outputs);
}

Result<std::vector<Source>> sources_for(const RenderArguments& arguments, View view) {
  auto sources = sources_of(arguments.sources);
  if (!sources || !sources->empty() || !needs_sources(view) || !arguments.field.empty()) {
    return sources;
  }
  return Error{ErrorCode::kBadInput,
               "no source was given, which --view " + geotherm::to_text(view) + " needs",
               {"say where distance is 0, such as -s 17 or -s boundary, or choose ",
                SettingHint{"view", {"smooth"}}}};
}

/// Where paths are to lead. Errors: kBadInput, with what was typed.
Result<std::vector<Source>> targets_of(const std::vector<std::string>& texts) {
  std::vector<Source> targets;
  for (const std::string& text : texts) {
    auto target = single_point(text, "--path");
    if (!target) return target.error();
    targets.push_back(*std::move(target));
  }
  return targets;
}

/// With several models --grid 2x1 gives columns and rows, which are taken out of the settings; with
/// one model the option says what the values of a grid mean, and stays. Errors: kBadInput (rows
/// that do not hold the models).
Result<RenderArguments> with_grid_of_models(RenderArguments arguments) {
  const auto typed = arguments.settings.texts.find("grid");
  if (arguments.more_models.empty() || typed == arguments.settings.texts.end()) return arguments;
  const std::string text = typed->second;
  const std::size_t cross = std::min(text.find('x'), text.size());
  const auto columns = number_in<int>(text.substr(0, cross));
  const auto rows = number_in<int>(text.substr(std::min(cross + 1, text.size())));
  if (!columns || !rows) return arguments;
  const int models = 1 + static_cast<int>(arguments.more_models.size());
  if (!arguments.columns.empty()) {
    return Error{ErrorCode::kBadInput,
                 "--grid and --columns both say how models are placed",
                 {"leave one of them out"}};
  }
  if (*columns < 1 || *columns > models || (models + *columns - 1) / *columns != *rows) {
    const int most = std::clamp(*columns, 1, models);
    return Error{ErrorCode::kBadInput,
                 "--grid: '" + one_line(text) + "' is no grid of " + std::to_string(models) +
                     " models, columns before rows",
                 {"give " + std::to_string(most) + 'x' +
                  std::to_string((models + most - 1) / most) + ", or --columns N"}};
  }
  arguments.columns = std::to_string(*columns);
  arguments.settings.texts.erase(typed);
  return arguments;
}

}  // namespace

void add_render_options(CLI::App& command, RenderArguments& arguments) {
  add_model_option(command, arguments.model, arguments.settings)->required();
  command
      .add_option("MORE", arguments.more_models,
                  "further models in the same picture, side by side, solved in the same way and "
                  "with the same colours")
      ->type_name("");
  command
      .add_option("--columns", arguments.columns,
                  "columns of several models, default as many as suit the picture's shape; "
                  "--grid COLUMNSxROWS gives both")
      ->type_name("N");
  command
      .add_option(
          "-o,--output", arguments.output,
          "the picture: .png, or .pdf or .svg with lines and letters as shapes; - is standard "
          "output, as PNG; with --sequence a name with a place "
          "for the frame's number, such as frame_%04d.png; with --turntable or --sequence "
          "also a film, .mp4 or .gif (by ffmpeg); .html is a page that turns it, .glb a glTF "
          "scene")
      ->type_name("FILE")
      ->required();
  add_json_option(command, arguments.json);
  may_repeat(command.add_option(
                 "--path", arguments.targets,
                 "draws the path from the nearest source to this point (17, face:ID:b0:b1:b2, "
                 "xyz:x:y:z), as --path-kind says; may be repeated"),
             "POINT");
  command
      .add_option("--field", arguments.field,
                  "draws these values of vertices in place of distances, an array in .npy with one "
                  "axis; vectors (V x 3, or as transport writes them) as arrows; a log map as "
                  "logmap writes it as polar grid; no sources are needed")
      ->type_name("FILE");
  command.add_option("--fps", arguments.fps, "pictures a second of a film, 1 to 120, default 25")
      ->type_name("N");
  add_max_distance_option(command, arguments.max_distance);
  add_check_options(command, arguments.check);
  add_quiet_option(command, arguments.quiet);
  add_picture_options(command, arguments.settings, arguments.picture);
  add_sequence_options(command, arguments.sequence);
  add_source_options(command, arguments.sources);
  add_setting_options(command, arguments.settings, names_of(SettingGroup::kMethod));
  command.footer(
      "Examples:\n"
      "  geotherm render model.obj -s 17 --view contours -o out.png\n"
      "  geotherm render bunny -s 0 --path 1500 -o path.png\n"
      "  geotherm render gargoyle -s 17 -o figure.pdf\n"
      "  geotherm render bunny --view wireframe --size 1920x1080 -o bunny.png\n"
      "  geotherm render sleeve bunny -s 17 --title Shapes -o two.png\n"
      "  geotherm render bunny -s 17 --turntable 72 -o turn.mp4\n"
      "  geotherm render bunny --field values.npy --bar-label curvature -o field.png\n"
      "  geotherm transport bunny --vector 17:1:0 -o v.npy && geotherm render bunny --field v.npy "
      "-o arrows.png\n"
      "  geotherm render bunny -s 0 -o bunny.html\n"
      "  geotherm render terrain -s boundary --turntable 36 --background dark -o turn.png\n"
      "  geotherm render body.obj --sequence walk.pc2 -s 17 -o 'walk_%04d.png'");
}

Result<CommandOutput> run_render(const RenderArguments& typed, Drawing& drawing,
                                 const Progress& progress) {
  const auto placed = with_grid_of_models(typed);
  if (!placed) return placed.error();
  const RenderArguments& arguments = *placed;
  const std::vector<std::string> colour_maps = drawing.colour_maps();
  const auto asked = settings_in(arguments.settings);
  if (!asked) return asked.error();
  const auto settings =
      picture_settings(*asked, arguments.settings, arguments.picture, colour_maps);
  if (!settings) return settings.error();
  const MethodOptions& options = asked->options;
  if (auto fits = check_figure(*settings, options, arguments); !fits) return fits.error();
  if (needs_fields(settings->view) && options.method != MethodKind::kHeat) {
    return Error{ErrorCode::kBadInput,
                 "--view " + geotherm::to_text(settings->view) +
                     " shows the heat u, which --method " + to_text(options.method) + " has not",
                 {"use ", SettingHint{"method", {"heat"}}, " or another view"}};
  }
  if (auto fits = refuse_with_sequence(arguments.sequence, arguments.check); !fits) {
    return fits.error();
  }
  const auto check = check_settings(arguments.check);
  if (!check) return check.error();
  if (needs_fields(settings->view)) {
    if (auto fits = refuse_better(*check, "--view " + geotherm::to_text(settings->view)); !fits) {
      return fits.error();
    }
  }
  if (!arguments.columns.empty() && arguments.more_models.empty()) {
    return Error{
        ErrorCode::kBadInput, "--columns is for several models", {"name them, or leave it out"}};
  }
  for (const std::string& model : arguments.more_models) {
    std::error_code unknown;
    if (is_bundled(model) || std::filesystem::exists(model, unknown)) continue;
    return Error{ErrorCode::kBadInput, "'" + one_line(model) +
                                           "': there is no such file and no such bundled model "
                                           "(geotherm models) to draw beside " +
                                           one_line(arguments.model)};
  }
  if (!arguments.sequence.frames.empty()) {
    return run_render_sequence(arguments, {*asked, *settings, *check}, drawing, progress);
  }
  Outputs outputs;
  if (auto expected = expect_outputs(arguments, *settings, outputs); !expected) {
    return expected.error();
  }
  const auto sources = sources_for(arguments, settings->view);
  if (!sources) return sources.error();
  const auto targets = targets_of(arguments.targets);
  if (!targets) return targets.error();
  if (auto fits = check_field(arguments, settings->view, !sources->empty()); !fits) {
    return fits.error();
  }
  if (!targets->empty() && sources->empty()) {
    return Error{ErrorCode::kBadInput,
                 "--path: no source was given, so that no path leads there",
                 {"add -s"}};
  }
  const RenderPlaces places{*sources, *targets};
  const std::optional<SceneFormat> format = scene_format(arguments.output);
  auto device = format ? Result<DrawingDevice>(DrawingDevice()) : drawing.open(*settings);
  if (!device) return device.error();
  if (!arguments.more_models.empty()) {
    return run_render_models(arguments, {*asked, *settings, *check}, places, *std::move(device),
                             drawing, outputs, progress);
  }

  PictureFigures figures;
  figures.model_argument = arguments.model;
  figures.sources = typed_sources(arguments.sources);
  figures.settings = *settings;
  figures.device = *std::move(device);
  figures.paths = picture_paths(arguments.output, *settings);
  CommandOutput out;
  auto data = prepare_picture(arguments, *asked, places, *check, progress, figures, out.warnings);
  if (!data) return data.error();
  if (figures.solve) {
    note_unused_settings(arguments.settings, options, figures.solve->warnings);
    out.warnings = figures.solve->warnings;
  }
  if (format == SceneFormat::kGlb) figures.settings.bands = 0;  // nor have lines a place there
  figures.scale = picture_scale(*data, figures.settings);
  if (format == SceneFormat::kGlb) {
    figures.scale.spacing = 0;
    figures.scale.levels.clear();
  }
  data->caption = caption_of(figures);
  note_picture(arguments, figures, *data, drawing, out.warnings);
  if (outputs.uses_stdout() && figures.device.software && !arguments.quiet) {
    out.warnings.push_back({"drawing in software, on " + figures.device.name});
  }
  if (format) {
    note_what_has_no_place(arguments.settings, *format, settings->view, *data, out.warnings);
    auto written = write_scene(drawing, *format, *data, progress, outputs, figures);
    if (!written) return written.error();
  } else {
    FrameWriter writer(arguments, outputs, figures, progress, out.text);
    Result<void> drawn = drawing.draw(*data, figures.settings, writer.taker(), writer.as());
    if (drawn) drawn = writer.finish();
    if (!drawn) {
      outputs.remove_written();
      return drawn.error();
    }
  }
  if (figures.solve) {
    out.note = accuracy_note(arguments.json, outputs, arguments.quiet, figures.solve->error);
  }
  return finish_command(
      std::move(out), outputs, arguments.json, [&] { return picture_json(figures); },
      [&] { return picture_table(figures); });
}

}  // namespace geotherm::app
