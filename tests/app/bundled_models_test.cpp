// SPDX-License-Identifier: MIT
// The models that come as files: what is in them, and where the program finds them.
#include "app/session/model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "bench/models/generate.h"
#include "solver/mesh/io/format_writers.h"
#include "tests/app/program_fixture.h"
#include "tests/app/variable.h"

namespace geotherm::test {
namespace {

class BundledModelFile : public testing::TestWithParam<app::BundledModel> {};

TEST_P(BundledModelFile, IsWhatGenerateMakesAtTheUsualSize) {
  const Result<TriangleMesh> made = generate_model(GetParam().name, GetParam().faces);
  ASSERT_TRUE(made) << made.error().message;
  const Result<std::string> file = app::bundled_file(GetParam().name);
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_TRUE(bytes_of(*file) == io::ply_bytes(*made)) << "geotherm generate writes another file";

  const Result<app::Model> read = app::load_model(std::string(GetParam().name));
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_TRUE(std::ranges::equal(read->mesh->positions(), made->positions()));
  EXPECT_TRUE(std::ranges::equal(read->mesh->faces(), made->faces()));
  EXPECT_EQ(read->name, GetParam().name);
  EXPECT_EQ(read->path, "");
  EXPECT_TRUE(read->notes.empty());
}

INSTANTIATE_TEST_SUITE_P(All, BundledModelFile, testing::ValuesIn(app::bundled_models()),
                         [](const auto& tested) { return std::string(tested.param.name); });

TEST(BundledModelFiles, TakeLessThan12MegabytesTogether) {
  std::uintmax_t bytes = 0;
  for (const app::BundledModel& model : app::bundled_models()) {
    const Result<std::string> file = app::bundled_file(model.name);
    ASSERT_TRUE(file) << file.error().message;
    bytes += std::filesystem::file_size(*file);
  }
  EXPECT_LT(bytes, 12'000'000U);
}

TEST_F(Program, ReadsBundledModelsFromTheFolderThatIsNamed) {
  run({"generate", "cube", "--faces", "600", "-o", "bunny.ply"});
  const Variable models("GEOTHERM_MODELS", folder.path(".").c_str());
  const auto box = [&](const char* model) {
    return json({"info", model, "--json", "-"})["model"]["box_max"];
  };
  EXPECT_EQ(box("bunny"), box("./bunny.ply"));
}

TEST_F(Program, SaysInOneLineThatABundledModelHasNoFile) {
  const Variable models("GEOTHERM_MODELS", folder.path(".").c_str());
  for (const char* command : {"info", "view", "compare"}) {
    const ProgramRun result = run_program(folder.path("."), {command, "bunny"});
    EXPECT_EQ(result.code, 1) << command;
    EXPECT_EQ(result.out, "");
    EXPECT_TRUE(
        result.err.starts_with("geotherm: error: the bundled model bunny has no file "
                               "bunny.ply in " +
                               folder.path(".") + "; "))
        << result.err;
    EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
  }
}

}  // namespace
}  // namespace geotherm::test
