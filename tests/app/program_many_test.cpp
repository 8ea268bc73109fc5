// SPDX-License-Identifier: MIT
// Rows of distances from many sources.
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <utility>

#include "app/cli/kept_rows.h"
#include "app/cli/many_work.h"
#include "app/session/settings.h"
#include "solver/core/stopwatch.h"
#include "tests/app/fake_drawing.h"
#include "tests/app/npy_file.h"
#include "tests/app/program_fixture.h"
#include "tests/support/compare.h"
#include "tests/support/shapes.h"

namespace geotherm::test {
namespace {

/// The tolerance is a share of the largest distance: several sources are solved as one block, which
/// rounds otherwise.
constexpr double kRoundOff = 1e-12;

TEST_F(Program, EachWritesTheRowsOfSingleSolvesInTheOrderOfTheSources) {
  const Json report = json({"solve", "bunny", "-s", "900,3", "-s", "random:2:5", "-s", "900", "-s",
                            "face:7:0.2:0.3:0.5", "--each", "-o", "rows.npy", "--json", "-"});
  ASSERT_EQ(report["sources"].size(), 6U);
  EXPECT_EQ(report["sources"][0], 900);
  EXPECT_EQ(report["sources"][1], 3);
  EXPECT_EQ(report["sources"][4], 900);
  const std::string bytes = bytes_of(folder.path("rows.npy"));
  const std::size_t vertices = report["model"]["vertices"];
  EXPECT_TRUE(has_shape(bytes, 6, vertices));
  const auto rows = npy_values<double>(bytes);
  ASSERT_EQ(rows.size(), 6 * vertices);
  for (std::size_t i = 0; i < 6; ++i) {
    const Json& source = report["sources"][i];
    const std::string text = source.is_number() ? source.dump() : "face:7:0.2:0.3:0.5";
    run({"solve", "bunny", "-s", text, "-o", "one.npy"});
    const auto begin = rows.begin() + static_cast<std::ptrdiff_t>(i * vertices);
    EXPECT_LE(relative_difference({begin, begin + static_cast<std::ptrdiff_t>(vertices)},
                                  npy_values<double>(bytes_of(folder.path("one.npy")))),
              kRoundOff)
        << text;
  }
  expect_keys(report,
              {{"model", keys({"name", "vertices", "faces"})},
               {"options", keys({"method", "backend", "t", "threads"})},
               {"rows", nullptr},
               {"columns", nullptr},
               {"dtype", nullptr},
               {"distance", keys({"min", "max", "mean", "unreached"})},
               {"timing_ms", keys({"load", "setup", "queries", "query"})},
               {"memory_mb", keys({"factor", "answers", "peak_rss"})},
               {"warnings", nullptr}},
              "");
}

TEST_F(Program, EachHasTheBitsOfSingleSolvesByMethodsWithoutBlocks) {
  run({"solve", "bunny", "-s", "5,900", "--each", "-o", "a.npy", "--method", "wavefront"});
  const auto rows = npy_values<double>(bytes_of(folder.path("a.npy")));
  run({"solve", "bunny", "-s", "900", "-o", "b.npy", "--method", "wavefront"});
  const auto single = npy_values<double>(bytes_of(folder.path("b.npy")));
  ASSERT_EQ(rows.size(), 2 * single.size());
  EXPECT_TRUE(std::equal(single.begin(), single.end(),
                         rows.begin() + static_cast<std::ptrdiff_t>(single.size())));
}

TEST_F(Program, EachIsTheSameOnStandardOutputAndForAnyThreads) {
  run({"solve", "bunny", "-s", "random:40", "--each", "-o", "rows.npy", "--threads", "1"});
  const ProgramRun streamed =
      run({"solve", "bunny", "-s", "random:40", "--each", "-o", "-", "--threads", "3"});
  EXPECT_EQ(streamed.out, bytes_of(folder.path("rows.npy")));
}

TEST_F(Program, EachRoundsToFloatsWhereAsked) {
  run({"solve", "bunny", "-s", "1,2", "--each", "-o", "a.npy"});
  run({"solve", "bunny", "-s", "1,2", "--each", "-o", "b.npy", "--float32"});
  run({"solve", "bunny", "-s", "1,2", "--each", "-o", "c.npy", "--dtype", "float32"});
  const auto exact = npy_values<double>(bytes_of(folder.path("a.npy")));
  const std::string rounded = bytes_of(folder.path("b.npy"));
  EXPECT_NE(rounded.find("'<f4'"), std::string::npos);
  EXPECT_EQ(rounded, bytes_of(folder.path("c.npy")));
  const auto floats = npy_values<float>(rounded);
  ASSERT_EQ(floats.size(), exact.size());
  for (std::size_t i = 0; i < floats.size(); ++i) {
    EXPECT_EQ(floats[i], static_cast<float>(exact[i])) << i;
  }
}

TEST_F(Program, EachKeepsTheUnreachedInfiniteAndSaysWhy) {
  folder.write("two.obj",
               "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 5 0 0\nv 6 0 0\nv 5 1 0\nf 1 2 3\nf 4 5 6\n");
  const ProgramRun done = run({"solve", "two.obj", "-s", "0,4", "--each", "-o", "a.npy"});
  EXPECT_NE(done.err.find("6 distances are infinite"), std::string::npos) << done.err;
  const auto rows = npy_values<double>(bytes_of(folder.path("a.npy")));
  ASSERT_EQ(rows.size(), 12U);
  for (std::size_t v = 0; v < 6; ++v) {
    EXPECT_EQ(std::isinf(rows[v]), v >= 3);
    EXPECT_EQ(std::isinf(rows[6 + v]), v < 3);
  }
}

TEST_F(Program, EachThatIsInterruptedLeavesNothing) {
  constexpr int kMaxLooks = 20'000, kBetweenLooks = 1000;  // microseconds
  folder.write("rows.npy", "old");
  const RunningProgram program(
      folder.path("."), {"solve", "terrain", "-s", "random:5000", "--each", "-o", "rows.npy"});
  const auto begun = [&] {
    const auto names = folder.names();
    return std::ranges::any_of(
        names, [](const std::string& name) { return name.ends_with(".part.done"); });
  };
  for (int look = 0; look < kMaxLooks && !begun(); ++look) ::usleep(kBetweenLooks);
  ASSERT_TRUE(begun());
  program.signal(SIGINT);
  EXPECT_EQ(program.wait().code, 128 + SIGINT);
  EXPECT_EQ(folder.names(), std::vector<std::string>{"rows.npy"});
  EXPECT_EQ(bytes_of(folder.path("rows.npy")), "old");
}

TEST(CancelledEach, LeavesNothing) {
  const TemporaryDirectory folder;
  app::SolveArguments arguments;
  arguments.model = "bunny";
  arguments.sources.sources = {"random:500"};
  arguments.outputs = {folder.path("a.npy")};
  arguments.each = true;
  int calls = 0;
  const auto result = app::run_solve(arguments, FakeDrawing(), [&](std::string_view stage, double) {
    return stage.find("500 sources") == std::string_view::npos || ++calls < 3;
  });
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kCancelled);
  EXPECT_EQ(folder.names(), std::vector<std::string>{});
}

/// Rows of 200 sources, or their pairs, into a.npy.
app::SolveArguments many_rows(const TemporaryDirectory& folder, bool pairs) {
  app::SolveArguments arguments;
  arguments.model = folder.path("model.ply");
  arguments.sources.sources = {"random:200"};
  arguments.settings.texts["threads"] = "1";
  arguments.check.no_check = true;
  arguments.outputs = {folder.path("a.npy")};
  arguments.json = folder.path("a.json");
  (pairs ? arguments.pairs : arguments.each) = true;
  return arguments;
}

/// Ends the work between two chunks, when rows have come for long enough to be kept.
void end_early(const app::SolveArguments& arguments) {
  constexpr int kLongEnough = 2'100'000;  // microseconds
  constexpr double kUntil = 0.6;          // of the work: some chunks are solved by then
  bool waited = false;
  const auto progress = [&](std::string_view stage, double share) {
    if (stage.find("200 sources") == std::string_view::npos) return true;
    if (!std::exchange(waited, true)) ::usleep(kLongEnough);
    return share < kUntil;
  };
  const auto result = app::run_solve(arguments, FakeDrawing(), progress);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kCancelled);
}

