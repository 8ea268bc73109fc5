// SPDX-License-Identifier: MIT
// Many models, each in a process of its own.
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>
#include <thread>

#include "solver/core/stopwatch.h"
#include "tests/app/npy_file.h"
#include "tests/app/program_fixture.h"

namespace geotherm::test {
namespace {

namespace fs = std::filesystem;

class BatchProgram : public Program {
 protected:
  void SetUp() override {
    fs::create_directories(folder.path("shapes/inner"));
    for (const char* name : {"shapes/a.ply", "shapes/b.obj", "shapes/inner/a.ply"}) {
      run({"generate", "bunny", "--faces", "500", "-o", name});
    }
  }

  std::map<std::string, Json> manifest() {
    std::map<std::string, Json> lines;
    std::ifstream file(folder.path("out/manifest.jsonl"));
    for (std::string line; std::getline(file, line);) {
      const Json each = Json::parse(line);
      EXPECT_TRUE(lines.emplace(each["model"], each).second) << "two lines: " << line;
    }
    return lines;
  }
};

TEST_F(BatchProgram, WritesWhatSingleSolvesWriteUnderTheNamesOfTheModels) {
  const Json report = json({"batch", "shapes/*.*", "bunny", "-s", "0,7", "--each", "--dtype",
                            "float32", "-m", "2", "--out-dir", "out", "--json", "-"});
  EXPECT_EQ(report["batch"]["meshes"], 3);
  EXPECT_EQ(report["batch"]["done"], 3);
  EXPECT_EQ(report["batch"]["refused"], 0);
  const auto lines = manifest();
  ASSERT_EQ(lines.size(), 3U);
  for (const auto& [model, line] : lines) {
    EXPECT_EQ(line["status"], "done");
    EXPECT_GT(line["seconds"], 0);
    run({"solve", model, "-s", "0,7", "--each", "--float32", "-m", "2", "-o", "one.npy"});
    EXPECT_EQ(bytes_of(folder.path(line["output"].get<std::string>())),
              bytes_of(folder.path("one.npy")))
        << model;
    EXPECT_TRUE(fs::exists(folder.path(line["report"].get<std::string>())));
  }
}

TEST_F(BatchProgram, FoldersOfAPatternBecomeFoldersOfTheOutput) {
  run({"batch", "shapes/*/*.ply", "-s", "0", "--output-format", "csv", "--out-dir", "out"});
  EXPECT_TRUE(fs::exists(folder.path("out/inner/a.csv")));
  expect_refused({"batch", "shapes/a.ply", "shapes/inner/a.ply", "-s", "0", "--out-dir", "out"},
                 "would both write a.npy");
}

TEST_F(BatchProgram, AWrongCommandLineIsRefusedBeforeAnyModel) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> wrong = {
      {{"--symmetric"}, "--symmetric is about --pairs; leave it out\n"},
      {{"--float32"}, "--dtype and --float32 are about --each"},
      {{"--each", "--pairs"}, "--each and --pairs were both given"},
      {{"--each", "--dtype", "int8"}, "--dtype: "},
      {{"--output-format", "obj"}, "--output-format: FILE.obj: .obj holds no value per vertex"},
      {{"--output-format", "npz"}, "--output-format: FILE.npz: unknown extension"},
      {{"--output-format", "json"}, "--output-format: FILE.json: unknown extension"},
      {{"--each", "--output-format", "csv"}, "--output-format: FILE.csv: --each writes"},
      {{"--pairs", "--output-format", "ply"}, "--output-format: FILE.ply: --pairs writes"},
      {{"--on-poor", "fail", "--no-check"}, "--on-poor fail needs the check"},
  };
  for (const auto& [words, what] : wrong) {
    std::vector<std::string> command = {"batch", "shapes/*.*", "-s", "0", "--out-dir", "out"};
    command.insert(command.end(), words.begin(), words.end());
    const ProgramRun result = run_program(folder.path("."), command);
    EXPECT_EQ(result.code, 2) << what;
    EXPECT_NE(result.err.find(what), std::string::npos) << result.err;
    EXPECT_FALSE(fs::exists(folder.path("out"))) << what;
  }
  expect_refused({"batch", "shapes", "-s", "0", "--out-dir", "out"},
                 "shapes: this is a folder; give files, or a pattern in quotes");
}

TEST_F(BatchProgram, AModelThatFailsIsALineAndStopsNoOther) {
  std::ofstream(folder.path("shapes/c.ply")) << "ply\nnothing\n";
  const ProgramRun result = run_program(
      folder.path("."), {"batch", "shapes/*", "-s", "0", "--out-dir", "out", "--jobs", "2"});
  EXPECT_EQ(result.code, 1);
  EXPECT_NE(result.err.find("1 of 3 models"), std::string::npos) << result.err;
  const auto lines = manifest();
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines.at("shapes/a.ply")["status"], "done");
  EXPECT_EQ(lines.at("shapes/c.ply")["status"], "refused");
  EXPECT_NE(lines.at("shapes/c.ply")["message"].get<std::string>().find("c.ply"),
            std::string::npos);
  EXPECT_FALSE(fs::exists(folder.path("out/c.npy")));
}

