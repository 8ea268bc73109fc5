// SPDX-License-Identifier: MIT
#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <thread>

#include "solver/mesh/io/formats.h"
#include "tests/mesh/mesh_files.h"

namespace geotherm::test {
namespace {

Result<MeshFile> read_stream(int descriptor, const std::string& name, std::string_view format) {
  const auto input = ModelInput::stream(descriptor, name, format);
  return input ? read_mesh(*input) : input.error();
}

/// Reads what comes out of a pipe into which `bytes` are written.
Result<MeshFile> read_from_pipe(const std::string& bytes, std::string_view format) {
  int ends[2];
  if (::pipe(ends) != 0) return Error{ErrorCode::kBadFile, "no pipe"};
  std::jthread writer([&] {
    for (std::size_t at = 0; at < bytes.size();) {
      const ssize_t put = ::write(ends[1], bytes.data() + at, bytes.size() - at);
      if (put <= 0) break;
      at += static_cast<std::size_t>(put);
    }
    ::close(ends[1]);
  });
  auto file = read_stream(ends[0], "the pipe", format);
  writer.join();
  ::close(ends[0]);
  return file;
}

std::string format_of(const std::string& file) { return io::model_extension(file).substr(1); }

class StreamFormat : public testing::TestWithParam<Sample> {};

TEST_P(StreamFormat, GivesTheMeshOfTheFile) {
  const Sample& sample = GetParam();
  const auto expected = read_bytes(sample.file, sample.bytes);
  const auto file = read_from_pipe(sample.bytes, format_of(sample.file));
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_TRUE(std::ranges::equal(file->mesh.positions(), expected->mesh.positions()));
  EXPECT_TRUE(std::ranges::equal(file->mesh.faces(), expected->mesh.faces()));
}

class StreamOfNoName : public testing::TestWithParam<Sample> {};

TEST_P(StreamOfNoName, IsRecognisedByItsFirstBytes) {
  const Sample& sample = GetParam();
  const auto file = read_from_pipe(sample.bytes, "");
  ASSERT_TRUE(file) << sentence(file.error());
  EXPECT_EQ(file->mesh.face_count(), 6);
}

/// All but numbers alone, which may be anything.
std::vector<Sample> recognised_samples() {
  std::vector<Sample> samples = pyramid_samples();
  std::erase_if(samples, [](const Sample& s) { return s.name == "off_without_its_keyword"; });
  return samples;
}

INSTANTIATE_TEST_SUITE_P(Samples, StreamFormat, testing::ValuesIn(pyramid_samples()),
                         [](const auto& test) { return test.param.name; });
INSTANTIATE_TEST_SUITE_P(Samples, StreamOfNoName, testing::ValuesIn(recognised_samples()),
                         [](const auto& test) { return test.param.name; });

TEST(Stream, IsReadToItsEndHoweverLong) {
  std::string text;
  constexpr int kVertices = 120'000;  // some megabytes
  for (int i = 0; i < kVertices; ++i) text += "v " + std::to_string(i) + " 0.123456789 1\n";
  text += "f 1 2 " + std::to_string(kVertices) + "\n";
  const auto file = read_from_pipe(text, "obj");
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_EQ(file->mesh.vertex_count(), kVertices);
  EXPECT_EQ(file->mesh.faces()[0], (Face{0, 1, kVertices - 1}));
}

TEST(Stream, SaysWhatIsWrongWithIt) {
  EXPECT_EQ(sentence(read_from_pipe("", "obj").error()),
            "the pipe: there was nothing to read; check what writes to it");
  EXPECT_EQ(sentence(read_from_pipe("v 1 2\n", "obj").error()).find("the pipe: line 1"), 0U);
  EXPECT_EQ(read_from_pipe("v 1 2 3\n", "xyzw").error().code, ErrorCode::kNotAvailable);
  EXPECT_EQ(read_stream(-1, "nothing", "obj").error().code, ErrorCode::kBadFile);
}

TEST(Stream, AFormatThatIsNamedCountsMoreThanTheExtension) {
  const TemporaryDirectory directory;
  const std::string path = directory.write("a.txt", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_FALSE(read_mesh(path));
  EXPECT_TRUE(read_mesh(path, "obj"));
  EXPECT_FALSE(read_mesh(path, "off"));
}

}  // namespace
}  // namespace geotherm::test