/// How many rows of a whole run were there before it.
int rows_before(const app::SolveArguments& arguments) {
  const auto result = app::run_solve(arguments, FakeDrawing());
  EXPECT_TRUE(result) << sentence(result.error());
  return Json::parse(bytes_of(arguments.json)).value("done_before", 0);
}

class KeptRows : public testing::TestWithParam<bool> {
 protected:
  KeptRows() {
    run_program(folder.path("."), {"generate", "bunny", "--faces", "2000", "-o", "model.ply"});
  }
  TemporaryDirectory folder;
};

TEST_P(KeptRows, AreNotSolvedForAgainAndTheFileIsTheSame) {
  const auto arguments = many_rows(folder, GetParam());
  EXPECT_EQ(rows_before(arguments), 0);
  const std::string whole = bytes_of(folder.path("a.npy"));
  end_early(arguments);
  EXPECT_EQ(bytes_of(folder.path("a.npy")), whole);  // until there is another
  EXPECT_TRUE(std::filesystem::exists(folder.path("a.npy.part")));
  std::filesystem::remove(folder.path("a.npy"));
  EXPECT_GE(rows_before(arguments), 16);
  EXPECT_EQ(bytes_of(folder.path("a.npy")), whole);
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"a.json", "a.npy", "model.ply"}));
}

