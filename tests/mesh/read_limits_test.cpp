// SPDX-License-Identifier: MIT
// Files that are large in one way only: lines, numbers and counts without measure.
#include <gtest/gtest.h>

#include "tests/mesh/mesh_files.h"

namespace geotherm::test {
namespace {

constexpr std::size_t kMany = 200000;

std::string repeated(const std::string& text, std::size_t count) {
  std::string out;
  out.reserve(text.size() * count);
  for (std::size_t i = 0; i < count; ++i) out += text;
  return out;
}

TEST(LongLine, HoldsAFaceOfAnyNumberOfCorners) {
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  const auto file = read_bytes("a.obj", vertices + "f" + repeated(" 1 2 3", kMany) + "\n");
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_EQ(file->mesh.face_count(), static_cast<Index>(3 * kMany - 2));
  EXPECT_EQ(file->polygons, 1);
}

TEST(LongLine, HoldsCommentsNamesAndNumbers) {
  const std::string many(kMany, '3');
  const std::string text = "#" + many + "\no " + many + "\nv 0." + many +
                           " 0 0\nv 1 0 0\nv 0 1 0\n" + "f 1 \\\n" + repeated("\\\n", kMany) +
                           "2 3\n";
  const auto file = read_bytes("a.obj", text);
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_EQ(file->mesh.positions()[0].x(), 1.0 / 3);
}

TEST(LongLine, IsQuotedShortWhenItCannotBeRead) {
  constexpr std::size_t kLongest = 400;  // with the path
  const std::string many(kMany, 'x');
  for (const auto& [name, text] :
       {std::pair<const char*, std::string>{"a.obj", "v 0 0 " + many + "\n"},
        {"a.off", "OFF 3 1 0\n0 0 " + many},
        {"a.ply", "ply\nformat " + many + "\n"},
        {"a.ply", "ply\nformat ascii 1.0\nelement " + many + " 1\nproperty float x\n"},
        {"a.stl", "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 " + many}}) {
    const auto file = read_bytes(name, text);
    ASSERT_FALSE(file) << name;
    EXPECT_LT(file.error().message.size(), kLongest) << name;
  }
}

TEST(HugeCount, IsHeldAgainstTheFileBeforeMemoryIsAskedFor) {
  for (const char* const count :
       {"2147483647", "2147483648", "4294967296", "9223372036854775807", "99999999999999999999"}) {
    const std::string n = count;
    for (const auto& [name, text] :
         {std::pair<const char*, std::string>{"a.off", "OFF " + n + " 1 0\n0 0 0\n"},
          {"a.off", "OFF 3 " + n + " 0\n0 0 0 1 0 0 0 1 0 3 0 1 2\n"},
          {"a.off", "OFF 3 1 0\n0 0 0 1 0 0 0 1 0 " + n + " 0 1 2\n"},
          {"a.ply", "ply\nformat ascii 1.0\nelement vertex " + n +
                        "\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
                        "property list int int vertex_indices\nend_header\n0 0 0\n"}}) {
      const auto file = read_bytes(name, text);
      ASSERT_FALSE(file) << text;
      EXPECT_EQ(file.error().code, ErrorCode::kBadFile) << text;
    }
  }
}

}  // namespace
}  // namespace geotherm::test
