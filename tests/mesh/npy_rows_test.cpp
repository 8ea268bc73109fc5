// SPDX-License-Identifier: MIT
#include "geotherm/io.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "solver/mesh/output_file.h"
#include "tests/mesh/mesh_files.h"

namespace geotherm::test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

template <class Number>
std::vector<Number> values_after_header(const std::string& bytes) {
  const auto header = static_cast<unsigned char>(bytes[8]) +
                      256 * static_cast<unsigned char>(bytes[9]) + std::size_t{10};
  std::vector<Number> values((bytes.size() - header) / sizeof(Number));
  std::memcpy(values.data(), bytes.data() + header, bytes.size() - header);
  return values;
}

TEST(NpyRows, AreAnArrayOfTwoDimensions) {
  const TemporaryDirectory folder;
  const std::string path = folder.path("a.npy");
  auto rows = NpyRows::open(path, 2, 3, NpyType::kFloat64);
  ASSERT_TRUE(rows);
  ASSERT_TRUE(rows->append(std::vector<double>{0, 0.1, kInfinity}));
  EXPECT_FALSE(std::ranges::count(folder.names(), "a.npy")) << "before it is whole";
  ASSERT_TRUE(rows->append(std::vector<double>{1e-300, 2, 3}));
  ASSERT_TRUE(rows->finish());
  EXPECT_EQ(folder.names(), std::vector<std::string>{"a.npy"});
  const std::string bytes = bytes_of(path);
  EXPECT_EQ(bytes.size(), npy_bytes_of(2, 3, NpyType::kFloat64));
  EXPECT_EQ(bytes.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8));
  EXPECT_NE(bytes.find("{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3), }"),
            std::string::npos);
  EXPECT_EQ(values_after_header<double>(bytes),
            (std::vector<double>{0, 0.1, kInfinity, 1e-300, 2, 3}));
}

TEST(NpyRows, OfFloatsAreRoundedToNearest) {
  const TemporaryDirectory folder;
  const std::string path = folder.path("a.npy");
  auto rows = NpyRows::open(path, 1, 3, NpyType::kFloat32);
  ASSERT_TRUE(rows);
  ASSERT_TRUE(rows->append(std::vector<double>{0.1, kInfinity, 1 + 1e-9}));
  ASSERT_TRUE(rows->finish());
  const std::string bytes = bytes_of(path);
  EXPECT_NE(bytes.find("'<f4'"), std::string::npos);
  EXPECT_EQ(values_after_header<float>(bytes),
            (std::vector<float>{0.1F, std::numeric_limits<float>::infinity(), 1.0F}));
}

TEST(NpyRows, OfFloatsRefuseWhatTheyCannotHold) {
  const TemporaryDirectory folder;
  for (const double value : {1e39, 1e-40}) {
    auto rows = NpyRows::open(folder.path("a.npy"), 1, 2, NpyType::kFloat32);
    ASSERT_TRUE(rows);
    const auto written = rows->append(std::vector<double>{0, value});
    ASSERT_FALSE(written) << value;
    EXPECT_NE(sentence(written.error()).find("; write float64"), std::string::npos);
  }
  EXPECT_EQ(folder.names(), std::vector<std::string>{});
}

TEST(NpyRows, LeaveNothingWhereTheyEndEarly) {
  const TemporaryDirectory folder;
  folder.write("a.npy", "old");
  {
    auto rows = NpyRows::open(folder.path("a.npy"), 2, 1, NpyType::kFloat64);
    ASSERT_TRUE(rows);
    ASSERT_TRUE(rows->append(std::vector<double>{1}));
    EXPECT_EQ(folder.names().size(), 2U);
  }
  EXPECT_EQ(folder.names(), std::vector<std::string>{"a.npy"});
  EXPECT_EQ(bytes_of(folder.path("a.npy")), "old");
}

TEST(NpyRows, SayThatADeviceIsFull) {
  auto rows = NpyRows::open("/dev/full", 1, 1, NpyType::kFloat64);
  ASSERT_FALSE(rows);
  EXPECT_EQ(rows.error().code, ErrorCode::kBadFile);
  EXPECT_NE(sentence(rows.error()).find("No space left"), std::string::npos);
}

TEST(RoomFor, IsKnownOfFoldersAlone) {
  const TemporaryDirectory folder;
  EXPECT_GT(room_for(folder.path("a.npy")).value_or(0), 0U);
  EXPECT_FALSE(room_for("-"));
  EXPECT_FALSE(room_for("/dev/null"));
}

TEST(NpyType, ReadsBackFromItsText) {
  for (const NpyType type : {NpyType::kFloat64, NpyType::kFloat32}) {
    EXPECT_EQ(*parse<NpyType>(to_text(type)), type);
  }
  EXPECT_NE(sentence(parse<NpyType>("int").error()).find("float64, float32"), std::string::npos);
}

}  // namespace
}  // namespace geotherm::test
