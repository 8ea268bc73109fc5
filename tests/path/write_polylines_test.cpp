// SPDX-License-Identifier: MIT
#include "geotherm/path.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/path/path_support.h"

namespace geotherm::test {
namespace {

std::string written(const std::string& extension, const TriangleMesh& mesh,
                    std::span<const Polyline> lines) {
  const std::string path = testing::TempDir() + "geotherm_lines_" +
                           testing::UnitTest::GetInstance()->current_test_info()->name() +
                           extension;
  const auto done = write_polylines(path, mesh, lines);
  EXPECT_TRUE(done) << done.error().message;
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  std::filesystem::remove(path);
  return text.str();
}

/// Two pieces in the square of two triangles, and the same as a closed line.
struct Lines {
  MeshPtr mesh = finish(plane_grid(1, 1, 1, 1));
  SurfacePath open, closed;

  Lines() {
    open.points = {vertex(0), SurfacePoint::in_face(0, {0.5, 0.5, 0}), vertex(3)};
    open.faces = {0, 0};
    open.length = length_of(*mesh, open.points);
    closed = open;
    closed.points.push_back(vertex(0));
    closed.faces.push_back(1);
    closed.closed = true;
  }
};

TEST(WritePolylines, ObjHasOneElementALine) {
  const Lines lines;
  const Polyline both[] = {{&lines.open, {}}, {&lines.closed, {}}};
  EXPECT_EQ(written(".obj", *lines.mesh, both),
            "v 0 0 0\nv 0.5 0 0\nv 1 1 0\nv 0 0 0\nv 0.5 0 0\nv 1 1 0\nl 1 2\nl 2 3\nl 4 5\nl 5 "
            "6\nl 6 4\n");
}

TEST(WritePolylines, CsvSaysFaceAndWeightsAndValueWhereThereIsOne) {
  const Lines lines;
  const Polyline plain[] = {{&lines.open, {}}};
  EXPECT_EQ(polyline_csv(*lines.mesh, plain),
            "line,point,x,y,z,face,b0,b1,b2\n0,0,0,0,0,0,1,0,0\n0,1,0.5,0,0,0,0.5,0.5,0\n"
            "0,2,1,1,0,0,0,0,1\n");
  const Polyline valued[] = {{&lines.open, 2.5}};
  const std::string text = written(".csv", *lines.mesh, valued);
  EXPECT_TRUE(text.starts_with("line,point,x,y,z,face,b0,b1,b2,value\n0,0,0,0,0,0,1,0,0,2.5\n"));
}

TEST(WritePolylines, VtpDeclaresItsArraysWhereTheyAre) {
  const Lines lines;
  const Polyline both[] = {{&lines.open, 1.0}, {&lines.closed, 2.0}};
  const std::string text = written(".vtp", *lines.mesh, both);
  EXPECT_NE(text.find("NumberOfPoints=\"6\""), text.npos);
  EXPECT_NE(text.find("NumberOfLines=\"2\""), text.npos);
  EXPECT_NE(text.find("Name=\"value\""), text.npos);
  // Points, connectivity, offsets, length, closed, value, each after its length.
  const std::size_t bytes = 6 * 24 + 7 * 8 + 2 * 8 + 2 * 8 + 2 * 4 + 2 * 8 + 6 * 8;
  const std::size_t begin = text.find("\n_") + 2;
  EXPECT_EQ(text.find("\n</AppendedData>", begin + bytes) - begin, bytes);
}

TEST(WritePolylines, OtherEndingsAreRefused) {
  EXPECT_FALSE(check_polyline_path("lines.ply"));
  EXPECT_EQ(check_polyline_path("lines").error().code, ErrorCode::kNotAvailable);
  EXPECT_TRUE(check_polyline_path("lines.OBJ"));
}

TEST(WritePolylines, ASinglePointIsAPoint) {
  const Lines lines;
  SurfacePath point;
  point.points = {vertex(2)};
  const Polyline one[] = {{&point, {}}};
  EXPECT_EQ(written(".obj", *lines.mesh, one), "v 0 1 0\np 1\n");
}

}  // namespace
}  // namespace geotherm::test
