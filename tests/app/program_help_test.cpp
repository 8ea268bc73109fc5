// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <memory>

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
  EXPECT_EQ(completed("geotherm help stu", 2), "study\n");
  EXPECT_EQ(completed("geotherm bunny --azim", 2), "--azimuth\n");  // which is the command view
}

TEST_F(ProgramHelp, FishCompletesCommandsOptionsAndValues) {
  const std::string script = script_for("fish");
  if (shell_says("command -v fish").empty()) GTEST_SKIP() << "fish is not installed";
  const auto completed = [&](const std::string& line) {
    return shell_says("HOME=. fish -c 'source " + script + "; complete -C \"" + line + "\"'");
  };
  EXPECT_EQ(completed("geotherm solve bunny --backend nat"), "native\tlinear solver\n");
  EXPECT_EQ(completed("geotherm solve --lap").substr(0, 11), "--laplacian");
  EXPECT_EQ(completed("geotherm isol").substr(0, 8), "isolines");
}

TEST_F(ProgramHelp, ZshTakesItsScript) {
  const std::string script = script_for("zsh");
  if (shell_says("command -v zsh").empty()) GTEST_SKIP() << "zsh is not installed";
  // Options that zsh cannot read are said where they are first used, by _arguments.
  const std::string said = shell_says(
      "zsh -f -c 'compdef() { }; _arguments() { print -r -- $#; }; _files() { }; words=(geotherm "
      "solve); CURRENT=3; source " +
      script + "; _geotherm' 2>&1");
  EXPECT_GT(std::atoi(said.c_str()), 30) << said;
}

}  // namespace
}  // namespace geotherm::test
