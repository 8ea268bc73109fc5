// SPDX-License-Identifier: MIT
#include "geotherm/io.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <charconv>
#include <random>

#include "tests/mesh/mesh_files.h"

namespace geotherm::test {
namespace {

std::vector<Vec3> positions_of(const MeshFile& file) {
  return {file.mesh.positions().begin(), file.mesh.positions().end()};
}

std::vector<Face> faces_of(const MeshFile& file) {
  return {file.mesh.faces().begin(), file.mesh.faces().end()};
}

class EveryFormat : public testing::TestWithParam<Sample> {
 protected:
  static void expect_pyramid(const std::string& bytes);
};

void EveryFormat::expect_pyramid(const std::string& bytes) {
  const Result<MeshFile> file = read_bytes(GetParam().file, bytes);
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_EQ(file->notes, std::vector<std::string>());
  if (GetParam().file == "a.stl") {  // has triangles only; numbered by first appearance: 0 1 4 2 3
    const std::vector<Vec3> p = pyramid_positions();
    EXPECT_EQ(positions_of(*file), (std::vector<Vec3>{p[0], p[1], p[4], p[2], p[3]}));
    EXPECT_EQ(
        faces_of(*file),
        (std::vector<Face>{{0, 1, 2}, {1, 3, 2}, {3, 4, 2}, {4, 0, 2}, {4, 3, 1}, {4, 1, 0}}));
    EXPECT_EQ(file->welded, 13);
  } else {
    EXPECT_EQ(positions_of(*file), pyramid_positions());
    EXPECT_EQ(faces_of(*file), pyramid_faces());
    EXPECT_EQ(file->polygons, 1);
    EXPECT_EQ(file->welded, 0);
  }
}

TEST_P(EveryFormat, gives_the_same_mesh) { expect_pyramid(GetParam().bytes); }

TEST_P(EveryFormat, of_text_gives_the_same_mesh_behind_a_mark_of_utf8_and_with_cr_alone) {
  std::string text = GetParam().bytes;
  const auto is_text = [](char c) { return c == '\n' || (c >= ' ' && c <= '~'); };
  if (!std::ranges::all_of(text, is_text)) return;
  expect_pyramid("\xef\xbb\xbf" + text);
  std::ranges::replace(text, '\n', '\r');
  expect_pyramid(text);
  expect_pyramid("\xef\xbb\xbf" + text);
}

/// However far its header goes: where CR stood in the numbers, others would stand.
TEST(BinaryFile, BehindAHeaderOfCrAloneIsRefused) {
  for (const std::size_t length : {0U, 5000U}) {
    std::string header =
        "ply\rformat binary_little_endian 1.0\rcomment " + std::string(length, 'c') +
        "\relement vertex 3\rproperty float x\rproperty float y\rproperty float z\r"
        "element face 1\rproperty list uchar int vertex_indices\rend_header\r";
    const std::string numbers("\r\0\0\x3f\0\0\0\0\0\0\0\0", 12);
    for (int vertex = 0; vertex < 3; ++vertex) header += numbers;
    header += std::string("\3\0\0\0\0\1\0\0\0\2\0\0\0", 13);
    EXPECT_FALSE(read_bytes("a.ply", header)) << length;
  }
}

INSTANTIATE_TEST_SUITE_P(Samples, EveryFormat, testing::ValuesIn(pyramid_samples()),
                         [](const auto& test) { return test.param.name; });

/// A mesh whose coordinates need all digits, with vertices that no face uses.
TriangleMesh jagged_mesh(int vertex_count, int face_count) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> exponent(-30, 30);
  std::uniform_int_distribution<Index> vertex(0, vertex_count - 1);
  std::vector<Vec3> positions(static_cast<std::size_t>(vertex_count));
  for (Vec3& p : positions) p = Vec3::NullaryExpr([&] { return std::pow(10, exponent(random)); });
  positions.front() = {-0.0, 5e-324, 1.7976931348623157e308};
  std::vector<Face> faces(static_cast<std::size_t>(face_count));
  for (Face& face : faces) face = {vertex(random), vertex(random), vertex(random)};
  return *TriangleMesh::build(positions, faces);
}

class LosslessFormat : public testing::TestWithParam<const char*> {};

TEST_P(LosslessFormat, reads_back_what_was_written_bit_by_bit) {
  const TemporaryDirectory directory;
  const std::string path = directory.path(std::string("a.") + GetParam());
  const TriangleMesh mesh = jagged_mesh(1000, 1500);
  ASSERT_TRUE(write_mesh(path, mesh));
  const Result<MeshFile> file = read_mesh(path);
  ASSERT_TRUE(file) << file.error().message;
  ASSERT_EQ(file->mesh.vertex_count(), mesh.vertex_count());
  for (std::size_t v = 0; v < mesh.positions().size(); ++v) {
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(std::bit_cast<std::uint64_t>(file->mesh.positions()[v][axis]),
                std::bit_cast<std::uint64_t>(mesh.positions()[v][axis]))
          << "vertex " << v;
    }
  }
  EXPECT_TRUE(std::ranges::equal(file->mesh.faces(), mesh.faces()));
}

