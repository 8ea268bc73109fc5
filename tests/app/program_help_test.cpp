// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <set>

#include "app/session/settings.h"
#include "tests/app/program_fixture.h"

namespace geotherm::test {
namespace {

class ProgramHelp : public Program {
 protected:
  /// What a shell prints for these lines.
  std::string shell_says(const std::string& command) {
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(
        ::popen(("cd '" + folder.path(".") + "' && " + command).c_str(), "r"), ::pclose);
    std::string text;
    for (int c = std::fgetc(pipe.get()); c != EOF; c = std::fgetc(pipe.get())) {
      text += static_cast<char>(c);
    }
    return text;
  }
  std::string script_for(const std::string& shell) {
    return folder.write("completion." + shell, run({"completion", shell}).out);
  }
};

/// Settings that hints name in the sources; `with_values`: those alone that hints have values for.
std::set<std::string> hinted_settings(bool with_values) {
  const std::string begin = "SettingHint{\"";
  const std::filesystem::path root = std::filesystem::path(GEOTHERM_DOCS).parent_path();
  std::set<std::string> names;
  for (const char* folder : {"app", "engine", "solver", "ui"}) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder)) {
      if (entry.path().extension() != ".cpp") continue;
      const std::string text = bytes_of(entry.path().string());
      for (std::size_t at = text.find(begin); at != text.npos; at = text.find(begin, at + 1)) {
        const std::size_t from = at + begin.size(), to = text.find('"', from);
        if (!with_values || text[to + 1] == ',') names.insert(text.substr(from, to - from));
      }
    }
  }
  return names;
}

TEST_F(ProgramHelp, IsWhatTheProgramAloneAndTheCommandHelpPrint) {
  const std::string help = run({"--help"}).out;
  EXPECT_NE(help.find("geotherm COMMAND --help"), std::string::npos);
  EXPECT_EQ(run({}).out, help);
  EXPECT_EQ(run({"help"}).out, help);
  EXPECT_EQ(run({"help", "solve"}).out, run({"solve", "--help"}).out);
  EXPECT_EQ(run({"-V"}).out, run({"--version"}).out);
}

TEST_F(ProgramHelp, NamesTheWordThatWasMeant) {
  expect_refused({"slove", "bunny"}, "did you mean solve? there are view, solve");
  expect_refused({"bunyn"}, "did you mean bunny?");
  expect_refused({"help", "solv"}, "did you mean solve?");
  expect_refused({"solve", "bunny", "--bakend", "cg"},
                 "no option --bakend; did you mean --backend? see geotherm solve --help");
  expect_refused({"solve", "bunny", "-s", "0", "--backend=cholmdo"}, "did you mean cholmod?");
  expect_refused({"solve", "bunny", "-s", "0", "--laplacian", "tuftde"}, "did you mean tufted?");
  expect_refused({"solve", "bunnny", "-s", "0"}, "did you mean bunny?");
  expect_refused({"completion", "fsih"}, "did you mean fish?");
}

TEST_F(ProgramHelp, IsSilentAboutWordsThatAreFarFromAll) {
  const ProgramRun far = run_program(folder.path("."), {"xylophone"});
  EXPECT_EQ(far.code, 2);
  EXPECT_EQ(far.err.find("did you mean"), std::string::npos) << far.err;
}

TEST_F(ProgramHelp, HasAnOptionForEachSettingThatAHintNames) {
  const std::string options = run({"completion", "fish"}).out;
  const std::set<std::string> names = hinted_settings(false);
  EXPECT_TRUE(names.contains("backend") && names.contains("memory-limit"));
  for (const std::string& name : names) {
    EXPECT_NE(options.find(" -l " + name + " "), options.npos) << name;
  }
  // The window has a button for each value, so these are in the table; it has no signed distance.
  std::set<std::string> missing = hinted_settings(true);
  std::erase_if(missing, [](const std::string& name) { return app::find_setting(name); });
  EXPECT_EQ(missing, std::set<std::string>{"rule"});
}

