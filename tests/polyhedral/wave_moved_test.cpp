// SPDX-License-Identifier: MIT
// Tables of a surface that has moved say of every face, edge and corner what fresh ones say.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "solver/polyhedral/wave_tables.h"
#include "tests/polyhedral/wave_fixture.h"
#include "tests/support/shapes.h"

namespace geotherm::test {
namespace {

using SurfacePtr = std::shared_ptr<const WaveSurface>;

/// What tables hold, in numbers of the intrinsic mesh.
class Named {
 public:
  explicit Named(const WaveTables& tables) : tables_(tables) {}

  Side side(SideCode code) const {
    return code < 0 ? kNoSide
                    : 3 * tables_.intrinsic_face[face_of_code(code)] + corner_of_code(code);
  }
  const WaveFace& face(Index f) const { return tables_.faces[tables_.rank_of_face[f]]; }
  Index vertex(Index f, int k) const { return tables_.vertex_of_rank[face(f).vertex[k]]; }
  /// The first first.
  std::vector<Side> sides_of_edge(Index f, int k) const {
    const auto [first, second] = tables_.sides[face(f).edge[k]];
    std::vector<Side> out = {side(first)};
    if (second >= 0) out.push_back(side(second));
    if (second >= kNoSideCode) return out;
    const SideCode* list = &tables_.more[static_cast<std::size_t>(-2 - second)];
    for (SideCode i = 1; i <= list[0]; ++i) out.push_back(side(list[i]));
    return out;
  }
  /// In order where a wave asks for it.
  std::vector<Side> corners_at(Index f, int k) const {
    std::vector<Side> out;
    for (const SideCode code : tables_.corners_at(face(f).vertex[k])) out.push_back(side(code));
    if ((face(f).touching >> k & 1U) == 0) std::ranges::sort(out);
    return out;
  }

 private:
  const WaveTables& tables_;
};

void expect_same(const WaveSurface& surface, const WaveTables& moved, const WaveTables& fresh) {
  const Named here(moved), there(fresh);
  for (Index f = 0; f < surface.face_count(); ++f) {
    EXPECT_EQ(here.face(f).length, there.face(f).length);
    EXPECT_EQ(here.face(f).twice_area, there.face(f).twice_area);
    EXPECT_EQ(here.face(f).reversed, there.face(f).reversed) << f;
    EXPECT_EQ(here.face(f).touching, there.face(f).touching) << f;
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(here.vertex(f, k), there.vertex(f, k)) << f;
      EXPECT_EQ(here.sides_of_edge(f, k), there.sides_of_edge(f, k)) << f;
      EXPECT_EQ(here.corners_at(f, k), there.corners_at(f, k)) << f;
    }
  }
  EXPECT_EQ(moved.mean_side, fresh.mean_side);
  EXPECT_EQ(moved.longest_side, fresh.longest_side);
}

class MovedWaves : public testing::TestWithParam<Draft (*)()> {};

TEST_P(MovedWaves, HaveTheTablesOfAFreshBuild) {
  const MeshPtr mesh = finish(GetParam()());
  std::mt19937 random(5);
  std::uniform_real_distribution<double> shift(-0.3, 0.3);
  // Tables move where no vertices are inserted.
  SurfacePtr before = *build_wave_surface(mesh, RefineRule::kNever);
  WaveTables tables = build_wave_tables(*before);
  const double edge = before->base.mean_edge;
  std::size_t flips = 0;
  for (int frame = 0; frame < 5; ++frame) {
    std::vector<Vec3> positions(mesh->positions().begin(), mesh->positions().end());
    for (Vec3& p : positions) p += edge * Vec3(shift(random), shift(random), shift(random));
    const auto moved = std::make_shared<const TriangleMesh>(*mesh->moved(std::move(positions)));
    const SurfacePtr surface = *build_wave_surface(moved, RefineRule::kNever, {}, 1, before.get());
    ASSERT_TRUE(can_move_tables(before->base, surface->base));
    tables = moved_wave_tables(tables, *before, *surface);
    expect_same(*surface, tables, build_wave_tables(*surface));
    flips += surface->base.edits.size();
    before = surface;
  }
  EXPECT_GT(flips, 10U);
}

TEST(MovedWavesWithInsertedVertices, AnswerAsFreshOnes) {
  const MeshPtr mesh = finish(random_delaunay(300, 3));
  std::mt19937 random(6);
  std::uniform_real_distribution<double> shift(-0.01, 0.01);
  MethodOptions options;
  options.method = MethodKind::kWavefront;
  auto method = build_method(mesh, options);
  ASSERT_TRUE(method);
  const SourceSet set = SourceSet::of_vertices({7});
  for (int frame = 0; frame < 5; ++frame) {
    std::vector<Vec3> positions(mesh->positions().begin(), mesh->positions().end());
    for (Vec3& p : positions) p += Vec3(shift(random), shift(random), 0);
    const auto moved = std::make_shared<const TriangleMesh>(*mesh->moved(std::move(positions)));
    ASSERT_GT((*build_wave_surface(moved))->base.refinement.points, 0);
    method = build_method_moved(moved, options, method->get());
    ASSERT_TRUE(method);
    EXPECT_EQ(solve(**method, set).distances, distances(moved, options.method, set)) << frame;
  }
}

Draft with_fins() {
  Draft draft = jittered_plane(20, 0.3, 4);
  for (Index i = 0; i < 20; ++i) {  // edges with three faces
    const Face face = draft.faces[static_cast<std::size_t>(30 * i)];
    draft.positions.emplace_back(draft.positions[face[0]] + Vec3(0, 0, 0.05));
    draft.faces.push_back({face[0], face[1], static_cast<Index>(draft.positions.size()) - 1});
  }
  return draft;
}

INSTANTIATE_TEST_SUITE_P(Shapes, MovedWaves,
                         testing::Values([] { return sphere(3); },
                                         [] { return jittered_plane(20, 0.3, 4); }, with_fins,
                                         [] { return graded_book(6); },
                                         [] { return spiky_sphere(); }));

}  // namespace
}  // namespace geotherm::test
