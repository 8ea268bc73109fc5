// SPDX-License-Identifier: MIT
// Files that other people made, many of them to break readers: an answer or one clear error.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "tests/app/program.h"
#include "tests/mesh/mesh_files.h"

namespace geotherm::test {
namespace {

/// Seconds; the largest of the files takes one on a calm machine.
constexpr unsigned kHang = 20;

/// The files in a folder and below it that the program should read, sorted.
std::vector<std::string> model_files(const std::string& folder) {
  constexpr std::array kFormats = {".obj", ".ply", ".off", ".stl", ".glb", ".gltf", ".3mf", ".dae"};
  std::vector<std::string> out;
  std::error_code error;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder, error)) {
    std::string format = entry.path().extension().string();
    std::ranges::transform(format, format.begin(), [](unsigned char c) { return std::tolower(c); });
    if (std::ranges::find(kFormats, format) == kFormats.end()) continue;
    if (entry.is_regular_file()) out.push_back(entry.path().string());
  }
  std::ranges::sort(out);
  return out;
}

/// Every line but the first is `vertex,distance`, a distance a number or inf, and some are 0.
void expect_distances(const std::string& csv) {
  int zeros = 0;
  for (std::size_t line = csv.find('\n'); line + 1 < csv.size(); line = csv.find('\n', line + 1)) {
    const std::size_t comma = csv.find(',', line);
    ASSERT_NE(comma, std::string::npos);
    const double d = std::strtod(csv.c_str() + comma + 1, nullptr);
    ASSERT_GE(d, 0) << csv.substr(line, 60);  // nor for what is no number
    zeros += d == 0 ? 1 : 0;
  }
  EXPECT_GE(zeros, 1);
}

/// Distances from a vertex in a face, or one line that says why there are none.
void expect_answer_or_error(const std::string& file) {
  SCOPED_TRACE(file);
  const TemporaryDirectory folder;
  const ProgramRun run = run_program(
      folder.path("."), {"solve", file, "-s", "random:1", "-o", "d.csv", "--quiet"}, {}, kHang);
  if (run.code == 0) {
    EXPECT_EQ(run.err.find("error"), std::string::npos) << run.err;
    expect_distances(bytes_of(folder.path("d.csv")));
    return;
  }
  EXPECT_EQ(run.code, 1) << run.err;
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(run.err.rfind("geotherm: error: ", 0), 0U) << run.err;
  EXPECT_EQ(std::ranges::count(run.err, '\n'), 1) << run.err;
  EXPECT_TRUE(folder.names().empty()) << "half of an answer";
}

TEST(ModelFiles, OfAssimpsTestsAreAnsweredOrRefused) {
  const auto files = model_files("/usr/share/assimp");
  if (files.empty()) {
    const char* const required = std::getenv("GEOTHERM_REQUIRE_VULKAN");
    ASSERT_FALSE(required && std::string(required) == "1")
        << "the package assimp-testmodels is missing; scripts/setup.sh --dev installs it";
    GTEST_SKIP() << "the package assimp-testmodels is not installed";
  }
  for (const std::string& file : files) expect_answer_or_error(file);
}

TEST(ModelFiles, OfScannedMeshesAreAnsweredSlowly) {
  const char* const folder = std::getenv("GEOTHERM_TEST_MESHES");
  if (folder == nullptr) GTEST_SKIP() << "GEOTHERM_TEST_MESHES names no folder with meshes";
  const auto files = model_files(folder);
  EXPECT_FALSE(files.empty()) << folder;
  for (const std::string& file : files) expect_answer_or_error(file);
}

}  // namespace
}  // namespace geotherm::test
