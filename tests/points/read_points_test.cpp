// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "tests/points/point_samples.h"

namespace geotherm::test {
namespace {

/// Numbers that files hold in 32 bits are rounded; all others of the samples are exact.
constexpr double kRounded = 1e-7;

class PointReader : public testing::TestWithParam<Sample> {};

TEST_P(PointReader, FindsPlacesAndNormals) {
  const auto file = read_point_bytes(GetParam().file, GetParam().bytes);
  ASSERT_TRUE(file) << sentence(file.error());
  ASSERT_EQ(file->points.point_count(), 5);
  ASSERT_EQ(file->points.normals().size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(file->points.positions()[i], sample_places()[i]) << i;
    EXPECT_LT((file->points.normals()[i] - sample_normals()[i]).norm(), kRounded) << i;
  }
}

TEST_P(PointReader, SaysThatItIsAPointFile) {
  const TemporaryDirectory directory;
  const std::string path = directory.write(GetParam().file, GetParam().bytes);
  const auto is_one = is_point_file(*ModelInput::open(path));
  ASSERT_TRUE(is_one);
  EXPECT_TRUE(*is_one);
}

TEST_P(PointReader, GivesPointsOrOneLineOfWhyNotForDamagedFiles) {
  constexpr int kInputs = 200;  // of each of ten samples
  const TemporaryDirectory directory;
  std::mt19937_64 random(20261);
  int good = 0;
  for (int i = 0; i < kInputs; ++i) {
    std::string bytes = GetParam().bytes;
    for (std::size_t k = 1 + random() % 4; k > 0; --k) damage(bytes, random);
    const std::string path = directory.write(GetParam().file, bytes);
    const auto input = ModelInput::open(path);
    ASSERT_TRUE(bytes.empty() || (input && is_point_file(*input)));
    const auto file = read_points(path);
    if (file) {
      ++good;
      for (const Vec3& p : file->points.positions()) ASSERT_TRUE(p.allFinite());
      continue;
    }
    const std::string message = sentence(file.error());
    ASSERT_TRUE(message.starts_with(path + ": ")) << message;
    ASSERT_LT(message.size(), path.size() + 250) << message;
    for (const char c : message) ASSERT_TRUE(c >= ' ' && c < 0x7f) << message;
  }
  EXPECT_LT(good, kInputs);
}

INSTANTIATE_TEST_SUITE_P(Samples, PointReader, testing::ValuesIn(point_samples()),
                         [](const auto& test) { return test.param.name; });

TEST(PointReaders, IgnoreColoursAndIntensities) {
  const auto file = read_point_bytes("a.xyz", "1 2 3 255 0 10\n4 5 6 0 0 1\n");
  ASSERT_TRUE(file);
  EXPECT_TRUE(file->points.normals().empty());
  ASSERT_EQ(file->notes.size(), 1U);
  const auto pts = read_point_bytes("a.pts", "2\n1 2 3\n4 5 6 -20 1 2 3\n1\n7 8 9 0.5\n");
  ASSERT_TRUE(pts) << sentence(pts.error());
  ASSERT_EQ(pts->points.point_count(), 3);
  EXPECT_EQ(pts->points.positions()[2], Vec3(7, 8, 9));
}

TEST(PointReaders, LeaveOutPointsThatAPcdFileHasNoPlaceFor) {
  const auto file =
      read_point_bytes("a.pcd",
                       "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 3\nHEIGHT 1\nDATA ascii\n"
                       "0 0 0\nnan nan nan\n1 0 0\n");
  ASSERT_TRUE(file) << sentence(file.error());
  EXPECT_EQ(file->points.point_count(), 2);
  ASSERT_EQ(file->notes.size(), 1U);
  EXPECT_TRUE(file->notes[0].starts_with("1 point without")) << file->notes[0];
}

TEST(PointReaders, ReadTheVerticesOfAMeshAndSayThatItIsNoPointFile) {
  for (const Sample& sample : pyramid_samples()) {
    if (sample.file != "a.ply") continue;
    const TemporaryDirectory directory;
    const std::string path = directory.write(sample.file, sample.bytes);
    const auto is_one = is_point_file(*ModelInput::open(path));
    ASSERT_TRUE(is_one);
    EXPECT_FALSE(*is_one) << sample.name;
    const auto file = read_points(path);
    ASSERT_TRUE(file) << sentence(file.error());
    EXPECT_EQ(file->points.point_count(), 5);
    EXPECT_EQ(file->notes.size(), 1U);
  }
}

TEST(PointReaders, UnpackLongRepetitions) {
  // 1,000 equal points make copies of the greatest length, and such as reach into themselves.
  std::string columns;
  for (int axis = 0; axis < 3; ++axis) {
    for (int i = 0; i < 1000; ++i) columns += bytes_of_number(1.5f + static_cast<float>(axis));
  }
  const std::string packed = pack_lzf(columns);
  ASSERT_LT(packed.size(), columns.size() / 50);
  const auto file = read_point_bytes(
      "a.pcd", "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nPOINTS 1000\nDATA binary_compressed\n" +
                   bytes_of_number(static_cast<std::uint32_t>(packed.size())) +
                   bytes_of_number(static_cast<std::uint32_t>(columns.size())) + packed);
  ASSERT_TRUE(file) << sentence(file.error());
  EXPECT_EQ(file->points.positions()[999], Vec3(1.5, 2.5, 3.5));
}

/// A file that cannot be read, and what is said about it.
struct BadPoints {
  std::string name, file, bytes, message;
};

class BadPointFile : public testing::TestWithParam<BadPoints> {};

TEST_P(BadPointFile, IsRefusedInOneLine) {
  const TemporaryDirectory directory;
  const std::string path = directory.write(GetParam().file, GetParam().bytes);
  const auto file = read_points(path);
  ASSERT_FALSE(file);
  EXPECT_EQ(sentence(file.error()), path + ": " + GetParam().message);
}

std::vector<BadPoints> bad_point_files() {
  const std::string fields = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\n";
  return {
      {"xyz_two", "a.xyz", "0 0 0\n1 2\n", "line 2: a point has 2 coordinates instead of 3"},
      {"xyz_word", "a.xyz", "0 0 0\n1 two 3\n",
       "line 2: \"two\" is not a number (a point needs 3)"},
      {"xyz_nan", "a.xyz", "0 nan 0\n", "line 1: the coordinate \"nan\" is not finite"},
      {"xyz_nothing", "a.xyz", "# none\n", "the point cloud has no points"},
      {"pts_no_count", "a.pts", "0 0 0\n",
       "line 1: a PTS file starts with a line that holds the number of its points alone"},
      {"pts_huge", "a.pts", "99999999999\n0 0 0\n",
       "line 1: the line announces 99999999999 points, but only 7 bytes follow"},
      {"pts_few", "a.pts", "2\n0 0 0 1 2 3\n", "line 2: the file ends after 1 of 2 points"},
      {"pts_many", "a.pts", "1\n0 0 0\n1 1 1\n", "line 3: more points follow than were announced"},
      {"ply_no_x", "a.ply",
       "ply\nformat ascii 1.0\nelement vertex 1\nproperty int y\nend_header\n1\n",
       "line 5: the element \"vertex\" has no property \"x\""},
      {"ply_huge", "a.ply",
       "ply\nformat ascii 1.0\nelement vertex 999999999\nproperty int x\nproperty int y\n"
       "property int z\nend_header\n1 2 3\n",
       "byte 102: the header announces 999999999 of element \"vertex\" with at least 6 bytes each, "
       "but only 6 bytes follow"},
      {"pcd_no_data", "a.pcd", fields, "line 3: the file ends inside the header (no \"DATA\")"},
      {"pcd_no_z", "a.pcd", "FIELDS x y\nPOINTS 0\nDATA ascii\n",
       "line 3: there is no field \"z\""},
      {"pcd_huge", "a.pcd", fields + "POINTS 99999999999\nDATA binary\n00",
       "byte 66: the header announces 99999999999 points with at least 12 bytes each, but only 2 "
       "bytes follow"},
      {"pcd_grid", "a.pcd", fields + "WIDTH 2\nHEIGHT 2\nPOINTS 5\nDATA ascii\n",
       "line 7: the header announces 5 points, but its grid has 2 x 2"},
      {"pcd_cut", "a.pcd", fields + "POINTS 2\nDATA ascii\n0 0 0\n1 1 \n   \n",
       "line 9: the file ends in point 2 of 2"},
      {"pcd_type", "a.pcd", "FIELDS x y z\nTYPE F F Q\n",
       "line 2: a type is missing or unknown; there are I, U, F"},
      {"pcd_bomb", "a.pcd",
       fields + "POINTS 300000000\nDATA binary_compressed\n" + bytes_of_number(std::uint32_t{2}) +
           bytes_of_number(std::uint32_t{3600000000U}) + "ab",
       "byte 75: 2 packed bytes cannot hold 3600000000"},
      {"pcd_damaged", "a.pcd",
       fields + "POINTS 1\nDATA binary_compressed\n" + bytes_of_number(std::uint32_t{2}) +
           bytes_of_number(std::uint32_t{12}) + "\xe0\x01",
       "byte 67: the packed bytes are damaged"},
      {"extension", "a.e57", "ASTM",
       "unknown extension \".e57\" of points; there are .ply .xyz .pts .pcd"},
      {"las", "a.las", "LASF",
       "points in LAS files are not read; convert them, as by pdal translate scan.las scan.ply"},
      {"las_packed", "a.LAZ", "LASF",
       "points in LAS files are not read; convert them, as by pdal translate scan.laz scan.ply"},
      {"las_by_its_bytes", "scan", "LASF",
       "points in LAS files are not read; convert them, as by pdal translate scan.las scan.ply"},
  };
}

INSTANTIATE_TEST_SUITE_P(Files, BadPointFile, testing::ValuesIn(bad_point_files()),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace geotherm::test
