// SPDX-License-Identifier: MIT
// A host whose locale has decimal commas reads and writes the same bytes.
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <sstream>

#include "app/cli/command_line.h"
#include "tests/app/fake_drawing.h"
#include "tests/mesh/mesh_files.h"
#include "tests/support/comma_locale.h"

namespace geotherm::test {
namespace {

using Files = std::map<std::string, std::string>;

const std::vector<std::vector<std::string>>& command_lines() {
  static const std::vector<std::vector<std::string>> kLines = {
      {"solve", "pyramid.obj", "-s", "face:0:0.25:0.25:0.5", "-m", "1.5", "-o", "a.csv", "-o",
       "a.ply", "-o", "a.vtp", "-o", "a.npy"},
      {"solve", "pyramid.obj", "-s", "xyz:0.25:0.5:1", "--time-step", "absolute:0.25", "-o",
       "b.csv"},
      {"isolines", "pyramid.obj", "-s", "0", "--spacing", "0.25", "-o", "c.obj", "-o", "c.csv"},
      {"isolines", "pyramid.obj", "-s", "0", "--count", "3", "-o", "d.svg"},
      {"path", "pyramid.obj", "--from", "0", "--to", "xyz:0.5:0.5:1", "-o", "e.csv", "--json",
       "e.json"},
      {"info", "pyramid.obj", "--json", "f.json"},
      {"generate", "terrain", "--faces", "2000", "-o", "g.off"},
      {"generate", "terrain", "--faces", "2000", "-o", "g.obj"},
  };
  return kLines;
}

/// What the commands write in a new folder, and what they print.
Files written_files(const std::string& model) {
  const TemporaryDirectory folder;
  folder.write("pyramid.obj", model);
  const std::vector<std::string> before = folder.names();
  Files files;
  FakeDrawing drawing;
  FakeWindow window;
  for (std::vector<std::string> words : command_lines()) {
    for (std::string& word : words) {
      const bool is_file = word.find('.') != word.npos && std::isalpha(word.back()) != 0;
      if (is_file && !word.starts_with("xyz")) word = folder.path(word);
    }
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    const int code = app::run_command_line(words, drawing, window);
    testing::internal::GetCapturedStdout();
    const std::string err = testing::internal::GetCapturedStderr();
    EXPECT_EQ(code, 0) << words.front() << ": " << err;
  }
  for (const std::string& name : folder.names()) {
    std::string bytes = bytes_of(folder.path(name));
    for (std::size_t at; (at = bytes.find(folder.path(""))) != bytes.npos;) {
      bytes.erase(at, folder.path("").size());
    }
    if (const std::size_t at = bytes.find("\"timing_ms\""); at != bytes.npos) {
      bytes.erase(at, bytes.find('}', at) - at);
    }
    if (std::ranges::find(before, name) == before.end()) files[name] = std::move(bytes);
  }
  return files;
}

std::vector<std::vector<Vec3>> positions_in(const std::vector<Sample>& samples) {
  std::vector<std::vector<Vec3>> all;
  for (const Sample& sample : samples) {
    const auto file = read_bytes(sample.file, sample.bytes);
    EXPECT_TRUE(file) << sample.name;
    if (file) all.emplace_back(file->mesh.positions().begin(), file->mesh.positions().end());
  }
  return all;
}

TEST(DecimalCommas, OfTheHostChangeNothingThatIsReadOrWritten) {
  const std::vector<Sample> samples = pyramid_samples();
  const std::string model = samples.front().bytes;
  const Files expected = written_files(model);
  const auto positions = positions_in(samples);
  const TemporaryDirectory folder;
  const CommaLocale locale(folder.path(""));
  if (!locale.holds()) {
    const char* const required = std::getenv("GEOTHERM_REQUIRE_VULKAN");
    ASSERT_FALSE(required && std::string(required) == "1") << "localedef makes no de_DE.UTF-8";
    GTEST_SKIP() << "localedef makes no de_DE.UTF-8; install the package locales";
  }
  std::ostringstream stream;
  stream << 0.5;
  ASSERT_EQ(stream.str(), "0,5");  // the locale does what it is for
  EXPECT_EQ(positions_in(samples), positions);
  const Files actual = written_files(model);
  ASSERT_EQ(actual.size(), expected.size());
  for (const auto& [name, bytes] : expected) {
    ASSERT_TRUE(actual.contains(name)) << name;
    EXPECT_EQ(actual.at(name), bytes) << name;
  }
}

}  // namespace
}  // namespace geotherm::test
