// SPDX-License-Identifier: MIT
// Files that repeat one thing: reading them takes time in proportion to their size.
#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>
#include <functional>

#include "tests/mesh/mesh_files.h"

namespace geotherm::test {
namespace {

std::string repeated(std::string_view text, int count) {
  std::string all;
  for (int i = 0; i < count; ++i) all += text;
  return all;
}

constexpr const char* kPly = "ply\nformat ascii 1.0\n";
constexpr const char* kPlyTriangle =
    "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
    "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
constexpr const char* kObjTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
constexpr const char* kOffVertices = "0 0 0\n1 0 0\n0 1 0\n";

std::string ply_elements(int count) {
  std::string text = kPly;
  for (int i = 0; i < count; ++i) text += "element e" + std::to_string(i) + " 0\n";
  return text + kPlyTriangle;
}

std::string ply_properties(int count) {
  std::string text = std::string(kPly) + "element other 1\n";
  for (int i = 0; i < count; ++i) text += "property uchar p" + std::to_string(i) + '\n';
  const std::string triangle(kPlyTriangle);
  const std::size_t body = triangle.find("end_header\n") + 11;
  return text + triangle.substr(0, body) + repeated("0 ", count) + triangle.substr(body);
}

/// Forty times a folded polygon: a comb with two rows of teeth, four corners each.
std::string ply_polygons(int teeth) {
  constexpr int kFaces = 40;
  std::string text = std::string(kPly) + "element vertex " + std::to_string(4 * teeth) +
                     "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
                     std::to_string(kFaces) +
                     "\nproperty list ushort int vertex_indices\nend_header\n";
  for (int i = 0; i < 2 * teeth; ++i)
    text += std::to_string(i) + (i % 2 == 0 ? " 1 0\n" : " 0 0\n");
  for (int i = 2 * teeth; i-- > 0;) text += std::to_string(i) + (i % 2 == 0 ? " 3 0\n" : " 2 0\n");
  std::string face = std::to_string(4 * teeth);
  for (int i = 0; i < 4 * teeth; ++i) face += ' ' + std::to_string(i);
  return text + repeated(face + '\n', kFaces);
}

struct InputCase {
  const char* file;
  const char* name;
  int count;  ///< so that reading takes some milliseconds
  std::function<std::string(int count)> text;
};

void PrintTo(const InputCase& c, std::ostream* out) { *out << c.name; }

class LargeInput : public testing::TestWithParam<InputCase> {
 protected:
  /// Seconds of the processor, the least of some runs: other programs do not count.
  static double seconds(int count) {
    const TemporaryDirectory folder;
    const std::string path = folder.write(GetParam().file, GetParam().text(count));
    double least = 1e9;
    for (int i = 0; i < 3; ++i) {
      const std::clock_t before = std::clock();
      const auto file = read_mesh(path);
      least = std::min(least, static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC);
    }
    return least;
  }
};

TEST_P(LargeInput, TakesTimeInProportionToItsSize) {
  // Eight times as much takes sixty-four times as long where it is quadratic.
  constexpr double kTimes = 8, kMax = 24, kClock = 1e-3;
  const int count = GetParam().count;
  EXPECT_LT(seconds(static_cast<int>(kTimes) * count), kMax * (seconds(count) + kClock));
}

INSTANTIATE_TEST_SUITE_P(
    OneThing, LargeInput,
    testing::Values(
        InputCase{"a.ply", "PlyElements", 6000, ply_elements},
        InputCase{"a.ply", "PlyProperties", 6000, ply_properties},
        InputCase{"a.ply", "PlyComments", 20000,
                  [](int n) { return kPly + repeated("comment x\n", n) + kPlyTriangle; }},
        InputCase{"a.ply", "PlyPolygons", 16, ply_polygons},
        InputCase{
            "a.obj", "ObjGroups", 20000,
            [](int n) { return kObjTriangle + repeated("g a\nusemtl b\n", n) + "f 1 2 3\n"; }},
        InputCase{"a.obj", "ObjRelativeFaces", 10000,
                  [](int n) { return repeated(std::string(kObjTriangle) + "f -1 -2 -3\n", n); }},
        InputCase{"a.obj", "ObjContinuedLines", 50000,
                  [](int n) { return kObjTriangle + ("f 1 2 " + repeated("\\\n", n)) + "3\n"; }},
        InputCase{"a.obj", "ObjContinuedComments", 100000,
                  [](int n) { return repeated("# \\\n", n) + kObjTriangle + "f 1 2 3\n"; }},
        InputCase{"a.obj", "ObjSlashes", 100000,
                  [](int n) { return kObjTriangle + ("f 1" + repeated("/1", n)) + " 2 3\n"; }},
        InputCase{"a.obj", "ObjDigits", 100000,
                  [](int n) {
                    return "v 0." + repeated("1", n) + " 0 0\n" + kObjTriangle + "f 1 2 3\n";
                  }},
        InputCase{"a.off", "OffFaces", 20000,
                  [](int n) {
                    return "OFF\n3 " + std::to_string(n) + " 0\n" + kOffVertices +
                           repeated("3 0 1 2\n", n);
                  }},
        InputCase{"a.off", "OffComments", 50000,
                  [](int n) {
                    return "OFF\n" + repeated("# a\n", n) + "3 1 0\n" + kOffVertices + "3 0 1 2\n";
                  }},
        InputCase{"a.stl", "StlSolids", 10000,
                  [](int n) { return repeated("solid x\nendsolid x\n", n); }},
        InputCase{"a.stl", "StlFacets", 2000,
                  [](int n) {
                    return "solid x\n" +
                           repeated(
                               "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                               "vertex 0 1 0\nendloop\nendfacet\n",
                               n) +
                           "endsolid x\n";
                  }}),
    [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace geotherm::test
