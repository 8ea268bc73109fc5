// SPDX-License-Identifier: MIT
#include "geotherm/io.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <iterator>
#include <sstream>

#include "solver/mesh/output_file.h"
#include "tests/mesh/mesh_files.h"

namespace geotherm::test {
namespace {

const std::vector<double> kDistances = {0, 0.1, 1. / 3, 1e300, kUnreached};

TriangleMesh pyramid_mesh() { return *TriangleMesh::build(pyramid_positions(), pyramid_faces()); }

template <class T>
std::vector<T> values_at(const std::string& bytes, std::size_t start, std::size_t count) {
  std::vector<T> values(count);
  if (start + count * sizeof(T) > bytes.size()) return {};
  std::memcpy(values.data(), bytes.data() + start, count * sizeof(T));
  return values;
}

class DistanceFile : public testing::Test {
 protected:
  std::string written(const char* name) {
    const Result<void> done = write_distances(directory.path(name), pyramid_mesh(), kDistances);
    EXPECT_TRUE(done) << done.error().message;
    return bytes_of(directory.path(name));
  }

  TemporaryDirectory directory;
};

TEST_F(DistanceFile, csv_has_one_line_per_vertex_with_digits_that_read_back) {
  EXPECT_EQ(written("a.csv"),
            "vertex,distance\n0,0\n1,0.1\n2,0.3333333333333333\n3,1e+300\n4,inf\n");
}

TEST_F(DistanceFile, npy_is_a_version_1_array_of_doubles_aligned_to_64_bytes) {
  const std::string bytes = written("a.npy");
  EXPECT_EQ(bytes.substr(0, 8), std::string("\x93NUMPY\1\0", 8));
  const std::size_t start = 10 + values_at<std::uint16_t>(bytes, 8, 1)[0];
  EXPECT_EQ(start % 64, 0u);
  EXPECT_EQ(bytes[start - 1], '\n');
  EXPECT_NE(bytes.find("{'descr': '<f8', 'fortran_order': False, 'shape': (5,), }"),
            std::string::npos);
  EXPECT_EQ(bytes.size(), start + 5 * sizeof(double));
  EXPECT_EQ(values_at<double>(bytes, start, 5), kDistances);
}

TEST_F(DistanceFile, ply_reads_back_as_the_mesh_and_holds_the_distances_as_doubles) {
  const std::string bytes = written("a.ply");
  EXPECT_NE(bytes.find("property double distance\n"), std::string::npos);
  EXPECT_NE(bytes.find("property float quality\n"), std::string::npos);
  const std::size_t start = bytes.find("end_header\n") + 11;
  const double largest = std::numeric_limits<float>::max();  // the largest distance is above it
  for (std::size_t v = 0; v < 5; ++v) {
    EXPECT_EQ(values_at<double>(bytes, start + 36 * v + 24, 1)[0], kDistances[v]);
    EXPECT_EQ(values_at<float>(bytes, start + 36 * v + 32, 1)[0],
              static_cast<float>(std::min(kDistances[v], largest)))
        << "finite for programs that make a scale of it";
  }
  const Result<MeshFile> file = read_mesh(directory.path("a.ply"));
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_TRUE(std::ranges::equal(file->mesh.positions(), pyramid_positions()));
  EXPECT_TRUE(std::ranges::equal(file->mesh.faces(), pyramid_faces()));
}

TEST_F(DistanceFile, vtp_appends_each_array_where_the_xml_says) {
  const std::string bytes = written("a.vtp");
  const std::size_t data = bytes.find("<AppendedData encoding=\"raw\">\n_") + 31;
  const auto start_of = [&](const std::string& name) {
    const std::size_t array = bytes.find("Name=\"" + name + "\"");
    const std::size_t offset = bytes.find("offset=\"", array) + 8;
    return data + std::stoul(bytes.substr(offset)) + 8;
  };
  const auto length_at = [&](std::size_t start) {
    return values_at<std::uint64_t>(bytes, start - 8, 1)[0];
  };
  EXPECT_EQ(length_at(start_of("distance")), 5 * 8u);
  EXPECT_EQ(values_at<double>(bytes, start_of("distance"), 5), kDistances);
  EXPECT_EQ(length_at(start_of("Points")), 5 * 24u);
  EXPECT_EQ(values_at<double>(bytes, start_of("Points"), 15)[14], 1.5);
  EXPECT_EQ(length_at(start_of("connectivity")), 6 * 12u);
  EXPECT_EQ(values_at<Face>(bytes, start_of("connectivity"), 6), pyramid_faces());
  EXPECT_EQ(values_at<std::int64_t>(bytes, start_of("offsets"), 6),
            (std::vector<std::int64_t>{3, 6, 9, 12, 15, 18}));
}

/// One value a vertex and one a face, of both types.
std::vector<DataField> fields() {
  using Place = DataField::Place;
  using Type = DataField::Type;
  return {{"error", Place::kVertices, Type::kFloat64, {0, -0.5, 0.25, 1e-300, kUnreached}},
          {"quality", Place::kFaces, Type::kFloat64, {1, 0.5, 0.25, 0.125, 0, 1}},
          {"edges", Place::kFaces, Type::kUint8, {0, 1, 2, 3, 0, 255}}};
}

/// Text, which other programs read with fields of faces.
TEST_F(DistanceFile, ply_holds_fields_of_vertices_and_faces_and_still_reads_back) {
  const std::string path = directory.path("f.ply");
  ASSERT_TRUE(write_distances(path, pyramid_mesh(), kDistances, {}, fields()));
  const std::string bytes = bytes_of(path);
  EXPECT_TRUE(bytes.starts_with("ply\nformat ascii 1.0\n"));
  EXPECT_NE(bytes.find("property double error\nelement face"), std::string::npos);
  EXPECT_NE(bytes.find("vertex_indices\nproperty double quality\nproperty uchar edges\nend_header"),
            std::string::npos);
  std::istringstream lines(bytes.substr(bytes.find("end_header\n") + 11));
  std::vector<std::vector<std::string>> rows;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    rows.emplace_back(std::istream_iterator<std::string>(words),
                      std::istream_iterator<std::string>());
  }
  ASSERT_EQ(rows.size(), 5U + 6U);
  EXPECT_EQ(rows[1].back(), "-0.5");
  EXPECT_EQ(std::stod(rows[3].back()), 1e-300);
  EXPECT_EQ(rows[5 + 3][4], "0.125");
  EXPECT_EQ(rows[5 + 5][5], "255");
  const Result<MeshFile> file = read_mesh(path);
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_TRUE(std::ranges::equal(file->mesh.faces(), pyramid_faces()));
}

TEST_F(DistanceFile, vtp_holds_fields_as_point_and_cell_data) {
  const std::string path = directory.path("f.vtp");
  ASSERT_TRUE(
      write_distances(path, pyramid_mesh(), kDistances, std::vector<Index>(5, 0), fields()));
  const std::string bytes = bytes_of(path);
  const std::size_t data = bytes.find("<AppendedData encoding=\"raw\">\n_") + 31;
  const auto start_of = [&](const std::string& name) {
    const std::size_t array = bytes.find("Name=\"" + name + "\"");
    return data + std::stoul(bytes.substr(bytes.find("offset=\"", array) + 8)) + 8;
  };
  const std::size_t cells = bytes.find("<CellData>");
  EXPECT_LT(bytes.find("Name=\"error\""), bytes.find("</PointData>"));
  EXPECT_LT(cells, bytes.find("Name=\"quality\""));
  EXPECT_LT(bytes.find("type=\"UInt8\" Name=\"edges\""), bytes.find("</CellData>"));
  EXPECT_EQ(values_at<double>(bytes, start_of("error"), 5), fields()[0].values);
  EXPECT_EQ(values_at<double>(bytes, start_of("quality"), 6), fields()[1].values);
  EXPECT_EQ(values_at<std::uint8_t>(bytes, start_of("edges"), 6),
            (std::vector<std::uint8_t>{0, 1, 2, 3, 0, 255}));
  EXPECT_EQ(values_at<double>(bytes, start_of("Points"), 15)[14], 1.5);
}

TEST_F(DistanceFile, csv_holds_fields_of_vertices_and_npy_none) {
  const std::vector<DataField> all = fields();
  const std::string path = directory.path("f.csv");
  ASSERT_TRUE(write_distances(path, pyramid_mesh(), kDistances, {}, std::span(all).first(1)));
  EXPECT_EQ(bytes_of(path),
            "vertex,distance,error\n0,0,0\n1,0.1,-0.5\n2,0.3333333333333333,0.25\n"
            "3,1e+300,1e-300\n4,inf,inf\n");
  for (const char* name : {"g.csv", "g.npy"}) {
    const auto refused = write_distances(directory.path(name), pyramid_mesh(), kDistances, {}, all);
    ASSERT_FALSE(refused);
    EXPECT_NE(sentence(refused.error()).find("write "), std::string::npos)
        << refused.error().message;
    EXPECT_FALSE(std::filesystem::exists(directory.path(name)));
  }
}

TEST_F(DistanceFile, obj_is_refused_with_the_formats_that_hold_values) {
  const Result<void> done = write_distances(directory.path("a.obj"), pyramid_mesh(), kDistances);
  ASSERT_FALSE(done);
  EXPECT_NE(sentence(done.error()).find("holds no value per vertex; write .ply or .vtp"),
            std::string::npos);
  EXPECT_EQ(directory.names(), std::vector<std::string>());
}

TEST_F(DistanceFile, of_an_unknown_extension_is_told_which_there_are) {
  EXPECT_EQ(sentence(check_distance_path("a.xyz").error()),
            "a.xyz: unknown extension \".xyz\"; there are .csv .npy .ply .vtp");
  EXPECT_EQ(sentence(write_mesh("a.vtp", pyramid_mesh()).error()),
            "a.vtp: unknown extension \".vtp\"; there are .obj .ply .off .stl");
  EXPECT_TRUE(check_distance_path("-"));
  EXPECT_TRUE(check_distance_path("dir.x/a.CSV"));
}

TEST_F(DistanceFile, needs_one_distance_per_vertex) {
  const Result<void> done =
      write_distances(directory.path("a.csv"), pyramid_mesh(), std::vector<double>(4));
  ASSERT_FALSE(done);
  EXPECT_NE(sentence(done.error()).find("4 distances for 5 vertices"), std::string::npos);
}

TEST_F(DistanceFile, stl_refuses_what_a_float_cannot_hold) {
  const TriangleMesh mesh = *TriangleMesh::build({{0, 0, 0}, {1e40, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  const Result<void> done = write_mesh(directory.path("a.stl"), mesh);
  ASSERT_FALSE(done);
  EXPECT_NE(sentence(done.error()).find("vertex 1 is too far away"), std::string::npos);
  EXPECT_EQ(directory.names(), std::vector<std::string>());
}

class WrittenFile : public testing::Test {
 protected:
  TemporaryDirectory directory;
};

TEST_F(WrittenFile, replaces_the_old_one_and_leaves_nothing_beside_it) {
  const std::string path = directory.write("a.txt", "old and longer");
  ::chmod(path.c_str(), 0640);
  ASSERT_TRUE(write_file(path, "new"));
  EXPECT_EQ(bytes_of(path), "new");
  EXPECT_EQ(directory.names(), std::vector<std::string>{"a.txt"});
  EXPECT_EQ(std::filesystem::status(path).permissions(), std::filesystem::perms(0640));
}

TEST_F(WrittenFile, follows_a_link_and_keeps_it) {
  const std::string path = directory.write("a.txt", "old");
  std::filesystem::create_symlink("a.txt", directory.path("link.txt"));
  ASSERT_TRUE(write_file(directory.path("link.txt"), "new"));
  EXPECT_EQ(bytes_of(path), "new");
  EXPECT_TRUE(std::filesystem::is_symlink(directory.path("link.txt")));
}

TEST_F(WrittenFile, into_a_device_leaves_the_device_in_place) {
  ASSERT_TRUE(write_file("/dev/null", "nothing"));
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST_F(WrittenFile, into_a_full_device_fails_with_the_reason) {
  const Result<void> done = write_file("/dev/full", "anything");
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().code, ErrorCode::kBadFile);
  EXPECT_NE(sentence(done.error()).find("/dev/full: cannot be written: "), std::string::npos);
}

TEST_F(WrittenFile, in_a_missing_directory_fails_with_the_path) {
  const std::string path = directory.path("none/a.txt");
  const Result<void> done = write_file(path, "x");
  ASSERT_FALSE(done);
  EXPECT_TRUE(sentence(done.error()).starts_with(path + ": cannot be written: "));
}

TEST_F(WrittenFile, onto_a_directory_fails_and_leaves_nothing) {
  std::filesystem::create_directory(directory.path("a.csv"));
  ASSERT_FALSE(write_file(directory.path("a.csv"), "x"));
  EXPECT_EQ(directory.names(), std::vector<std::string>{"a.csv"});
}

TEST_F(WrittenFile, without_permission_keeps_the_old_one) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everything";
  const std::string path = directory.write("a.txt", "old");
  ::chmod(path.c_str(), 0444);
  ASSERT_FALSE(write_file(path, "new"));
  EXPECT_EQ(bytes_of(path), "old");
}

TEST_F(WrittenFile, to_standard_output_is_what_was_given) {
  testing::internal::CaptureStdout();
  const Result<void> done = write_distances("-", pyramid_mesh(), kDistances);
  EXPECT_EQ(testing::internal::GetCapturedStdout(),
            "vertex,distance\n0,0\n1,0.1\n2,0.3333333333333333\n3,1e+300\n4,inf\n");
  EXPECT_TRUE(done);
}

}  // namespace
}  // namespace geotherm::test
