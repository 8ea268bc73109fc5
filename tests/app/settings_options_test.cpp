// SPDX-License-Identifier: MIT
// The table of settings: one entry is an option, its help, a command and a key of the JSON.
#include "app/cli/commands.h"
#include "app/cli/options.h"

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/cli/picture_report.h"
#include "app/session/command.h"
#include "app/session/model_solver.h"
#include "app/session/report.h"
#include "tests/support/shapes.h"

namespace geotherm::test {
namespace {

using app::add_setting_options;
using app::names_of;
using app::Setting;
using app::SettingArguments;
using app::SettingGroup;
using app::SettingKind;
using app::ViewerState;

/// What a command with all settings of methods makes of these words.
Result<ViewerState> typed(const std::vector<std::string>& words, SettingArguments& arguments) {
  CLI::App command;
  add_setting_options(command, arguments, names_of(SettingGroup::kMethod));
  std::vector<std::string> reversed(words.rbegin(), words.rend());
  command.parse(reversed);
  return app::settings_in(arguments);
}

TEST(SettingsOptions, OfASettingThatIsAddedToTheTableAreEverywhere) {
  static double dial;
  dial = 1;
  const app::ExtraSetting extra({.name = "test-dial",
                                 .kind = SettingKind::kNumber,
                                 .value_name = "D",
                                 .help = "for this test",
                                 .get = [](const ViewerState&) { return std::to_string(dial); },
                                 .set =
                                     [](ViewerState&, const std::string& text) {
                                       dial = std::stod(text);
                                       return Result<void>();
                                     }});
  CLI::App command;
  SettingArguments arguments;
  add_setting_options(command, arguments, names_of(SettingGroup::kMethod));
  EXPECT_NE(command.help().find("--test-dial D"), std::string::npos) << command.help();
  EXPECT_NE(command.help().find("for this test, default 1"), std::string::npos);

  ASSERT_TRUE(typed({"--test-dial", "7"}, arguments));
  EXPECT_EQ(dial, 7);
  const auto parsed = app::parse_command("test-dial 8");
  ASSERT_TRUE(parsed) << parsed.error().message;
  EXPECT_EQ(app::to_text(*parsed), "test-dial 8.000000");
  const auto unknown = app::parse_command("test-dia 8");
  EXPECT_NE(sentence(unknown.error()).find("test-dial?"), std::string::npos);

  dial = 2.5;
  app::Model model;
  model.name = "square";
  model.mesh = finish(plane_grid(3, 3, 1, 1));
  app::ModelSolver solver(model);
  const auto solved =
      solver.solve(app::usual_settings().options, {SourceSet::of_vertices({0}), {}}, {});
  ASSERT_TRUE(solved) << solved.error().message;
  EXPECT_EQ(app::solve_json(*solved)["options"]["test_dial"], 2.5);
}

TEST(SettingsOptions, OfAPictureStandInItsFileAndItsJson) {
  const app::ExtraSetting extra({.name = "test-glow",
                                 .group = SettingGroup::kPicture,
                                 .kind = SettingKind::kSwitch,
                                 .get = [](const ViewerState&) { return std::string("on"); }});
  app::PictureFigures figures;
  figures.model.mesh = finish(plane_grid(3, 3, 1, 1));
  const std::vector<app::FileText> texts = app::picture_texts(figures, 0);
  const auto glow = std::ranges::find(texts, "geotherm:test-glow", &app::FileText::keyword);
  ASSERT_NE(glow, texts.end());
  EXPECT_EQ(glow->text, "yes");
  EXPECT_EQ(app::picture_json(figures)["picture"]["test_glow"], true);
}

TEST(SettingsOptions, HelpNamesTheValuesAndTheDefault) {
  CLI::App command;
  SettingArguments arguments;
  add_setting_options(command, arguments, names_of(SettingGroup::kMethod));
  const std::string help = command.help();
  for (const char* part : {"-m,--time-factor M", "m of the time step, default 1",
                           "auto (default), cotan, intrinsic-delaunay", "--strict"}) {
    EXPECT_NE(help.find(part), std::string::npos) << part << help;
  }
  CLI::App viewer;  // which begins with other settings
  app::ViewArguments view;
  add_view_options(viewer, view);
  EXPECT_NE(viewer.help().find("sphere (default)"), std::string::npos);
  for (const char* name : {"time-step", "constraint"}) {  // their forms are written by hand
    const Setting& setting = *app::find_setting(name);
    for (const std::string& value : setting.values()) {
      const std::string what = value.substr(0, value.find(':'));
      EXPECT_NE(setting.forms.find(what), std::string::npos) << value;
      EXPECT_NE(setting.detail.find(what), std::string::npos) << value;
    }
  }
}

TEST(SettingsOptions, AreBlamedByTheirName) {
  SettingArguments arguments;
  const auto state = typed({"--heat", "lots"}, arguments);
  ASSERT_FALSE(state);
  EXPECT_EQ(state.error().message.find("--heat: "), 0U) << state.error().message;
}

TEST(SettingsOptions, OfAConstraintAdviseTheOneThatWasMeant) {
  SettingArguments arguments;
  EXPECT_EQ(sentence(typed({"--constraint", "pin-vertex:nan"}, arguments).error()),
            "--constraint: 'nan' is no number for the pinned vertex; write pin-vertex:V with a "
            "vertex id from 0, such as pin-vertex:17");
  SettingArguments others;
  EXPECT_NE(sentence(typed({"--constraint", "penalty:x"}, others).error()).find("penalty:1e6"),
            std::string::npos);
}

}  // namespace
}  // namespace geotherm::test
