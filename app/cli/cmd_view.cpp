// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>

#include <algorithm>
#include <utility>

#include "app/cli/commands.h"
#include "app/cli/picture_report.h"
#include "app/cli/render_work.h"
#include "app/cli/viewer_window.h"
#include "app/picture/figure.h"
#include "app/picture/picture_text.h"
#include "app/picture/png_file.h"
#include "app/session/command.h"
#include "app/session/compare.h"
#include "app/session/explored.h"
#include "app/session/machine.h"
#include "app/session/model.h"
#include "app/session/outputs.h"
#include "app/session/script.h"
#include "app/session/session.h"
#include "app/session/wording.h"
#include "app/text/text.h"
#include "solver/core/text.h"
#include "solver/mesh/io/input_file.h"

namespace geotherm::app {
namespace {

Result<double> scale_in(const std::string& text) {
  if (text.empty()) return 0.0;
  return real_in("--scale", text, "scale of panels", "give 0.5 to 4, such as 2", 0.5, 4);
}

Result<std::vector<SourceSpec>> sources_in(const SourceArguments& arguments) {
  const auto sources = sources_of(arguments);
  if (!sources) return sources.error();
  std::vector<SourceSpec> specs;
  for (const Source& source : *sources) {
    specs.push_back(source.spec);
    // A session keeps the curve, not the file that it came from.
    if (auto* const curve = std::get_if<VertexCurve>(&specs.back())) curve->lines.clear();
  }
  return specs;
}

bool is_headless(const ViewArguments& a) {
  return a.headless || !a.replay.empty() || !a.output.empty();
}

/// A session opens a model with all that belongs to it.
Result<void> check_beside_session(const ViewArguments& a) {
  if (!a.script.empty() || !a.replay.empty()) {
    return Error{ErrorCode::kBadInput,
                 one_line(a.model) + ": a session, beside --script or --replay",
                 {"give one of them"}};
  }
  const auto asked = settings_in(a.settings);
  if (!asked) return asked.error();
  const bool of_model = !a.sources.sources.empty() || !a.sources.file.empty() ||
                        !a.sequence.empty() || !a.field.empty() || !a.max_distance.empty() ||
                        asked->reading != initial_state().reading;
  if (!of_model) return {};
  return Error{ErrorCode::kBadInput,
               one_line(a.model) +
                   ": a session opens a model with sources of its own, and options "
                   "of a model were given as well",
               {"leave them out, or name the model"}};
}

Result<void> check(const ViewArguments& a) {
  if (!a.picture.turntable.empty()) {
    return Error{ErrorCode::kBadInput,
                 "--turntable: the viewer turns the model live (key p)",
                 {"use geotherm render"}};
  }
  if (!a.replay.empty() && !a.script.empty()) {
    return Error{ErrorCode::kBadInput,
                 "--script and --replay: give one of them",
                 {"--replay writes no files of its own"}};
  }
  if (is_session(a.model)) {
    if (auto alone = check_beside_session(a); !alone) return alone;
  }
  if (a.model == kStandardInput) {
    return Error{ErrorCode::kBadInput,
                 "the viewer reads a model again when its settings change, which standard input "
                 "cannot be",
                 {"write it to a file and name that"}};
  }
  if (is_headless(a) && a.model.empty() && a.script.empty() && a.replay.empty()) {
    return Error{ErrorCode::kBadInput,
                 "there is nothing to do without a window",
                 {"name a model, or commands with --script FILE or --replay FILE"}};
  }
  if (!a.output.empty() && io::file_extension(a.output) != ".png" && !figure_format(a.output)) {
    return Error{ErrorCode::kBadInput,
                 "--output: " + one_line(a.output) + ": pictures are written as .png, .pdf or .svg",
                 {"give -o FILE.png"}};
  }
  return {};
}

/// What a session without a window has to say: all but the commands themselves.
void collect(const Session& session, CommandOutput& out) {
  for (const LogLine& line : session.log()) {
    if (line.kind == LogLine::Kind::kNote)
      out.text += to_text(Warning{line.text, line.hint}) + '\n';
    if (line.kind == LogLine::Kind::kWarning) out.warnings.push_back({line.text, line.hint});
  }
  if (!session.compare().rows.empty()) {
    out.text += compare_table(this_machine(), session.compare().rows);
  }
}

Result<CommandOutput> run_headless(const ViewArguments& arguments,
                                   const std::vector<Command>& commands, Drawing& drawing,
                                   const Progress& progress) {
  Outputs outputs;
  if (!arguments.output.empty()) {
    if (auto expected = outputs.expect(arguments.output, "--output"); !expected) {
      return expected.error();
    }
    PictureSettings settings;
    settings.device = arguments.picture.device;
    if (auto device = drawing.open(settings); !device) return device.error();
  }
  DrawingDevice device;
  ViewPainter painter;
  painter.device = [&device] { return device; };
  painter.draw = [&](const PictureData& data, const PictureSettings& settings, bool panels,
                     DrawAs as) -> Result<DrawnPicture> {
    if (panels) {
      return Error{
          ErrorCode::kBadInput, "there are no panels without a window", {"leave out 'panels'"}};
    }
    PictureSettings mine = settings;
    mine.device = arguments.picture.device;
    auto opened = drawing.open(mine);
    if (!opened) return opened.error();
    device = *std::move(opened);
    DrawnPicture out;
    const auto keep = [&out](int, const DrawnPicture& picture) {
      out = picture;
      return Result<void>();
    };
    const auto drawn = drawing.draw(data, mine, keep, as);
    if (!drawn) return drawn.error();
    return out;
  };
  const auto save = [&painter](const command::SavePicture& wish, const Session& session) {
    return save_view_picture(wish, session, painter);
  };
  SessionHooks hooks;
  hooks.colour_maps = drawing.colour_maps();
  hooks.save_picture = save;
  hooks.progress = progress;
  hooks.writes_files = arguments.replay.empty();
  Session session(std::move(hooks));
  std::vector<Command> all = commands;
  const std::string& script = arguments.replay.empty() ? arguments.script : arguments.replay;
  if (!script.empty()) all.emplace_back(command::Run{script});
  if (auto done = session.submit_all(all); !done) return done.error();
  if (!script.empty() && arguments.settings.has("size")) {  // not the size of whoever wrote it
    const PictureSettings wish = settings_in(arguments.settings)->picture;
    if (auto done = session.submit(command::Set{"size", size_text(wish)}); !done) {
      return done.error();
    }
  }
  CommandOutput out;
  if (!arguments.output.empty()) {
    if (auto saved = save({arguments.output}, session); !saved) return saved.error();
  }
  collect(session, out);
  if (!arguments.output.empty()) {
    out.text += "picture " + one_line(arguments.output) + ": " +
                std::to_string(session.state().picture.width) + " x " +
                std::to_string(session.state().picture.height) + " pixels, drawn by " +
                one_line(device.name) + (device.software ? ", in software" : "") + '\n';
  }
  return out;
}

}  // namespace

void add_view_options(CLI::App& command, ViewArguments& arguments) {
  add_model_option(command, arguments.model, arguments.settings)
      ->description("a file or a pipe (" + model_extensions_text() +
                    "), a bundled model (geotherm models), or a session (.geotherm)");
  command.add_option("--script", arguments.script, "commands to run (docs/commands.md)")
      ->type_name("FILE");
  command
      .add_option("--replay", arguments.replay,
                  "commands to run without a window and without writing files, such as the log of "
                  "a window")
      ->type_name("FILE");
  command
      .add_option("-o,--output", arguments.output,
                  "a picture of what is shown in the end, .png, .pdf or .svg; no window is "
                  "opened")
      ->type_name("FILE");
  command.add_flag("--headless", arguments.headless, "no window: run the commands and end");
  command.add_option("--scale", arguments.scale, "of letters and panels, default the monitor's")
      ->type_name("FACTOR");
  command.add_flag("--validation", arguments.validation,
                   "what Vulkan's validation layer reports is an error");
  add_sequence_option(command, arguments.sequence);
  command
      .add_option("--field", arguments.field,
                  "values, vectors or a log map of the vertices (.npy) in place of distances")
      ->type_name("FILE");
  add_max_distance_option(command, arguments.max_distance);
  add_quiet_option(command, arguments.quiet);
  add_picture_options(command, arguments.settings, arguments.picture);
  add_source_options(command, arguments.sources);
  add_setting_options(command, arguments.settings, names_of(SettingGroup::kMethod));
  command.footer(
      "Examples:\n"
      "  geotherm model.obj\n"
      "  geotherm view bunny -s 17 --view heat-gradient\n"
      "  geotherm view body.obj --sequence walk.pc2\n"
      "  geotherm view session.geotherm\n"
      "  geotherm view session.geotherm -o out.png");
}

Result<std::vector<Command>> commands_of(const ViewArguments& arguments,
                                         std::span<const std::string> colour_maps) {
  const auto asked = settings_in(arguments.settings);
  if (!asked) return asked.error();
  const auto picture = picture_settings(*asked, arguments.settings, arguments.picture, colour_maps);
  if (!picture) return picture.error();
  const auto sources = sources_in(arguments.sources);
  if (!sources) return sources.error();
  ViewerState state = initial_state();
  state.options = asked->options;
  state.reading = asked->reading;
  state.picture = *picture;
  state.picture.device.clear();
  // A window is turned, and is no picture whose fit follows from what it is.
  state.picture.camera.fit = asked->picture.camera.fit;
  if (!arguments.model.empty()) {
    // Opening resets what belongs to a model, so it comes first.
    const auto opened = app::apply(initial_state(), command::Open{arguments.model});
    if (!opened) return opened.error();
    state.model = opened->model;
    state.sources = opened->sources;
  }
  if (!sources->empty()) state.sources = *sources;
  const auto most = max_distance_in(arguments.max_distance);
  if (!most) return most.error();
  if (!arguments.field.empty() && arguments.model.empty()) {
    return Error{ErrorCode::kBadInput, "--field: there is no model whose vertices have values"};
  }
  state.timeline.sequence = arguments.sequence;
  state.field = arguments.field;
  state.max_distance = *most;
  std::vector<Command> commands = commands_to(state);
  // A grid of one layer would be turned head-on from the usual view that was asked for.
  for (const char* name : {"azimuth", "elevation"}) {
    if (!is_seen_as_usual(picture->camera) || !arguments.settings.has(name)) continue;
    commands.emplace_back(command::Set{name, find_setting(name)->get(state)});
  }
  return commands;
}

Result<CommandOutput> run_view(const ViewArguments& given, Drawing& drawing, ViewerWindow& window,
                               const Progress& progress) {
  if (auto checked = check(given); !checked) return checked.error();
  ViewArguments arguments = given;
  std::string session;  // in the model's place
  if (is_session(given.model)) {
    (is_headless(given) ? arguments.replay : session) = std::exchange(arguments.model, {});
  }
  const std::vector<std::string> colour_maps = drawing.colour_maps();
  auto commands = commands_of(arguments, colour_maps);
  if (!commands) return commands.error();
  const auto scale = scale_in(arguments.scale);
  if (!scale) return scale.error();
  if (is_headless(arguments)) return run_headless(arguments, *commands, drawing, progress);

  // A window that opens to say that there is no such file helps nobody.
  if (std::error_code unknown; !session.empty() && !std::filesystem::is_fifo(session, unknown)) {
    if (const auto script = read_script(session); !script) return script.error();
  }
  if (is_bundled(arguments.model)) {
    if (const auto file = bundled_file(arguments.model); !file) return file.error();
  } else if (std::error_code unknown;
             !arguments.model.empty() && !std::filesystem::is_fifo(arguments.model, unknown)) {
    if (const auto file = io::InputFile::open_as_is(arguments.model); !file) return file.error();
  }
  ViewerStart start;
  start.commands = *std::move(commands);
  start.script = arguments.script;
  start.session = session;
  start.device = arguments.picture.device;
  start.scale = *scale;
  start.validation = arguments.validation;
  if (arguments.settings.has("size")) {
    const PictureSettings picture = settings_in(arguments.settings)->picture;
    start.width = picture.width;
    start.height = picture.height;
  }
  if (auto done = window.run(start); !done) return done.error();
  return CommandOutput{};
}

namespace {

PictureFigures figures_of(const Session& session, const PictureSettings& settings) {
  const Explored& explored = session.explored();
  const ViewerState& state = session.state();
  PictureFigures figures;
  figures.model = explored.model->model;
  figures.model_argument = state.model;
  for (const SourceSpec& source : explored.sources) figures.sources.push_back(to_text(source));
  figures.settings = settings;
  if (const Answer* answer = shown_answer(explored, state.shown)) {
    figures.solve = *answer;
  }
  return figures;
}

}  // namespace

Result<void> save_view_picture(const command::SavePicture& save, const Session& session,
                               const ViewPainter& painter) {
  const Explored& explored = session.explored();
  const ViewerState& state = session.state();
  if (!explored.model) return Error{ErrorCode::kBadInput, "no model is open to draw"};
  PictureSettings settings = state.picture;
  if (save.size) {
    if (auto fits = set_size(settings, *save.size); !fits) return fits;
  } else if (painter.width > 0) {
    settings.width = painter.width;
    settings.height = painter.height;
    settings.paper = std::nullopt;
    if (!settings.text_size) settings.text_size = painter.text_size;
  }
  Outputs outputs = outputs_beside(state);
  if (auto expected = outputs.expect(save.path, "save picture"); !expected) return expected;

  const std::optional<FigureFormat> format = figure_format(save.path);
  if (format && save.panels) {
    return Error{ErrorCode::kBadInput, "panels are pixels, and " + one_line(save.path) +
                                           " holds shapes; name a FILE.png, or leave out 'panels'"};
  }
  const PictureData data = picture_of(explored, state.shown, settings.view);
  const auto picture =
      painter.draw(data, settings, save.panels, format ? DrawAs::kFigure : DrawAs::kPixels);
  if (!picture) return picture.error();
  PictureFigures figures = figures_of(session, settings);
  figures.scale = picture_scale(data, settings);
  figures.device = painter.device();
  figures.paths = {save.path};
  std::vector<FileText> texts = picture_texts(figures, 0);
  std::ranges::find(texts, "Description", &FileText::keyword)->text = data.caption;
  const std::optional<int> dpi = said_dpi(figures.settings);
  auto bytes =
      format ? figure_bytes(*picture, *format, texts, dpi) : png_bytes(*picture, texts, dpi);
  if (!bytes) return bytes.error();
  std::string unused;
  return outputs.write_text(save.path, *std::move(bytes), unused);
}

}  // namespace geotherm::app
