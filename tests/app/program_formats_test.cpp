// SPDX-License-Identifier: MIT
// One mesh in every format, from files, packed ones, pipes and standard input: one answer.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <thread>

#include "geotherm/domains.h"
#include "solver/mesh/io/formats.h"
#include "tests/app/program_fixture.h"

namespace geotherm::test {
namespace {

class Formats : public Program {
 protected:
  std::string distances(const std::string& model, const std::string& input = {}) {
    const ProgramRun result = run_program(
        folder.path("."), {"solve", model, "-s", "4", "--method", "exact", "-o", "-", "--quiet"},
        Stdout::kCaptured, 0, input);
    EXPECT_EQ(result.code, 0) << model << ": " << result.err;
    return result.out;
  }
  std::string expected() {
    folder.write("expected.obj", pyramid_samples().front().bytes);
    return distances("expected.obj");
  }
};

TEST_F(Formats, GiveTheDistancesOfTheObj) {
  const std::string same = expected();
  for (const Sample& sample : surface_samples()) {
    folder.write(sample.file, sample.bytes);
    EXPECT_EQ(distances(sample.file), same) << sample.name;
    const auto info = json({"info", sample.file, "--json", "-"});
    EXPECT_FALSE(info["model"].contains("domain")) << sample.name << ": triangles";
  }
}

TEST_F(Formats, AreRecognisedInPipesAndStandardInput) {
  const std::string same = expected();
  for (const Sample& sample : surface_samples()) {
    const std::string file = folder.write("input", sample.bytes);
    EXPECT_EQ(distances("-", file), same) << sample.name;
    EXPECT_EQ(distances("input"), same) << sample.name << ", a file without extension";
    const std::string pipe = folder.path("pipe");
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0666), 0);
    {
      std::jthread writer([&] { std::ofstream(pipe, std::ios::binary) << sample.bytes; });
      EXPECT_EQ(distances("pipe"), same) << sample.name << ", a pipe";
    }
    ::unlink(pipe.c_str());
  }
}

TEST_F(Formats, OfVolumesAndPointsAreReadFromStandardInput) {
  run({"generate", "box-tets", "--tets", "200", "-o", "box.mesh"});
  const auto piped = run_program(folder.path("."), {"info", "-", "--json", "-"}, Stdout::kCaptured,
                                 0, folder.path("box.mesh"));
  ASSERT_EQ(piped.code, 0) << piped.err;
  EXPECT_EQ(Json::parse(piped.out)["model"]["domain"], "tets");
  const std::string points = folder.write("points.txt", "0 0 0\n1 0 0\n0 1 0\n1 1 0\n2 1 0\n");
  const auto cloud = run_program(folder.path("."), {"info", "-", "--format", "xyz", "--json", "-"},
                                 Stdout::kCaptured, 0, points);
  ASSERT_EQ(cloud.code, 0) << cloud.err;
  EXPECT_EQ(Json::parse(cloud.out)["model"]["domain"], "points");
}

TEST_F(Formats, ThatNothingTellsAskForTheirName) {
  folder.write("model", "1 2 3\n");
  expect_refused({"info", "model"}, "neither its name nor its first bytes say what it is");
  expect_refused({"info", "model"}, "say its format with --format");
  expect_refused({"info", "model", "--format", "blend"}, "there are obj, ply");
}

TEST_F(Formats, OfFramesMayBePacked) {
  folder.write("f_0.obj.gz", gzipped(pyramid_samples().front().bytes));
  folder.write("f_1.obj.gz", gzipped(pyramid_samples().front().bytes));
  run({"solve", "f_0.obj.gz", "--sequence", "f_%d.obj.gz", "-s", "4", "-o", "rows.npy", "--quiet"});
  EXPECT_EQ(bytes_of(folder.path("rows.npy")).size(), 128 + 2 * 5 * sizeof(double));
}

TEST_F(Formats, AreAllInTheHelp) {
  const std::string help = run({"solve", "--help"}).out;
  for (const io::ModelFormat& format : io::kModelFormats) {
    EXPECT_NE(help.find("." + std::string(format.name)), std::string::npos) << format.name;
  }
}

}  // namespace
}  // namespace geotherm::test
