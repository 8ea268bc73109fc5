// SPDX-License-Identifier: MIT
// Geodesics are as short as exact distances say, on meshes so coarse that distances at vertices say
// little about where they run.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string_view>

#include "geotherm/build_method.h"
#include "tests/path/path_support.h"
#include "tests/support/mesh_zoo.h"

namespace geotherm::test {
namespace {

/// What counts as the shortest path, as a share of the largest distance: both are exact but for
/// round-off, and another path that is straight everywhere is longer by far more than this.
constexpr double kShortest = 1e-4;

std::shared_ptr<const DistanceMethod> exact_method(const MeshPtr& mesh) {
  MethodOptions options;
  options.method = MethodKind::kExact;
  options.threads = 1;
  auto method = build_method(mesh, options);
  EXPECT_TRUE(method) << method.error().message;
  return *method;
}

/// Paths between random vertices: from each of some sources to several targets.
void expect_shortest(const MeshPtr& mesh, int sources, int targets, unsigned seed,
                     bool regular = true) {
  const PathFinder finder = finder_on(mesh);
  const auto exact = exact_method(mesh);
  std::mt19937 random(seed);
  std::uniform_int_distribution<Index> any(0, mesh->vertex_count() - 1);
  for (int i = 0; i < sources; ++i) {
    SourceSet set;
    set.points = {vertex(any(random))};
    const Index source = set.points.front().vertex;
    const auto solved = exact->solve(set, {.quality = false});
    if (!solved) {  // a vertex without a face
      EXPECT_EQ(solved.error().code, ErrorCode::kBadInput) << solved.error().message;
      continue;
    }
    double range = 0;
    for (const double d : solved->distances) range = std::isfinite(d) ? std::max(range, d) : range;
    for (int k = 0; k < targets; ++k) {
      const Index target = any(random);
      const double distance = solved->distances[target];
      if (!std::isfinite(distance)) continue;
      const double length = found(finder, source, target).length;
      EXPECT_LE(length, distance + kShortest * range) << "from " << source << " to " << target;
      if (!regular) continue;  // distances are those of faces made a little less flat
      EXPECT_GE(length, distance - kShortest * range) << "from " << source << " to " << target;
    }
  }
}

class ShortestOnSlow : public testing::TestWithParam<ZooMesh> {};

TEST_P(ShortestOnSlow, IsThePathThatIsFound) {
  const bool is_long =
      std::string_view(GetParam().name) == "long_strip";  // a thousand faces a path
  expect_shortest(GetParam().mesh(), is_long ? 2 : 4, is_long ? 2 : 8, 41,
                  (GetParam().tags & kRegular) != 0);
}

INSTANTIATE_TEST_SUITE_P(Zoo, ShortestOnSlow, testing::ValuesIn(zoo()), zoo_name);

class ShortestOnCoarseSlow : public testing::TestWithParam<unsigned> {};

/// Tens to hundreds of faces; every other one is rough.
TEST_P(ShortestOnCoarseSlow, TorusIsThePathThatIsFound) {
  std::mt19937 random(GetParam());
  std::uniform_int_distribution<Index> around(3, 20), across(3, 14);
  std::uniform_real_distribution<double> minor(0.2, 0.8);
  const Index columns = around(random), rows = across(random);
  Draft draft = torus(columns, rows, minor(random));
  if (GetParam() % 2 == 1) {
    std::normal_distribution<double> shift(0, 0.05);
    for (Vec3& p : draft.positions) p += Vec3(shift(random), shift(random), shift(random));
  }
  expect_shortest(finish(draft), 6, 10, GetParam());
}

/// From nearly flat ones to spikes.
TEST_P(ShortestOnCoarseSlow, HeightFieldIsThePathThatIsFound) {
  std::mt19937 random(GetParam());
  const Index cells = std::uniform_int_distribution<Index>(3, 16)(random);
  Draft draft = jittered_plane(cells, 0.3, GetParam());
  const double heights[] = {2.0 / cells, 0.5, 0.1};
  std::uniform_real_distribution<double> height(0, heights[GetParam() % 3]);
  for (Vec3& p : draft.positions) p.z() = height(random);
  expect_shortest(finish(draft), 6, 10, GetParam());
}

INSTANTIATE_TEST_SUITE_P(Seeds, ShortestOnCoarseSlow, testing::Range(1U, 13U));

/// A long torus of 40 faces, between two of whose vertices the shortest path stays far from every
/// other: those along edges and beside vertices can only be straightened into longer ones.
TEST(Shortest, PathFarFromEveryVertexIsFound) {
  Draft draft;
  draft.positions = {{1.6, 0, 0},
                     {1.09, 0, 0.476},
                     {0.653, 0, 0.294},
                     {0.5, 0, -0.294},
                     {1.12, 0, -0.476},
                     {-0.0753, 1.5, 0},
                     {-0.00768, 1.15, 0.476},
                     {-0.0581, 0.595, 0.294},
                     {0.0153, 0.595, -0.294},
                     {0.0925, 1.15, -0.476},
                     {-1.59, 1.84e-16, 0},
                     {-1.22, 1.41e-16, 0.476},
                     {-0.646, 7.29e-17, 0.294},
                     {-0.66, 7.29e-17, -0.294},
                     {-1.12, 1.41e-16, -0.476},
                     {-0.0204, -1.5, 0},
                     {-0.0995, -1.15, 0.476},
                     {-0.00536, -0.595, 0.294},
                     {-0.00455, -0.595, -0.294},
                     {0.0418, -1.15, -0.476}};
  draft.faces = {{0, 5, 1},    {1, 5, 6},    {1, 6, 2},    {2, 6, 7},    {2, 7, 3},    {3, 7, 8},
                 {3, 8, 4},    {4, 8, 9},    {4, 9, 0},    {0, 9, 5},    {5, 10, 6},   {6, 10, 11},
                 {6, 11, 7},   {7, 11, 12},  {7, 12, 8},   {8, 12, 13},  {8, 13, 9},   {9, 13, 14},
                 {9, 14, 5},   {5, 14, 10},  {10, 15, 11}, {11, 15, 16}, {11, 16, 12}, {12, 16, 17},
                 {12, 17, 13}, {13, 17, 18}, {13, 18, 14}, {14, 18, 19}, {14, 19, 10}, {10, 19, 15},
                 {15, 0, 16},  {16, 0, 1},   {16, 1, 17},  {17, 1, 2},   {17, 2, 18},  {18, 2, 3},
                 {18, 3, 19},  {19, 3, 4},   {19, 4, 15},  {15, 4, 0}};
  const MeshPtr mesh = finish(draft);
  const auto exact = exact_method(mesh);
  const PathFinder finder = finder_on(mesh);
  for (Index source = 0; source < mesh->vertex_count(); ++source) {
    SourceSet set;
    set.points = {vertex(source)};
    const auto solved = exact->solve(set, {.quality = false});
    ASSERT_TRUE(solved) << solved.error().message;
    for (Index target = 0; target < source; ++target) {
      const double distance = solved->distances[target];
      EXPECT_NEAR(found(finder, source, target).length, distance, kShortest * distance)
          << "from " << source << " to " << target;
    }
  }
}

}  // namespace
}  // namespace geotherm::test
