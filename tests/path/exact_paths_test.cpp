// SPDX-License-Identifier: MIT
// Geodesics against exact polyhedral distances, and against what every geodesic is.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "geotherm/io.h"
#include "solver/path/streamline.h"
#include "tests/path/path_support.h"
#include "tests/support/exact_distances.h"

namespace geotherm::test {
namespace {

struct ExactCase {
  const char* mesh;
  Index source;
};

void PrintTo(const ExactCase& c, std::ostream* out) { *out << c.mesh; }

const ExactCase kCases[] = {
    {"3holes.off", 0},         {"armadillo.obj", 20000}, {"camelhead.off", 5000},
    {"cheburashka.obj", 3000}, {"fandisk.obj", 17},      {"homer.obj", 4000},
    {"rocker-arm.obj", 1000},  {"spot.obj", 0},          {"stanford-bunny.obj", 5000}};

/// What counts as the shortest path of all.
constexpr double kGlobal = 1e-4;

/// The exact distances themselves are that good.
constexpr double kExactData = 1e-7;

class ExactPaths : public testing::TestWithParam<ExactCase> {};

TEST_P(ExactPaths, AreTheShortestOfAllSlow) {
  const auto folders = data_folders();
  if (!folders) {
    GTEST_SKIP() << "GEOTHERM_TEST_MESHES and GEOTHERM_TEST_EXACT name no folders with data";
  }
  const std::string file_name = GetParam().mesh;
  const Index source = GetParam().source;
  const auto exact = read_npy(folders->exact + "/" + file_name.substr(0, file_name.find('.')) +
                              ".s" + std::to_string(source) + ".npy");
  auto file = read_mesh(folders->meshes + "/" + file_name);
  ASSERT_TRUE(file) << file.error().message;
  const auto mesh = std::make_shared<const TriangleMesh>(std::move(file->mesh));
  ASSERT_EQ(static_cast<Index>(exact.size()), mesh->vertex_count());

  const PathFinder finder = finder_on(mesh);
  std::mt19937 random(30);
  int longer = 0;
  for (int count = 0; count < 30;) {
    const auto target = static_cast<Index>(random() % exact.size());
    const double distance = exact[target];
    if (!std::isfinite(distance) || !(distance > 0)) continue;
    ++count;
    const SurfacePath path = found(finder, source, target);
    const auto along_edges = edge_path(finder.surface(), vertex(source), vertex(target));
    ASSERT_TRUE(along_edges);
    EXPECT_LE(path.length, along_edges->length);
    EXPECT_GE(path.length, distance * (1 - kExactData)) << "vertex " << target;
    longer += static_cast<int>(path.length > distance * (1 + kGlobal));
  }
  EXPECT_LE(longer, 1) << "of 30";
}

INSTANTIATE_TEST_SUITE_P(Meshes, ExactPaths, testing::ValuesIn(kCases), [](const auto& each) {
  std::string name = each.param.mesh;
  std::erase_if(name, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; });
  return name;
});

}  // namespace
}  // namespace geotherm::test
