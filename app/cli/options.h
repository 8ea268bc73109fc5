// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/cli/cli_app.h"
#include "app/picture/picture_settings.h"
#include "app/session/check.h"
#include "app/session/outputs.h"
#include "app/session/report.h"
#include "app/session/settings.h"
#include "app/session/sources.h"
#include "geotherm/error.h"

// What options of several sub-commands are called and how they are read: the settings of the table,
// models and sources, checks, pictures.
namespace geotherm::app {

/// What most commands begin with where nothing is typed.
ViewerState usual_settings();

/// Settings as typed: texts by name.
struct SettingArguments {
  std::map<std::string, std::string, std::less<>> texts = {};
  ViewerState usual = usual_settings();  ///< what holds for those that are not typed

  bool has(std::string_view name) const { return texts.contains(name); }
};

/// The names of a group's settings, but for some.
std::vector<std::string_view> names_of(SettingGroup group,
                                       std::vector<std::string_view> without = {});

/// An option for each of these settings, under the heading of its group.
void add_setting_options(CLI::App& command, SettingArguments& arguments,
                         const std::vector<std::string_view>& names);

/// `usual` with what was typed. Errors: kBadInput or kNotAvailable, with the option's name and what
/// is expected.
Result<ViewerState> settings_in(const SettingArguments& arguments);

/// Says which of the typed settings of pictures have no effect, where no output is one.
void note_unused_picture(const SettingArguments& arguments, const std::vector<std::string>& outputs,
                         std::vector<Warning>& warnings);

/// Says which of the typed settings of methods have no effect beside the others.
void note_unused_settings(const SettingArguments& arguments, const MethodOptions& options,
                          std::vector<Warning>& warnings);

/// Where distance is 0, as typed.
struct SourceArguments {
  std::vector<std::string> sources;
  std::string file;
  bool curve = false;
};

/// Looks at a grid of one layer head-on, unless it was said from where to look or the model turns.
void face_head_on(const Model& model, const SettingArguments& typed, PictureSettings& picture);

/// The model as a word of its own, and how it is read.
CLI::Option* add_model_option(CLI::App& command, std::string& model, SettingArguments& settings);
void add_source_options(CLI::App& command, SourceArguments& arguments);
void add_quiet_option(CLI::App& command, bool& quiet);
/// --json; `what` is written there, for the help.
CLI::Option* add_json_option(CLI::App& command, std::string& json,
                             const std::string& what = "every figure");
/// --max-distance, and what it says. Errors: kBadInput.
void add_max_distance_option(CLI::App& command, std::string& text);
/// `what`: "the distances", for the help.
void add_target_option(CLI::App& command, std::vector<std::string>& texts, const std::string& what);
Result<double> max_distance_in(const std::string& text);

/// The sources of a command that cannot do without. Errors: those of sources_of(), kBadInput
/// (none).
Result<std::vector<Source>> some_sources_of(const SourceArguments& arguments);

/// All sources that were named; none is no error here. Errors: kBadInput, kBadFile.
Result<std::vector<Source>> sources_of(const SourceArguments& arguments);

/// How the sources were given, for the file of a picture.
std::vector<std::string> typed_sources(const SourceArguments& arguments);

/// One point that an option names. Errors: kBadInput.
Result<Source> single_point(const std::string& text, const std::string& option);

/// The whole number that an option is given, also as 2e6. `what`: "number of frames". Errors:
/// kBadInput, with the option's name and the range.
Result<Index> whole_in(const std::string& option, const std::string& text, const std::string& what,
                       Index least, Index most = std::numeric_limits<Index>::max());
/// The number that an option is given. Errors: kBadInput, with the option's name, and `hint`.
Result<double> real_in(const std::string& option, const std::string& text, const std::string& what,
                       const std::string& hint = {},
                       double least = std::numeric_limits<double>::lowest(),
                       double most = std::numeric_limits<double>::max());

/// The option may be given several times, each time with one value.
CLI::Option* may_repeat(CLI::Option* option, const std::string& value_name);

/// How distances are to be checked, as typed.
struct CheckArguments {
  bool check = false;
  bool no_check = false;
  std::string on_poor = geotherm::to_text(OnPoor::kKeep);
};

/// --no-check and --on-poor.
void add_check_options(CLI::App& command, CheckArguments& arguments);
void add_no_check_option(CLI::App& command, CheckArguments& arguments);

/// Errors: kBadInput (options that contradict each other, a word that is none).
Result<CheckSettings> check_settings(const CheckArguments& arguments);

/// Refuses distances that may turn into those of another method where the heat is needed. `what`:
/// the option that needs it, with its value. Errors: kBadInput.
Result<void> refuse_better(const CheckSettings& settings, const std::string& what);

/// How right the distances are, for standard error where it is nowhere on standard output; empty:
/// it is there, nobody wants it, or a warning says it. `json`: where the JSON goes; `line`:
/// accuracy_line().
std::string accuracy_note(const std::string& json, const Outputs& outputs, bool quiet,
                          const AccuracyReport& report, const Warning& line);
/// The same of what may have been checked, by itself or by a sample.
template <class Report>
std::string accuracy_note(const std::string& json, const Outputs& outputs, bool quiet,
                          const Report& error) {
  return error ? accuracy_note(json, outputs, quiet, *error, accuracy_line(*error)) : "";
}

/// Where the report of a command goes; empty: there is none. Errors: those of Outputs::expect().
Result<void> expect_report(const std::string& path, Outputs& outputs,
                           const std::string& option = "--json");
/// The same, and before it where all outputs go.
Result<void> expect_files(const std::vector<std::string>& paths, const std::string& json,
                          Outputs& outputs);

/// How a command ends: its report goes to `path`, unless that is empty, files take their places,
/// and the table is printed where no output goes to standard output. Errors: those of the files.
Result<CommandOutput> finish_command(CommandOutput out, Outputs& outputs, const std::string& path,
                                     const std::function<Json()>& report,
                                     const std::function<std::string()>& table);

/// What a picture needs beside the settings of the table, as typed.
struct PictureArguments {
  std::string turntable;  ///< empty: one picture
  std::string device;
};

void add_picture_options(CLI::App& command, SettingArguments& settings,
                         PictureArguments& arguments);

/// `--fit` may stand alone, and CLI11 would then take the next word for its value: a bare one
/// becomes `--fit=tight`.
void complete_bare_fit(std::vector<std::string>& words);

/// `asked`: settings_in() of what was typed, `typed`; `colour_maps`: the names there are, the
/// default first. Errors: kBadInput, with the option's name, the value and what is expected.
Result<PictureSettings> picture_settings(const ViewerState& asked, const SettingArguments& typed,
                                         const PictureArguments& arguments,
                                         std::span<const std::string> colour_maps);

/// Adds the options of pictures that a picture of lines (.svg) has, too.
void add_line_picture_options(CLI::App& command, SettingArguments& settings);

}  // namespace geotherm::app
