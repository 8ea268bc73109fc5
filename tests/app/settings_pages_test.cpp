// SPDX-License-Identifier: MIT
// Pages that list settings hold the table of settings. GEOTHERM_UPDATE_PAGES=1 writes their tables.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/cli/picture_report.h"
#include "app/session/command.h"
#include "app/session/model_solver.h"
#include "app/session/report.h"
#include "app/session/settings.h"
#include "tests/support/shapes.h"

namespace geotherm::test {
namespace {

using app::Json;
using app::Setting;
using app::SettingGroup;
using app::SettingKind;
using app::ViewerState;

const std::string kCommands = GEOTHERM_DOCS "/commands.md";

std::string content(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// A row of the page: the command, what it does, its values, and what holds at first.
std::string row(const Setting& setting) {
  const std::string name(setting.name), usual = setting.get(app::initial_state());
  std::string values;
  const bool of_build = name == "backend" || name == "format";  // others in another build
  if (setting.kind == SettingKind::kSwitch) {
    values = "`on`, `off`";
  } else if (!setting.forms.empty() || setting.values == nullptr || of_build) {
    values = setting.forms.empty() ? std::string(setting.value_name) : std::string(setting.forms);
  } else {
    for (const std::string& value : setting.values()) {
      values += (values.empty() ? "`" : ", `") + value + "`";
    }
  }
  return "| `" + name + "` | " + std::string(setting.help) + " | " + values + " | `" + usual +
         "` |\n";
}

std::string table(const std::vector<SettingGroup>& groups) {
  std::string text = "| command | is | values | at first |\n| --- | --- | --- | --- |\n";
  for (const Setting& setting : app::settings()) {
    if (std::ranges::count(groups, setting.group) > 0) text += row(setting);
  }
  return text;
}

/// The page with its tables as the table of settings has them. Precondition: it has the marks.
std::string with_tables(std::string page) {
  using enum SettingGroup;
  const std::pair<std::string, std::vector<SettingGroup>> parts[] = {
      {"methods", {kMethod, kModel}}, {"pictures", {kPicture, kFigure, kCamera}}};
  for (const auto& [name, groups] : parts) {
    const std::string begin = "<!-- settings of " + name + " -->\n", end = "<!-- end -->\n";
    const std::size_t from = page.find(begin) + begin.size();
    page.replace(from, page.find(end, from) - from, table(groups));
  }
  return page;
}

TEST(SettingsPages, OfCommandsHaveWhatTheTableHas) {
  const std::string page = content(kCommands);
  for (const char* mark : {"<!-- settings of methods -->\n", "<!-- settings of pictures -->\n"}) {
    const std::size_t from = page.find(mark);
    ASSERT_TRUE(from != page.npos && page.find("<!-- end -->\n", from) != page.npos) << mark;
  }
  const std::string right = with_tables(page);
  if (std::getenv("GEOTHERM_UPDATE_PAGES") != nullptr) std::ofstream(kCommands) << right;
  EXPECT_TRUE(page == right) << kCommands
                             << " is not what the table of settings says; GEOTHERM_UPDATE_PAGES=1 "
                                "writes it";

  const app::ExtraSetting extra({.name = "test-dial",
                                 .help = "for this test",
                                 .get = [](const ViewerState&) { return std::string("1"); }});
  EXPECT_NE(with_tables(page).find("| `test-dial` | for this test |"), std::string::npos);
}

/// Options of the table that the page does not name.
std::vector<std::string> missing_in(const std::string& page, bool of_picture) {
  std::vector<std::string> missing;
  for (const Setting& setting : app::settings()) {
    if (setting.of_picture() != of_picture) continue;
    const std::string option =
        setting.bare == "off" ? std::string(setting.option) : "--" + std::string(setting.name);
    if (page.find(option) == std::string::npos) missing.push_back(option);
  }
  return missing;
}

TEST(SettingsPages, OfTheCommandLineNameEachOption) {
  const std::string methods = content(GEOTHERM_DOCS "/command_line.md");
  const std::string pictures = content(GEOTHERM_DOCS "/rendering.md");
  EXPECT_EQ(missing_in(methods, false), std::vector<std::string>());
  EXPECT_EQ(missing_in(pictures, true), std::vector<std::string>());
  const app::ExtraSetting extra({.name = "test-dial"});
  EXPECT_EQ(missing_in(methods, false), std::vector<std::string>{"--test-dial"});
}

TEST(SettingsPages, OfReportsKnowTheKeysOfAllSettings) {
  const Json schema = Json::parse(content(GEOTHERM_DOCS "/reports.schema.json"))["properties"];
  // Keys that the schema does not know, and required ones that the report lacks.
  const auto differences = [](const Json& report, const Json& of) {
    std::vector<std::string> keys;
    for (const auto& [key, value] : report.items()) {
      if (!of["properties"].contains(key)) keys.push_back(key);
    }
    for (const Json& key : of["required"]) {
      if (!report.contains(std::string(key))) keys.push_back("no " + std::string(key));
    }
    return keys;
  };
  app::Model model;
  model.name = "square";
  model.mesh = finish(plane_grid(3, 3, 1, 1));
  app::ModelSolver solver(model);
  app::PictureFigures figures;
  figures.model = model;
  const auto options = [&] {
    const auto solved = solver.solve({}, {SourceSet::of_vertices({0}), {}}, {});
    return solved ? app::solve_json(*solved)["options"] : Json();
  };
  const auto picture = [&] { return app::picture_json(figures)["picture"]; };
  const auto none = std::vector<std::string>();
  EXPECT_EQ(differences(options(), schema["options"]), none);
  EXPECT_EQ(differences(picture(), schema["picture"]), none);
  EXPECT_EQ(differences(picture()["camera"], schema["picture"]["properties"]["camera"]), none);

  for (const auto group : {SettingGroup::kMethod, SettingGroup::kFigure}) {
    const app::ExtraSetting extra({.name = "test-dial",
                                   .group = group,
                                   .get = [](const ViewerState&) { return std::string("1"); }});
    const auto keys = group == SettingGroup::kMethod ? differences(options(), schema["options"])
                                                     : differences(picture(), schema["picture"]);
    EXPECT_EQ(keys, std::vector<std::string>{"test_dial"});
  }
}

}  // namespace
}  // namespace geotherm::test