INSTANTIATE_TEST_SUITE_P(Formats, LosslessFormat, testing::Values("obj", "off", "ply"));

TEST(ReadMesh, stl_reads_back_its_own_writer_within_float_precision) {
  const TemporaryDirectory directory;
  const TriangleMesh mesh = *TriangleMesh::build(
      {{0, 0, 0}, {1. / 3, 0, 0}, {0, 0.7, 0}, {9, 9, 9}, {0.1, 0.1, 1}}, {{4, 0, 1}, {0, 2, 1}});
  ASSERT_TRUE(write_mesh(directory.path("a.stl"), mesh));
  const Result<MeshFile> file = read_mesh(directory.path("a.stl"));
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_EQ(faces_of(*file), (std::vector<Face>{{0, 1, 2}, {1, 3, 2}}));
  EXPECT_EQ(file->mesh.positions()[2].x(), double{1.f / 3});
}

TEST(ReadMesh, a_long_obj_keeps_its_order_and_its_relative_indices) {
  // Longer than any part that may be read on its own; every third face counts backwards.
  const TriangleMesh mesh = jagged_mesh(60000, 90000);
  std::string text;
  const auto append = [&text](auto value) {
    char digits[32];
    text += ' ';
    text.append(digits, std::to_chars(digits, digits + 32, value).ptr);
  };
  for (std::size_t v = 0; v < 60000; ++v) {
    text += v % 2 == 0 ? "v \\\n" : "v";
    for (const double x : mesh.positions()[v]) append(x);
    text += '\n';
    if (v < 3 || v % 2 == 0) continue;
    text += "f -1 -2 -3";
    append(v - 2);
    text += '\n';
  }
  const Result<MeshFile> file = read_bytes("a.obj", text);
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_TRUE(std::ranges::equal(file->mesh.positions(), mesh.positions()));
  ASSERT_EQ(file->polygons, 29999);
  std::size_t wrong = 0;
  for (std::size_t quad = 0; quad < 29999; ++quad) {
    const auto v = static_cast<Index>(2 * quad + 3);
    std::vector<Index> corners;
    for (const Face& f : file->mesh.faces().subspan(2 * quad, 2)) {
      corners.insert(corners.end(), f.begin(), f.end());
    }
    if (std::ranges::max(corners) != v || std::ranges::min(corners) != v - 3) ++wrong;
  }
  EXPECT_EQ(wrong, 0u);
}

TEST(ReadMesh, coordinates_are_the_nearest_doubles) {
  std::mt19937_64 random(11);
  std::string text;
  std::vector<double> expected;
  const auto add = [&](const std::string& number) {
    double value = 0;
    std::from_chars(number.data() + (number[0] == '+'), number.data() + number.size(), value);
    expected.push_back(value);
    text += (expected.size() % 3 == 1 ? "\nv " : " ") + number;
  };
  for (const char* const number :
       {"9007199254740993", "9007199254740993.0", "0.9007199254740993", "-.5", "+5.", "1E+2",
        "8.5e-3", "123456789012345678901234567890", "0.000000000000000000000000000012345678901",
        "1.00000000000000011102230246251565404236316680908203125", "2.2250738585072011e-308"}) {
    add(number);
  }
  for (int i = 0; i < 30000; ++i) {
    std::string digits = std::to_string(random() >> (random() % 64));
    const std::size_t point = random() % (digits.size() + 1);
    digits.insert(point, point == 0 ? "0." : ".");
    if (random() % 3 == 0) {
      digits += 'e';
      digits += std::to_string(static_cast<int>(random() % 60) - 30);
    }
    if (random() % 2 == 0) digits.insert(digits.begin(), '-');
    add(digits);
  }
  while (expected.size() % 3 != 0) add("0");
  const Result<MeshFile> file = read_bytes("a.obj", text + "\nf 1 2 3\n");
  ASSERT_TRUE(file) << file.error().message;
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (file->mesh.positions()[i / 3][static_cast<Eigen::Index>(i % 3)] != expected[i]) ++wrong;
  }
  EXPECT_EQ(wrong, 0u);
}