TEST_F(ProgramHelp, BashCompletesCommandsOptionsValuesAndFiles) {
  const std::string script = script_for("bash");
  folder.write("scan.obj", "");
  const auto completed = [&](const std::string& words, int at) {
    return shell_says("bash -c 'source " + script + "; COMP_WORDS=(" + words + "); COMP_CWORD=" +
                      std::to_string(at) + "; _geotherm; echo \"${COMPREPLY[@]}\"'");
  };
  EXPECT_EQ(completed("geotherm sol", 1), "solve\n");
  EXPECT_EQ(completed("geotherm solve --bac", 2), "--backend\n");
  EXPECT_EQ(completed("geotherm solve bunny --laplacian tu", 4), "tufted\n");
  EXPECT_EQ(completed("geotherm solve bun", 2), "bunny\n");
  EXPECT_EQ(completed("geotherm solve sca", 2), "scan.obj\n");
  EXPECT_EQ(completed("geotherm solve bunny -o sca", 4), "scan.obj\n");
  EXPECT_EQ(completed("geotherm solve bunny --on-poor be", 4), "better\n");
  EXPECT_EQ(completed("geotherm solve --quiet bun", 3), "bunny\n");  // which takes no value
  EXPECT_EQ(completed("geotherm help stu", 2), "study\n");
  EXPECT_EQ(completed("geotherm help sca", 2), "\n") << "takes no file";
  EXPECT_EQ(completed("geotherm generate sca", 2), "\n");
  EXPECT_EQ(completed("geotherm completion zs", 2), "zsh\n");
  EXPECT_EQ(completed("geotherm render --colour-map viri", 3), "viridis\n");
  EXPECT_EQ(completed("geotherm path bunny --field geo", 4), "geodesic\n");
  EXPECT_EQ(completed("geotherm render bunny --field sca", 4), "scan.obj\n");
  EXPECT_EQ(completed("geotherm signed bunny --rule si", 4), "sides\n");
  EXPECT_EQ(completed("geotherm compare bunny --reference exa", 4), "exact\n");
  EXPECT_EQ(completed("geotherm solve bunny --method = exa", 5), "exact\n");
  EXPECT_EQ(completed("geotherm solve bunny --on-poor =", 4), "keep better fail\n");
  EXPECT_EQ(completed("geotherm bunny --azim", 2), "--azimuth\n");  // which is the command view
}

TEST_F(ProgramHelp, FishCompletesCommandsOptionsAndValues) {
  const std::string script = script_for("fish");
  if (shell_says("command -v fish").empty()) GTEST_SKIP() << "fish is not installed";
  const auto completed = [&](const std::string& line) {
    return shell_says("HOME=. fish -c 'source " + script + "; complete -C \"" + line + "\"'");
  };
  EXPECT_EQ(completed("geotherm solve bunny --backend nat").substr(0, 20), "native\tlinear solver");
  EXPECT_NE(completed("geotherm solve --memory-l").find("a backend's factors"), std::string::npos);
  EXPECT_EQ(completed("geotherm solve --lap").substr(0, 11), "--laplacian");
  EXPECT_EQ(completed("geotherm isol").substr(0, 8), "isolines");
}

TEST_F(ProgramHelp, ZshTakesItsScript) {
  const std::string script = script_for("zsh");
  if (shell_says("command -v zsh").empty()) GTEST_SKIP() << "zsh is not installed";
  // Options that zsh cannot read are said where they are first used, by _arguments.
  const std::string said = shell_says(
      "zsh -f -c 'compdef() { }; _arguments() { print -r -- $# \"$@\"; }; _files() { }; "
      "words=(geotherm solve); CURRENT=3; source " +
      script + "; _geotherm' 2>&1");
  EXPECT_GT(std::atoi(said.c_str()), 30) << said;
  EXPECT_NE(said.find("a backend's factors"), std::string::npos) << said;
}

}  // namespace
}  // namespace geotherm::test
