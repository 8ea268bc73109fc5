// SPDX-License-Identifier: MIT
// The work: how many windows are followed.
#include <Eigen/Geometry>

#include "solver/exact/propagation.h"
#include "tests/exact/exact_fixture.h"

namespace geotherm::test {
namespace {

double windows_per_face(const Draft& draft, Index source) {
  const auto surface = build_wave_surface(finish(draft));
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
  const auto surface = build_wave_surface(finish(sphere(4)));
  ASSERT_TRUE(surface);
  const auto seeds = seed_sources(**surface, SourceSet::of_vertices({0}));
  ASSERT_TRUE(seeds);
  const WindowMesh mesh(**surface);
  const auto refused = Propagation(mesh, 1 << 10).run(*seeds, {});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kOutOfMemory);
  EXPECT_NE(refused.error().message.find("wavefront-fine"), std::string::npos);
}

TEST(ExactWindows, DoNotMultiplyAtEdgesWithManyFaces) {
  // Without cuts at those edges it is 85 at 4 points a side, 220 at 6, and so on.
  constexpr double kSome = 20;
  EXPECT_LE(windows_per_face(space_grid(4), 0), kSome);
  EXPECT_LE(windows_per_face(space_grid(6), 0), kSome);
}

}  // namespace
}  // namespace geotherm::test