TEST_F(BatchProgram, WhatIsDoneIsDoneOnceUntilModelOrOptionsChange) {
  const std::vector<std::string> words = {"batch",     "shapes/?.*", "-s",     "0",
                                          "--out-dir", "out",        "--json", "-"};
  const auto done = [&](const std::vector<std::string>& command) {
    return json(command)["batch"]["done"].get<int>();
  };
  EXPECT_EQ(done(words), 2);
  EXPECT_EQ(done(words), 0);
  fs::remove(folder.path("out/a.npy"));
  EXPECT_EQ(done(words), 1);
  const auto whole = fs::file_size(folder.path("out/a.npy"));
  fs::resize_file(folder.path("out/a.npy"), 100);
  fs::last_write_time(folder.path("out/a.npy"),
                      fs::file_time_type::clock::now() + std::chrono::seconds(1));
  EXPECT_EQ(done(words), 1) << "cut off since";
  EXPECT_EQ(fs::file_size(folder.path("out/a.npy")), whole);
  EXPECT_EQ(done(words), 0);
  fs::last_write_time(folder.path("shapes/b.obj"),
                      fs::file_time_type::clock::now() + std::chrono::hours(1));
  EXPECT_EQ(done(words), 1);
  std::vector<std::string> others = words;
  others[3] = "1";
  EXPECT_EQ(done(others), 2);
  EXPECT_EQ(manifest().size(), 2U);
  // A report and a line of another program are not of this one.
  fs::last_write_time(folder.path("shapes/b.obj"),
                      fs::file_time_type::clock::now() - std::chrono::hours(1));
  folder.write("out/a.json", R"({"program": "other", "version": 3})");
  std::ofstream(folder.path("out/manifest.jsonl"), std::ios::app)
      << R"({"model": 7, "status": 1})"
      << "\n[]\n"
      << R"({"model": "shapes/b.obj", "status": 1})" << '\n';
  EXPECT_EQ(done(others), 1);
}

TEST_F(BatchProgram, ThatIsKilledLeavesWholeFilesAndGoesOnFromThere) {
  for (int i = 0; i < 6; ++i) {
    run({"generate", "bunny", "--faces", "3000", "-o", "shapes/m" + std::to_string(i) + ".ply"});
  }
  const std::vector<std::string> words = {"batch",  "shapes/m*.ply", "-s",  "random:400",
                                          "--each", "--out-dir",     "out", "--jobs",
                                          "1",      "--no-check"};
  const RunningProgram killed(folder.path("."), words);
  const Stopwatch watch;
  while (!fs::exists(folder.path("out/m1.json")) && watch.milliseconds() < 60'000) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  killed.signal(SIGKILL);
  killed.wait();
  std::this_thread::sleep_for(std::chrono::milliseconds(300));  // those that it started end, too
  std::map<std::string, std::string> before;
  std::map<std::string, fs::file_time_type> times;
  for (const auto& entry : fs::directory_iterator(folder.path("out"))) {
    const std::string name = entry.path().filename().string();
    EXPECT_EQ(name.find(".tmp-"), std::string::npos) << name;
    if (entry.path().extension() != ".npy") continue;
    before[name] = bytes_of(entry.path().string());
    times[name] = fs::last_write_time(entry.path());
  }
  ASSERT_GE(before.size(), 2U);
  ASSERT_LT(before.size(), 6U) << "it was not killed in time";
  run(words);
  EXPECT_EQ(manifest().size(), 6U);
  run({"solve", "shapes/m0.ply", "-s", "random:400", "--each", "--no-check", "-o", "one.npy"});
  for (int i = 0; i < 6; ++i) {
    const std::string name = "m" + std::to_string(i) + ".npy";
    EXPECT_EQ(bytes_of(folder.path("out/" + name)), bytes_of(folder.path("one.npy"))) << name;
  }
  for (const char* name : {"m0.npy", "m1.npy"}) {
    EXPECT_EQ(fs::last_write_time(folder.path("out/" + std::string(name))), times[name])
        << "done twice";
  }
}

TEST_F(BatchProgram, SaysWhatIsWrongBeforeAnythingIsSolved) {
  expect_refused({"batch", "shapes/*.off", "-s", "0", "--out-dir", "out"}, "no file fits");
  expect_refused({"batch", "shapes/z.ply", "-s", "0", "--out-dir", "out"}, "no such file");
  expect_refused({"batch", "shapes/*.ply", "--out-dir", "out"}, "no source");
  expect_refused({"batch", "shapes/*.ply", "-s", "0", "--out-dir", "out", "-m", "x"},
                 "time-factor");
  expect_refused({"batch", "shapes/*.ply", "-s", "0", "--out-dir", "out", "--jobs", "0"}, "--jobs");
  expect_refused({"batch", "shapes/*.ply", "-s", "0", "--out-dir", "shapes/a.ply"}, "folder");
  EXPECT_FALSE(fs::exists(folder.path("out/a.npy")));
}

}  // namespace
}  // namespace geotherm::test
