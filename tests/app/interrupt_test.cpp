// SPDX-License-Identifier: MIT
// Signals at any moment of a run: each output is absent or whole, and nothing else is left.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <random>

#include "tests/app/program.h"

namespace geotherm::test {
namespace {

constexpr std::uint64_t kSeed = 20254;

class Interrupt : public testing::TestWithParam<int> {};

TEST_P(Interrupt, EndsTheProgramByTheSignalWithoutHalfAFile) {
  constexpr int kRuns = 5;
  const std::vector<std::string> arguments = {"generate", "terrain", "--faces",
                                              "40000",    "-o",      "terrain.obj"};
  std::size_t whole = 0;
  {
    const TemporaryDirectory folder;
    ASSERT_EQ(run_program(folder.path("."), arguments).code, 0);
    whole = bytes_of(folder.path("terrain.obj")).size();
  }
  std::mt19937_64 random(kSeed);
  for (int i = 0; i < kRuns; ++i) {
    const TemporaryDirectory folder;
    const RunningProgram program(folder.path("."), arguments);
    ::usleep(static_cast<useconds_t>(5000 + random() % 60000));
    program.signal(GetParam());
    const ProgramRun run = program.wait();
    EXPECT_TRUE(run.code == 0 || run.code == 128 + GetParam()) << run.code << run.err;
    EXPECT_EQ(run.err, "");
    for (const std::string& name : folder.names()) {
      EXPECT_EQ(name, "terrain.obj");
      EXPECT_EQ(bytes_of(folder.path(name)).size(), whole);
    }
  }
}

/// Waits until the program writes a file and halts it there, sends the signal and lets it go on.
/// False where the file was written before it could be halted.
bool interrupt_writing(const RunningProgram& program, const TemporaryDirectory& folder,
                       int number) {
  constexpr int kMaxLooks = 200'000, kBetweenLooks = 50, kUntilHalted = 5000;  // microseconds
  const auto is_writing = [](const std::string& name) { return name.find(".tmp-") != name.npos; };
  for (int look = 0; look < kMaxLooks; ++look) {
    const auto names = folder.names();
    if (std::ranges::any_of(names, is_writing)) break;
    if (!names.empty()) break;  // it is there already
    ::usleep(kBetweenLooks);
  }
  program.signal(SIGSTOP);
  ::usleep(kUntilHalted);
  const bool halted = std::ranges::any_of(folder.names(), is_writing);
  program.signal(number);
  program.signal(SIGCONT);
  return halted;
}

TEST_P(Interrupt, RemovesTheFileThatIsBeingWritten) {
  constexpr int kMaxRuns = 20;
  bool halted = false;
  for (int i = 0; i < kMaxRuns && !halted; ++i) {
    const TemporaryDirectory folder;
    const RunningProgram program(folder.path("."),
                                 {"generate", "terrain", "--faces", "100000", "-o", "terrain.obj"});
    halted = interrupt_writing(program, folder, GetParam());
    const ProgramRun run = program.wait();
    if (!halted) continue;
    EXPECT_EQ(run.code, 128 + GetParam()) << run.err;
    EXPECT_EQ(run.err, "");
    EXPECT_EQ(folder.names(), std::vector<std::string>{});
  }
  EXPECT_TRUE(halted) << "no run was halted while it wrote";
}

INSTANTIATE_TEST_SUITE_P(By, Interrupt, testing::Values(SIGINT, SIGTERM, SIGHUP, SIGQUIT),
                         [](const auto& test) {
                           if (test.param == SIGINT) return "Sigint";
                           if (test.param == SIGTERM) return "Sigterm";
                           return test.param == SIGHUP ? "Sighup" : "Sigquit";
                         });

TEST(IgnoredSignal, StaysIgnored) {
  const TemporaryDirectory folder;
  const auto before = ::signal(SIGHUP, SIG_IGN);  // as nohup does
  const RunningProgram program(folder.path("."), {"solve", "bunny", "-s", "1", "-o", "a.csv"});
  ::signal(SIGHUP, before);
  ::usleep(20000);
  program.signal(SIGHUP);
  EXPECT_EQ(program.wait().code, 0);
  EXPECT_EQ(folder.names(), std::vector<std::string>{"a.csv"});
}

}  // namespace
}  // namespace geotherm::test
