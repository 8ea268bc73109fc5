// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <random>

#include "geotherm/io.h"
#include "tests/mesh/mesh_files.h"

namespace geotherm::test {
namespace {

constexpr int kInputs = 500;  // for each sample; 4 to 10 samples a format
constexpr std::uint64_t kSeed = 20251;

std::size_t below(std::mt19937_64& random, std::size_t bound) { return random() % bound; }

class FuzzedReader : public testing::TestWithParam<Sample> {};

TEST_P(FuzzedReader, gives_a_mesh_or_one_line_of_why_not) {
  const TemporaryDirectory directory;
  std::mt19937_64 random(kSeed);
  int meshes = 0;
  for (int i = 0; i < kInputs; ++i) {
    std::string bytes = GetParam().bytes;
    for (std::size_t k = 1 + below(random, 4); k > 0; --k) damage(bytes, random);
    const std::string path = directory.write(GetParam().file, bytes);
    const Result<MeshFile> file = read_mesh(path);
    if (file) {
      ++meshes;
      ASSERT_GT(file->mesh.face_count(), 0);
      continue;
    }
    const std::string message = sentence(file.error());
    ASSERT_TRUE(message.starts_with(path + ": ")) << message;
    ASSERT_GT(message.size(), path.size() + 2);
    ASSERT_LT(message.size(), path.size() + 250) << message;
    for (const char c : message) ASSERT_TRUE(c >= ' ' && c < 0x7f) << message;
  }
  EXPECT_LT(meshes, kInputs);
}

INSTANTIATE_TEST_SUITE_P(Samples, FuzzedReader, testing::ValuesIn(pyramid_samples()),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace geotherm::test
