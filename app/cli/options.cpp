// SPDX-License-Identifier: MIT
#include "app/cli/options.h"

#include <CLI/CLI.hpp>

#include <algorithm>

#include "app/picture/picture_text.h"
#include "app/session/model.h"
#include "app/session/state.h"
#include "app/session/wording.h"
#include "app/text/text.h"
#include "solver/core/text.h"

namespace geotherm::app {

CLI::Option* add_model_option(CLI::App& command, std::string& model, SettingArguments& settings) {
  add_setting_options(command, settings, names_of(SettingGroup::kModel));
  return command
      .add_option("MODEL", model,
                  "a file or a pipe (" + model_extensions_text() +
                      "), a bundled model (geotherm models), or - for standard input")
      ->type_name("");
}

void add_quiet_option(CLI::App& command, bool& quiet) {
  command.add_flag("--quiet", quiet, "no progress bar, no estimate of time");
}

CLI::Option* add_json_option(CLI::App& command, std::string& json, const std::string& what) {
  return command.add_option("--json", json, what + " as JSON; - is standard output")
      ->type_name("FILE");
}

Result<Index> whole_in(const std::string& option, const std::string& text, const std::string& what,
                       Index least, Index most) {
  const auto number = count_in(text);
  if (number && *number >= least && *number <= most) return static_cast<Index>(*number);
  const std::string from = std::to_string(least);
  const bool endless = most == std::numeric_limits<Index>::max();
  const std::string range =
      endless ? "a whole number from " + from : from + " to " + std::to_string(most);
  return about(option, bad_value(text, "is no " + what, "give " + range));
}

Result<double> real_in(const std::string& option, const std::string& text, const std::string& what,
                       const std::string& hint, double least, double most) {
  const auto number = number_in<double>(text);
  if (number && *number >= least && *number <= most) return *number;
  return about(option, bad_value(text, "is no " + what, hint));
}

namespace {

const char* heading_of(SettingGroup group) {
  switch (group) {
    case SettingGroup::kModel:
      return "Model";
    case SettingGroup::kMethod:
      return "Method";
    case SettingGroup::kCheck:
      return "Accuracy";
    case SettingGroup::kPicture:
      return "Picture";
    case SettingGroup::kFigure:
      return "Figure";
    case SettingGroup::kCamera:
      return "Camera";
  }
  return "";
}

std::string spelling_of(const Setting& setting) {
  if (!setting.option.empty()) return std::string(setting.option);
  return "--" + std::string(setting.name);
}

/// The phrase, the values there are, and what holds where the option is left out.
std::string help_of(const Setting& setting, const ViewerState& state) {
  const std::string help(setting.help);
  if (!setting.bare.empty()) return setting.bare == "off" ? "without " + help : help;
  if (!setting.forms.empty()) return help + ": " + std::string(setting.forms);
  const std::string usual = setting.get(state);
  if (setting.values == nullptr) return help + ", default " + usual;
  std::vector<std::string> values = setting.values();
  for (std::string& value : values) {
    if (value == usual) value += " (default)";
  }
  return help + ": " + joined(values);
}

}  // namespace

std::vector<std::string_view> names_of(SettingGroup group, std::vector<std::string_view> without) {
  std::vector<std::string_view> names;
  for (const Setting& setting : settings()) {
    if (setting.group != group || std::ranges::count(without, setting.name) > 0) continue;
    names.push_back(setting.name);
  }
  return names;
}

void add_setting_options(CLI::App& command, SettingArguments& arguments,
                         const std::vector<std::string_view>& names) {
  const ViewerState& usual = arguments.usual;
  for (const std::string_view name : names) {
    const Setting& setting = *find_setting(name);
    const auto take = [&arguments, name](const std::string& text) {
      arguments.texts[std::string(name)] = text;
    };
    CLI::Option* const option =
        setting.bare.empty()
            ? command
                  .add_option_function<std::string>(spelling_of(setting), take,
                                                    help_of(setting, usual))
                  ->type_name(std::string(setting.value_name))
            : command.add_flag_callback(
                  spelling_of(setting), [take, bare = std::string(setting.bare)] { take(bare); },
                  help_of(setting, usual));
    option->group(heading_of(setting.group));
  }
}

ViewerState usual_settings() {
  ViewerState state = initial_state();
  state.picture = {};
  return state;
}

Result<ViewerState> settings_in(const SettingArguments& arguments) {
  ViewerState state = arguments.usual;
  for (const Setting& setting : settings()) {
    const auto typed = arguments.texts.find(setting.name);
    if (typed == arguments.texts.end()) continue;
    const auto set = setting.set(state, typed->second);
    if (!set) {
      return about("--" + std::string(setting.name), set.error());
    }
  }
  return state;
}

void note_unused_picture(const SettingArguments& arguments, const std::vector<std::string>& outputs,
                         std::vector<Warning>& warnings) {
  const auto is_svg = [](const std::string& path) { return io::file_extension(path) == ".svg"; };
  if (std::ranges::any_of(outputs, is_svg)) return;
  std::vector<std::string> unused;
  for (const Setting& setting : settings()) {
    if (setting.of_picture() && arguments.has(setting.name)) unused.push_back(spelling_of(setting));
  }
  if (unused.empty()) return;
  warnings.push_back(
      {joined(unused) + (unused.size() == 1 ? " is" : " are") + " not used: no output is a picture",
       {"add -o FILE.svg"}});
}

void note_unused_settings(const SettingArguments& arguments, const MethodOptions& options,
                          std::vector<Warning>& warnings) {
  if (options.method != MethodKind::kHeat) {
    std::vector<std::string> unused;
    for (const Setting& setting : settings()) {
      const auto typed = arguments.texts.find(setting.name);
      if (!setting.of_heat || typed == arguments.texts.end()) continue;
      if (typed->second != setting.get(arguments.usual))
        unused.push_back("--" + std::string(setting.name));
    }
    if (unused.empty()) return;
    warnings.push_back({"the method " + to_text(options.method) + " does not use " + joined(unused),
                        {unused.size() == 1 ? "it is an option of " : "these are options of ",
                         SettingHint{"method", {"heat"}}}});
    return;
  }
  const auto factor = arguments.texts.find("time-factor");
  if (options.time_step.rule != TimeRule::kAbsolute || factor == arguments.texts.end()) return;
  warnings.push_back({"--time-factor " + factor->second + " is not used: --time-step " +
                          arguments.texts.find("time-step")->second + " is the time itself",
                      {"leave one of them out"}});
}

void add_check_options(CLI::App& command, CheckArguments& arguments) {
  add_no_check_option(command, arguments);
  command
      .add_option("--on-poor", arguments.on_poor,
                  "what becomes of poor distances: keep (default: a warning), better (the first of "
                  "wavefront, wavefront-fine, exact that is right answers instead), fail (exit "
                  "code 1, nothing is written)")
      ->type_name("WHAT")
      ->group("Accuracy");
}

void add_no_check_option(CLI::App& command, CheckArguments& arguments) {
  command
      .add_flag("--no-check", arguments.no_check,
                "heat distances are not held against near-exact ones, which is done otherwise")
      ->group("Accuracy");
}

Result<CheckSettings> check_settings(const CheckArguments& arguments) {
  CheckSettings settings;
  if (auto known = store(parse<OnPoor>(arguments.on_poor), settings.on_poor); !known) {
    return about("--on-poor", known.error());
  }
  if (arguments.no_check && arguments.check) {
    return Error{
        ErrorCode::kBadInput, "--check and --no-check were both given", {"leave one of them out"}};
  }
  if (arguments.no_check && settings.on_poor != OnPoor::kKeep) {
    return Error{ErrorCode::kBadInput,
                 "--on-poor " + arguments.on_poor + " needs the check",
                 {"leave --no-check out"}};
  }
  if (arguments.check) settings.against = Check::kAuto;
  if (arguments.no_check) settings.against = Check::kOff;
  return settings;
}

Result<void> refuse_better(const CheckSettings& settings, const std::string& what) {
  if (settings.on_poor != OnPoor::kBetter) return {};
  return Error{
      ErrorCode::kBadInput,
      "--on-poor better may answer by another method, and " + what + " is about the heat u",
      {"leave one of them out"}};
}

std::string accuracy_note(const std::string& json, const Outputs& outputs, bool quiet,
                          const AccuracyReport& report, const Warning& line) {
  if (quiet || !outputs.uses_stdout() || json == "-") return {};
  if (!report.measured || report.is_poor()) return {};
  return "accuracy: " + to_text(line);
}

Result<void> expect_report(const std::string& path, Outputs& outputs, const std::string& option) {
  return path.empty() ? Result<void>() : outputs.expect(path, option);
}

Result<void> expect_files(const std::vector<std::string>& paths, const std::string& json,
                          Outputs& outputs) {
  for (const std::string& path : paths) {
    if (auto expected = outputs.expect(path, "--output"); !expected) return expected;
  }
  return expect_report(json, outputs);
}

Result<CommandOutput> finish_command(CommandOutput out, Outputs& outputs, const std::string& path,
                                     const std::function<Json()>& report,
                                     const std::function<std::string()>& table) {
  if (!path.empty()) {
    auto written = outputs.write_text(path, report_text(report()), out.text);
    if (!written) return written.error();
  }
  if (auto replaced = outputs.replace_all(); !replaced) return replaced.error();
  if (!outputs.uses_stdout()) out.text = table();
  out.made = outputs.made();
  return out;
}

namespace {

constexpr int kMaxFrames = 3600;

Result<void> choose_colour_map(bool typed, std::span<const std::string> colour_maps,
                               std::string& chosen) {
  if (!typed && !colour_maps.empty()) chosen = colour_maps.front();
  if (std::ranges::count(colour_maps, chosen) > 0) return {};
  return Error{ErrorCode::kBadInput,
               "--colour-map: there is no colour map '" + one_line(chosen) + "'",
               {known_words(chosen, {colour_maps.begin(), colour_maps.end()})}};
}

/// A logarithmic scale has no 0.
Result<void> check_colour_scale(const PictureSettings& picture) {
  if (picture.colour_scale != ColourScale::kLog) return {};
  for (const std::optional<double>& end : {picture.range_min, picture.range_max}) {
    if (!end || *end > 0) continue;
    return Error{
        ErrorCode::kBadInput,
        "--colour-scale log: --range " + range_text(picture) + " has an end that is not above 0",
        {"give ends above 0, such as 0.01:1, or leave them out"}};
  }
  return {};
}

/// Chooses the fit when the user did not: a sphere where the model turns or its centre is given.
Result<void> choose_fit(bool typed, const PictureSettings& picture, CameraSettings& camera) {
  if (!typed) {
    const bool sphere = picture.turntable > 0 || camera.centre;
    camera.fit = sphere ? PictureFit::kSphere : PictureFit::kTight;
  }
  if (!camera.centre || camera.fit != PictureFit::kTight) return {};
  return Error{ErrorCode::kBadInput,
               "--centre: a tight fit decides itself what is in the middle",
               {"give ", SettingHint{"fit", {"sphere"}}}};
}

}  // namespace

void add_picture_options(CLI::App& command, SettingArguments& settings, PictureArguments& a) {
  add_setting_options(command, settings, names_of(SettingGroup::kPicture));
  command.add_option("--device", a.device, "part of a device's name (geotherm devices)")
      ->type_name("NAME")
      ->group("Picture");
  add_setting_options(command, settings, names_of(SettingGroup::kFigure));
  add_setting_options(command, settings, names_of(SettingGroup::kCamera));
  command
      .add_option("--turntable", a.turntable,
                  "N pictures of one turn, numbered from 000 before the extension")
      ->type_name("N")
      ->group("Camera");
}

void add_line_picture_options(CLI::App& command, SettingArguments& settings) {
  add_setting_options(command, settings,
                      {"title", "text-size", "line-width", "dpi", "size", "background", "azimuth",
                       "elevation", "roll", "up", "zoom", "pan", "projection"});
}

void complete_bare_fit(std::vector<std::string>& words) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] != "--fit") continue;
    if (i + 1 == words.size() || !parse<PictureFit>(words[i + 1])) words[i] = "--fit=tight";
  }
}