TEST_P(KeptRows, AreOfNoUseToOtherSourcesAndAnotherModel) {
  auto arguments = many_rows(folder, GetParam());
  end_early(arguments);
  arguments.sources.sources = {"random:200:7"};
  EXPECT_EQ(rows_before(arguments), 0);
  end_early(arguments);
  run_program(folder.path("."), {"generate", "sleeve", "--faces", "2000", "-o", "model.ply"});
  EXPECT_EQ(rows_before(arguments), 0);
}

INSTANTIATE_TEST_SUITE_P(Of, KeptRows, testing::Bool(),
                         [](const auto& test) { return test.param ? "Pairs" : "Each"; });

TEST(KeptRowsJob, KnowsCurvesAcrossFaces) {
  app::ManySources work{{}, {}, {}, {}, {}, {}, 1, *app::Ranks::join(), {}, 0, 0};
  work.model.mesh = finish(plane_grid(2, 2, 1, 1));
  SourceSet set;
  set.segments = {{0, {1, 0, 0}, {0, 1, 0}, 0}};
  work.sources.sets = {set};
  const std::string one = app::job_of(work, 9, NpyType::kFloat64);
  work.sources.sets.front().segments.front().to = {0, 0, 1};
  EXPECT_NE(app::job_of(work, 9, NpyType::kFloat64), one);
}

TEST(RoomForMany, IsAskedBeforeTheWork) {
  constexpr double kMoreThanAnyDisk = 1e24;
  const TemporaryDirectory folder;
  EXPECT_TRUE(app::check_room(folder.path("a.npy"), 1));
  EXPECT_TRUE(app::check_room("-", kMoreThanAnyDisk));
  const auto refused = app::check_room(folder.path("a.npy"), kMoreThanAnyDisk);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kBadFile);
  for (const char* part :
       {"a.npy: the file would take 9.09e+11 TB", "are free there; take fewer"}) {
    EXPECT_NE(sentence(refused.error()).find(part), std::string::npos) << refused.error().message;
  }
}

constexpr unsigned kMeasurable = 150'000;  // microseconds: long enough for an estimate

TEST(Estimate, IsToldOnceWhereMoreThanASecondIsLeft) {
  std::vector<std::string> told;
  const auto progress = app::with_estimate(
      {}, [&](const std::string& text) { told.push_back(text); }, "rows", "9 sources", "a file");
  EXPECT_TRUE(progress("solve", 0.9));  // the guess of a method
  EXPECT_TRUE(progress("rows", 1e-9));
  EXPECT_TRUE(told.empty());
  ::usleep(kMeasurable);
  EXPECT_TRUE(progress("rows", 2e-9));
  EXPECT_TRUE(progress("rows", 3e-9));
  ASSERT_EQ(told.size(), 1U);
  EXPECT_TRUE(told[0].starts_with("9 sources: about ") && told[0].ends_with(", a file")) << told[0];
}

TEST(Estimate, TakesTheSpeedOfAllPartsButTheFirst) {
  constexpr double kParts = 100, kRounded = 1.1;
  const Stopwatch watch;
  std::string told;
  const auto progress = app::with_estimate(
      {}, [&](const std::string& text) { told = text; }, "rows", "all");
  ::usleep(4 * kMeasurable);  // once
  EXPECT_TRUE(progress("rows", 1 / kParts));
  const double first = watch.milliseconds() / 1000;
  ::usleep(kMeasurable);
  EXPECT_TRUE(progress("rows", 2 / kParts));
  const double second = watch.milliseconds() / 1000 - first;
  const std::string begin = "all: about ";
  ASSERT_TRUE(told.starts_with(begin) && told.ends_with(" s")) << told;
  const double seconds = std::stod(told.substr(begin.size()));
  EXPECT_LT(seconds, kRounded * (first + second * (kParts - 1)));
  EXPECT_GT(seconds, second * (kParts - 1) / kRounded);
}

TEST(Sizes, AreOfTwoToTheTenthEach) {
  EXPECT_EQ(app::bytes_in_words(0x1p30), "1 GB");
  EXPECT_EQ(app::bytes_in_words(0x1p30 - 1), "1 GB");
  EXPECT_EQ(app::bytes_in_words(3.2 * 0x1p30), "3.2 GB");
  EXPECT_EQ(app::bytes_in_words(1000 * app::kMegabyte), "0.977 GB");
  EXPECT_EQ(app::bytes_in_words(800 * app::kMegabyte), "800 MB");
  app::ViewerState state;
  ASSERT_TRUE(app::find_setting("memory-limit")->set(state, "800"));
  EXPECT_EQ(state.options.memory_limit_mb * app::kMegabyte, 800 * 0x1p20);
  EXPECT_EQ(app::bytes_in_words(1023), "1,023 bytes");
  EXPECT_EQ(app::bytes_in_words(1), "1 byte");
}

TEST(Times, AreInTheUnitsOfPeople) {
  EXPECT_EQ(app::seconds_in_words(12.4), "12 s");
  EXPECT_EQ(app::seconds_in_words(200), "3 min 20 s");
  EXPECT_EQ(app::seconds_in_words(7500), "2 h 5 min");
}

}  // namespace
}  // namespace geotherm::test
