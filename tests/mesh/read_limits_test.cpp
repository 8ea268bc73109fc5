// SPDX-License-Identifier: MIT
// Files that are large in one way only: lines, numbers and counts without measure.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

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
  constexpr int kCorners = 40000;  // of a convex polygon
  std::string text, face = "f";
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2 * std::numbers::pi * i / kCorners;
    text += "v " + std::to_string(1e6 * std::cos(angle)) + ' ' +
            std::to_string(1e6 * std::sin(angle)) + " 0\n";
    face += ' ' + std::to_string(i + 1);
  }
  const auto file = read_bytes("a.obj", text + face + "\n");
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_EQ(file->mesh.face_count(), Index{kCorners - 2});
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
    EXPECT_LT(sentence(file.error()).size(), kLongest) << name;
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
