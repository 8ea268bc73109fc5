// SPDX-License-Identifier: MIT
// The work: how many windows are followed.
#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>

#include "solver/polyhedral/propagation.h"
#include "tests/polyhedral/exact_fixture.h"
#include "tests/support/broken_mesh.h"

namespace geotherm::test {
namespace {

double windows_per_face(const Draft& draft, Index source) {
  const auto surface = build_wave_surface(finish(draft), RefineRule::kNever);
  EXPECT_TRUE(surface);
  const auto seeds = seed_sources(**surface, SourceSet::of_vertices({source}));
  EXPECT_TRUE(seeds);
  const WindowMesh mesh(**surface);
  Propagation windows(mesh);
  EXPECT_TRUE(windows.run(*seeds, {}));
  return static_cast<double>(windows.windows()) / (*surface)->face_count();
}

/// All small triangles between the points of a grid in space.
Draft space_grid(Index n) {
  Draft draft;
  for (Index i = 0; i < n * n * n; ++i) draft.add(Vec3(i % n, i / n % n, i / (n * n)));
  const auto near = [&](Index a, Index b) {
    return (draft.positions[a] - draft.positions[b]).norm() < 1.5;
  };
  for (Index a = 0; a < n * n * n; ++a) {
    for (Index b = a + 1; b < n * n * n; ++b) {
      for (Index c = b + 1; near(a, b) && c < n * n * n; ++c) {
        if (near(a, c) && near(b, c)) draft.faces.push_back({a, b, c});
      }
    }
  }
  return draft;
}

TEST(ExactWindows, OfAPlaneAreFewHoweverFineItIs) {
  constexpr double kFew = 2;  // one enters a face by one or two sides
  EXPECT_LE(windows_per_face(plane_grid(20, 20, 1, 1), 30), kFew);
  EXPECT_LE(windows_per_face(plane_grid(120, 120, 1, 1), 3000), kFew);
}

TEST(ExactWindows, FillNoMoreMemoryThanTheyMay) {
  const auto surface = build_wave_surface(finish(sphere(4)), RefineRule::kNever);
  ASSERT_TRUE(surface);
  const auto seeds = seed_sources(**surface, SourceSet::of_vertices({0}));
  ASSERT_TRUE(seeds);
  const WindowMesh mesh(**surface);
  const auto refused = Propagation(mesh, 1 << 10).run(*seeds, {});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kOutOfMemory);
  EXPECT_NE(sentence(refused.error()).find("wavefront-fine"), std::string::npos);
}

/// A strip of squares whose upper border rises from 1 to `rise` like an exponential. Ways along it
/// bend at all of its vertices, and each of these sends a window to all sides that come after it.
Draft rising_strip(Index length, double rise) {
  Draft draft;
  for (Index i = 0; i <= length; ++i) {
    draft.add(Vec3(i, 0, 0));
    draft.add(Vec3(i, std::pow(rise, static_cast<double>(i) / length), 0));
  }
  for (Index i = 0; i < length; ++i) {
    const Index a = 2 * i;
    draft.faces.insert(draft.faces.end(), {{a, a + 2, a + 3}, {a, a + 3, a + 1}});
  }
  return draft;
}

TEST(ExactWindows, OfFacesFarBelowTheMeanAreNotFollowedAgainAndAgain) {
  // The mean edge is some hundred thousand times as long as the first ones. Each vertex that bends
  // ways gives a side one window; out of order they are sixty times as many.
  constexpr Index kLength = 300;
  EXPECT_LE(windows_per_face(rising_strip(kLength, 1e6), 0), kLength);
}

TEST(ExactWindows, AreForeseenWhereTheyAreTooMany) {
  const auto surface = build_wave_surface(finish(rising_strip(10'000, 1e3)), RefineRule::kNever);
  ASSERT_TRUE(surface);
  const auto seeds = seed_sources(**surface, SourceSet::of_vertices({0}));
  ASSERT_TRUE(seeds);
  const WindowMesh mesh(**surface);
  Propagation windows(mesh);
  const auto refused = windows.run(*seeds, {});
  ASSERT_FALSE(refused);  // it would take a hundred million
  EXPECT_LE(windows.windows(), 5'000'000);
  EXPECT_EQ(refused.error().code, ErrorCode::kBudgetEnded);
  EXPECT_NE(sentence(refused.error()).find("foreseen"), std::string::npos);
  EXPECT_NE(sentence(refused.error()).find("wavefront-fine"), std::string::npos);
}

/// Soups and pinched slivers in which windows narrower than all tolerances ran round vertices
/// without end.
class ExactSlivers : public testing::TestWithParam<std::uint64_t> {};

TEST_P(ExactSlivers, EndTheirWindows) {
  const BrokenMesh mesh = broken_mesh(GetParam());
  constexpr double kMany = 1000;  // 16,000 and more, where they are not cut
  EXPECT_LE(windows_per_face(mesh.draft, mesh.draft.faces[0][0]), kMany) << mesh.recipe;
}

INSTANTIATE_TEST_SUITE_P(BrokenMeshes, ExactSlivers,
                         testing::Values(681, 1576, 2991, 4429, 7486, 8198));

TEST(ExactWindows, DoNotMultiplyAtEdgesWithManyFaces) {
  // Without cuts at those edges it is 85 at 4 points a side, 220 at 6, and so on.
  constexpr double kSome = 20;
  EXPECT_LE(windows_per_face(space_grid(4), 0), kSome);
  EXPECT_LE(windows_per_face(space_grid(6), 0), kSome);
}

}  // namespace
}  // namespace geotherm::test
