// SPDX-License-Identifier: MIT
// The share of a binary .ply that one of several ranks reads.
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "solver/distributed/mesh_part.h"
#include "tests/mesh/mesh_files.h"

namespace geotherm::test {
namespace {

const std::string kPlyStart = "ply\nformat binary_little_endian 1.0\n";
const std::string kPlyPlaces = "property float x\nproperty float y\nproperty float z\n";
const std::string kPlyFaces =
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n";

/// One face with the corners 0, 1 and 2.
const std::string kPlyFace("\3\0\0\0\0\1\0\0\0\2\0\0\0", 13);

TEST(PlySlices, LackTheVerticesThatTheHeaderHasNoneOf) {
  const TemporaryDirectory folder;
  const std::string path =
      folder.write("a.ply", kPlyStart + "element vertex 0\n" + kPlyPlaces +
                                "property list uchar int more\n" + kPlyFaces + kPlyFace);
  const auto slice = read_ply_slice(path, 0, 1);
  ASSERT_FALSE(slice);
  EXPECT_EQ(sentence(slice.error()),
            path + ": vertex 0 is used, but the file has 0 vertices (0 to -1) in face 1 of 1");
}

TEST(PlySlices, EndWhereAnElementThatIsNotNeededIsLongerThanTheFile) {
  const TemporaryDirectory folder;
  const std::string path = folder.write(
      "a.ply",
      kPlyStart + "element tag 999999999999999999\nproperty double a\nproperty double b\n" +
          "element vertex 3\n" + kPlyPlaces + kPlyFaces + std::string(36, '\0') + kPlyFace);
  const auto slice = read_ply_slice(path, 0, 1);
  ASSERT_FALSE(slice);
  EXPECT_EQ(sentence(slice.error()),
            path +
                ": the file ends: 999999999999999999 of element \"tag\" take 16 bytes each, and "
                "49 bytes follow; was it cut short? Faces must be triangles");
}

TEST(PlySlices, GoPastElementsThatAreNotNeeded) {
  const TemporaryDirectory folder;
  const std::string path =
      folder.write("a.ply", kPlyStart + "element tag 2\nproperty double a\n" +
                                "element vertex 3\n" + kPlyPlaces + kPlyFaces +
                                std::string(16, '\1') + std::string(36, '\0') + kPlyFace);
  const auto slice = read_ply_slice(path, 0, 1);
  ASSERT_TRUE(slice) << sentence(slice.error());
  EXPECT_EQ(slice->positions, std::vector<Vec3>(3, Vec3::Zero()));
  EXPECT_EQ(slice->corners.front(), (std::array<GlobalIndex, 3>{0, 1, 2}));
}

}  // namespace
}  // namespace geotherm::test