TEST(ReadMesh, numbers_too_small_for_a_double_are_zero) {
  const Result<MeshFile> file =
      read_bytes("a.obj", "v 1e-400 -0.1e-99999999999999999999 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_EQ(file->mesh.positions()[0], Vec3(0, 0, 0));
}

/// The sum of the areas of the triangles, and of the part of it that faces up.
std::pair<double, double> areas(const TriangleMesh& mesh) {
  double sum = 0;
  double up = 0;
  for (const Face& f : mesh.faces()) {
    const auto at = [&](std::size_t k) { return mesh.positions()[static_cast<std::size_t>(f[k])]; };
    const Vec3 area = (at(1) - at(0)).cross(at(2) - at(0)) / 2;
    sum += area.norm();
    up += area.z();
  }
  return {sum, up};
}

struct FlatPolygon {
  const char* name;
  const char* obj;
  int triangles;
  double area;
};

class ConcavePolygon : public testing::TestWithParam<FlatPolygon> {};

TEST_P(ConcavePolygon, is_covered_once_by_its_triangles) {
  const Result<MeshFile> file = read_bytes("a.obj", GetParam().obj);
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_EQ(file->polygons, 1);
  EXPECT_EQ(file->mesh.face_count(), GetParam().triangles);
  const auto [sum, up] = areas(file->mesh);
  EXPECT_DOUBLE_EQ(sum, GetParam().area);
  EXPECT_DOUBLE_EQ(up, GetParam().area);
}

INSTANTIATE_TEST_SUITE_P(
    Shapes, ConcavePolygon,
    testing::Values(
        FlatPolygon{"arrow", "v 0 0 0\nv 4 4 0\nv 0 1 0\nv -4 4 0\nf 2 3 4 1\n", 2, 4},
        FlatPolygon{"arrow_from_its_tip", "v 0 0 0\nv 4 4 0\nv 0 1 0\nv -4 4 0\nf 1 2 3 4\n", 2, 4},
        FlatPolygon{"letter_l",
                    "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 3 0\nv 0 3 0\nf 2 3 4 5 6 1\n", 4, 4},
        FlatPolygon{"comb",
                    "v 0 0 0\nv 5 0 0\nv 5 3 0\nv 4 3 0\nv 4 1 0\nv 3 1 0\nv 3 3 0\nv 2 3 0\n"
                    "v 2 1 0\nv 1 1 0\nv 1 3 0\nv 0 3 0\nf 1 2 3 4 5 6 7 8 9 10 11 12\n",
                    10, 11},
        FlatPolygon{"straight_corner", "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 1 1 0\nf 1 2 3 4\n", 2, 1}),
    [](const auto& test) { return test.param.name; });

TEST(ReadMesh, stl_corners_at_plus_and_minus_zero_are_one_vertex) {
  const Result<MeshFile> file = read_bytes(
      "a.stl",
      "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
      "endfacet\nendsolid\nsolid two\nFACET normal 0 0 1\nOUTER LOOP\nVERTEX -0 0 -0.0\n"
      "VERTEX 0 1 0\nVERTEX -1 0 0\nENDLOOP\nENDFACET\nENDSOLID\n");
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_EQ(faces_of(*file), (std::vector<Face>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(file->welded, 2);
}

TEST(ReadMesh, edges_among_the_faces_are_left_out_with_a_note) {
  const std::string points = "0 0 0\n1 0 0\n0 1 0\n", faces = "2 0 1\n3 0 1 2\n1 0\n";
  for (const auto& [name, bytes] : {
           std::pair("a.off", "OFF\n3 3 0\n" + points + faces),
           std::pair("a.ply",
                     "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                     "property float z\nelement face 3\nproperty list uchar int vertex_indices\n"
                     "end_header\n" +
                         points + faces),
           std::pair("a.obj", std::string("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\nf 1 2 3\nf -3\n")),
           std::pair("a.vtk",
                     "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nPOINTS 3 "
                     "float\n" +
                         points + "POLYGONS 3 9\n" + faces),
       }) {
    const Result<MeshFile> file = read_bytes(name, bytes);
    ASSERT_TRUE(file) << file.error().message;
    EXPECT_EQ(faces_of(*file), (std::vector<Face>{{0, 1, 2}})) << name;
    EXPECT_EQ(file->notes,
              std::vector<std::string>{"2 faces with fewer than 3 corners were left out"})
        << name;
  }
}

TEST(ReadMesh, bytes_behind_the_mesh_are_ignored_with_a_note) {
  for (const Sample& sample : pyramid_samples()) {
    if (sample.name != "ply_ascii" && sample.name != "ply_little_endian" &&
        sample.name != "stl_binary" && sample.name != "off") {
      continue;
    }
    const Result<MeshFile> file = read_bytes(sample.file, sample.bytes + "more");
    ASSERT_TRUE(file) << file.error().message;
    EXPECT_EQ(file->mesh.face_count(), 6) << sample.name;
    EXPECT_EQ(file->notes.size(), 1u) << sample.name;
  }
}

}  // namespace
}  // namespace geotherm::test