void face_head_on(const Model& model, const SettingArguments& typed, PictureSettings& picture) {
  UpAxis& up = picture.camera.up;
  const bool says_up = up != UpAxis::kAuto;
  if (!says_up) up = model.up;
  const auto angles = head_on(model);
  if (!angles || says_up || picture.turntable > 0 || typed.has("azimuth") || typed.has("elevation"))
    return;
  picture.camera.azimuth = (*angles)[0];
  picture.camera.elevation = (*angles)[1];
}

Result<PictureSettings> picture_settings(const ViewerState& asked, const SettingArguments& typed,
                                         const PictureArguments& a,
                                         std::span<const std::string> colour_maps) {
  PictureSettings picture = asked.picture;
  const bool typed_map = typed.has("colour-map");
  if (auto map = choose_colour_map(typed_map, colour_maps, picture.colour_map); !map) {
    return map.error();
  }
  if (!a.turntable.empty()) {
    const auto frames = whole_in("--turntable", a.turntable, "number of pictures", 1, kMaxFrames);
    if (!frames) return frames.error();
    picture.turntable = *frames;
  }
  if (auto fits = check_colour_scale(picture); !fits) return fits.error();
  if (auto fit = choose_fit(typed.has("fit"), picture, picture.camera); !fit) return fit.error();
  picture.device = a.device;
  return picture;
}

}  // namespace geotherm::app
