// SPDX-License-Identifier: MIT
// Where files are read and written: odd names, places without room, tight limits.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>

#include "solver/core/text.h"
#include "tests/app/program.h"

namespace geotherm::test {
namespace {

constexpr const char* kUnitSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n";

void expect_one_line(const ProgramRun& run, const std::string& part) {
  EXPECT_EQ(run.code, 1);
  EXPECT_EQ(run.out, "");
  EXPECT_TRUE(run.err.starts_with("geotherm: error: ")) << run.err;
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  EXPECT_NE(run.err.find(part), std::string::npos) << run.err;
}

class OddName : public testing::TestWithParam<const char*> {};

TEST_P(OddName, IsReadAndWritten) {
  const TemporaryDirectory folder;
  const std::string name = GetParam();
  folder.write(name + ".obj", kUnitSquare);
  const ProgramRun run = run_program(
      folder.path("."), {"solve", name + ".obj", "-s", "0", "-o", name + ".csv", "--json", "-"});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_TRUE(bytes_of(folder.path(name + ".csv")).starts_with("vertex,distance\n0,0\n"));
  EXPECT_NE(run.out.find("\"vertices\": 4"), std::string::npos) << run.out;
  EXPECT_EQ(folder.names().size(), 2U);
}

std::string odd_name(const testing::TestParamInfo<const char*>& test) {
  constexpr const char* kNames[] = {"Blanks", "Utf8", "InvalidUtf8", "Quotes"};
  return kNames[test.index];
}

INSTANTIATE_TEST_SUITE_P(Of, OddName,
                         testing::Values("two words", "\xc3\xa4\xe6\xbc\xa2", "\xff\xfe", "a\"b'c"),
                         odd_name);

TEST(NameThatIsNoText, LeavesAllOutputsTexts) {
  const TemporaryDirectory folder;
  const std::string name = "=\xff\xc2\x9b\x01<&\xed\xa0\x80.obj";
  folder.write(name, kUnitSquare);
  std::vector<ProgramRun> runs;
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"compare", name, "--queries", "2", "--html", "c.html", "--csv",
                                 "c.csv", "--json", "c.json"},
        {"isolines", name, "-s", "0", "--count", "2", "-o", "i.svg"},
        {"path", name, "--from", "0", "--to", "2", "-o", "p.svg"},
        {"solve", name, "-s", "0", "-o", "d.vtp", "--json", "s.json"},
        {"info", name}}) {
    runs.push_back(run_program(folder.path("."), arguments));
    EXPECT_EQ(runs.back().code, 0) << runs.back().err;
  }
  std::vector<std::string> texts;
  for (const ProgramRun& run : runs) texts.insert(texts.end(), {run.out, run.err});
  for (const char* const file : {"c.html", "c.csv", "c.json", "i.svg", "p.svg", "s.json"}) {
    texts.push_back(bytes_of(folder.path(file)));
  }
  for (std::string text : texts) {
    std::erase(text, '\n');
    EXPECT_EQ(printable(text), text);
  }
  EXPECT_EQ(bytes_of(folder.path("c.csv")).find("\"="), std::string::npos);
}

/// As `ulimit -f`, for programs that are started while it lives.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;
  ~FileSizeLimit() { ::setrlimit(RLIMIT_FSIZE, &before_); }

 private:
  rlimit before_{};
};

/// As `ulimit -s`, for programs that are started while it lives.
class StackLimit {
 public:
  explicit StackLimit(rlim_t bytes) {
    ::getrlimit(RLIMIT_STACK, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_STACK, &limit);
  }
  StackLimit(const StackLimit&) = delete;
  StackLimit& operator=(const StackLimit&) = delete;
  ~StackLimit() { ::setrlimit(RLIMIT_STACK, &before_); }

 private:
  rlimit before_{};
};

/// Ends with 0, or with one line of error where there is no device to draw on.
void expect_end(const TemporaryDirectory& folder, const std::vector<std::string>& arguments) {
  const ProgramRun run = run_program(folder.path("."), arguments);
  if (run.code == 0) return;
  EXPECT_EQ(run.code, 1) << arguments.front() << run.err;
  EXPECT_NE(run.err.find("device"), std::string::npos) << arguments.front() << run.err;
}

TEST(SmallStack, IsEnoughForEveryCommand) {
  const TemporaryDirectory folder;
  folder.write("s.geotherm", "open bunny\nsource set 3\ncompare all\nsave distances d.csv\n");
  const StackLimit limit(rlim_t{64} << 10);
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"solve", "bunny", "-s", "3", "--threads", "2"},
        {"solve", "bunny", "-s", "3", "--method", "exact"},
        {"compare", "bunny", "--queries", "2", "--threads", "2"},
        {"info", "bunny"},
        {"path", "bunny", "--from", "3", "--to", "500"},
        {"isolines", "bunny", "-s", "3", "--count", "5", "-o", "i.svg"},
        {"sample", "bunny", "-n", "5"},
        {"generate", "gargoyle", "--faces", "3000", "-o", "g.obj"},
        {"backends"},
        {"models"},
        {"devices"},
        {"render", "bunny", "-s", "3", "--size", "64x48", "-o", "r.png"},
        {"view", "bunny", "--size", "64x48", "-o", "v.png"},
        {"view", "--headless", "--script", "s.geotherm"}}) {
    expect_end(folder, arguments);
  }
}

TEST(FileThatCannotGrow, IsOneLineAndLeavesWhatWasThere) {
  const TemporaryDirectory folder;
  folder.write("a.ply", "old");
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"generate", "bunny", "-o", "a.ply"},
        {"solve", "bunny", "-s", "1", "-o", "a.ply"},
        {"isolines", "bunny", "-s", "1", "--count", "30", "-o", "a.obj"}}) {
    constexpr rlim_t kBytes = 8192;  // fewer than any of them
    const FileSizeLimit limit(kBytes);
    expect_one_line(run_program(folder.path("."), arguments), "File too large");
  }
  EXPECT_EQ(bytes_of(folder.path("a.ply")), "old");
  EXPECT_EQ(folder.names(), std::vector<std::string>{"a.ply"});
}

TEST(FullDevice, IsOneLine) {
  const TemporaryDirectory folder;
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"info", "bunny", "--json", "/dev/full"},
        {"path", "bunny", "--from", "1", "--to", "9", "--json", "/dev/full"},
        {"study", "bunny", "--json", "/dev/full"}}) {
    expect_one_line(run_program(folder.path("."), arguments), "No space left");
  }
  EXPECT_EQ(folder.names(), std::vector<std::string>{});
}

TEST(FolderWithoutPermission, IsOneLine) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  const TemporaryDirectory folder;
  ::mkdir(folder.path("in").c_str(), 0555);
  expect_one_line(run_program(folder.path("."), {"generate", "bunny", "-o", "in/a.ply"}), "in");
}

}  // namespace
}  // namespace geotherm::test
