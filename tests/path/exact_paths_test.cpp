// SPDX-License-Identifier: MIT
// Geodesics against exact polyhedral distances, and against what every geodesic is.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "geotherm/build_method.h"
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

TEST(PathsOverNoise, ThatAreLongerThanTheDistanceSaySo) {
  // A height field of noise whose slopes are about nine: no search finds the shortest ways there.
  constexpr Index kSide = 45;
  constexpr double kNoise = 0.2;
  std::mt19937 random(7);
  std::normal_distribution<double> height(0, kNoise);
  std::vector<Vec3> positions;
  std::vector<Face> faces;
  for (Index i = 0; i < kSide * kSide; ++i) {
    positions.emplace_back(double(i % kSide) / (kSide - 1), double(i / kSide) / (kSide - 1),
                           height(random));
  }
  for (Index y = 0; y + 1 < kSide; ++y) {
    for (Index x = 0; x + 1 < kSide; ++x) {
      const Index a = y * kSide + x;
      faces.push_back({a, a + 1, a + kSide + 1});
      faces.push_back({a, a + kSide + 1, a + kSide});
    }
  }
  const auto mesh = std::make_shared<const TriangleMesh>(
      *TriangleMesh::build(std::move(positions), std::move(faces)));
  MethodOptions options;
  options.method = MethodKind::kExact;
  const auto method = build_method(mesh, options);
  ASSERT_TRUE(method);
  const auto exact = (*method)->solve(SourceSet::of_vertices({0}));
  ASSERT_TRUE(exact);
  const PathFinder finder(mesh, *method);
  int longer = 0;
  for (Index target = 1; target < mesh->vertex_count(); target += 97) {
    const SurfacePoint ends[] = {vertex(0), vertex(target)};
    const auto path = finder.find(ends, {});
    ASSERT_TRUE(path) << sentence(path.error());
    const double share = path->path.length / exact->distances[target] - 1;
    EXPECT_GE(share, -kExactData) << target;
    EXPECT_EQ(path->warnings.empty(), share <= kGlobal) << target << ' ' << share;
    longer += share > kGlobal ? 1 : 0;
  }
  EXPECT_GT(longer, 0) << "else this test tests nothing";
}

}  // namespace
}  // namespace geotherm::test
