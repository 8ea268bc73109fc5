// SPDX-License-Identifier: MIT
// What is set up by several threads is what one thread sets up, to the last bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <numeric>
#include <random>
#include <ranges>

#include "geotherm/mesh_report.h"
#include "solver/geometry/intrinsic_surface.h"
#include "solver/geometry/operator_mesh.h"
#include "tests/support/mesh_defects.h"
#include "tests/support/mesh_zoo.h"
#include "tests/support/operators.h"
#include "tests/support/sanitized.h"

namespace geotherm::test {
namespace {

/// Whether two lists have the same bytes: NaN and the sign of 0 count.
template <class List>
bool same_bits(const List& a, const List& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0);
}

/// 245,000 faces: enough that seven threads get a part of every pass; three in a build with a
/// sanitizer. Many edges to flip, and a second component.
Draft large_mesh() {
  Draft draft = jittered_plane(kSanitized ? 225 : 350, 0.4, 3);
  append(draft, sphere(3));
  return draft;
}

Draft large_spoilt_mesh() {
  Draft draft = large_mesh();
  Dice dice(11);
  for (const MeshDefect& defect : mesh_defects()) {
    for (int i = 0; i < 5; ++i) defect.apply(draft, dice);
  }
  return draft;
}

/// Everything that set-up makes of a mesh before and after the analysis.
struct Made {
  CleanFaces clean;
  MeshSummary summary;
  IntrinsicSurface surface;
  SymmetricPattern pattern;
  std::shared_ptr<const OperatorMesh> operators;
  LowerMatrix matrix;

  Made(const MeshPtr& mesh, int threads)
      : clean(clean_faces(*mesh, threads)),
        summary(summarize_mesh(*mesh, threads)),
        surface(*build_intrinsic_surface(
            mesh, {.flip = FlipRule::kWhereNeeded, .cover = CoverRule::kWhereNeeded}, {},
            threads)) {
    const Numbering numbers = numbering_of(*mesh, clean);
    pattern =
        surface_pattern(surface.intrinsic, surface.corners, numbers.vertex, numbers.local, threads);
    std::vector<Index> order(numbers.vertex.size());
    std::iota(order.begin(), order.end(), 0);
    std::shuffle(order.begin(), order.end(), std::mt19937(4));
    operators = build_operator_mesh(surface.intrinsic, pattern, numbers.local, order,
                                    connected_components(pattern), threads);
    const FemOperator matrix_of(operators, 1, 0.7, {3, 500}, 0.5, threads);
    matrix = matrix_of.assembled();
  }
};

using MeshAndThreads = std::tuple<Draft (*)(), int>;
class SetUpByThreads : public testing::TestWithParam<MeshAndThreads> {
 protected:
  MeshPtr mesh = finish(std::get<0>(GetParam())());
  Made one{mesh, 1}, many{mesh, std::get<1>(GetParam())};
};

TEST_P(SetUpByThreads, HasTheSameBits) {
  EXPECT_TRUE(same_bits(one.clean.faces, many.clean.faces));
  EXPECT_TRUE(same_bits(one.clean.original, many.clean.original));
  ASSERT_EQ(one.clean.edges.edge_count(), many.clean.edges.edge_count());
  for (Index e = 0; e < one.clean.edges.edge_count(); ++e) {
    ASSERT_EQ(one.clean.edges.low(e), many.clean.edges.low(e));
    ASSERT_EQ(one.clean.edges.high(e), many.clean.edges.high(e));
    ASSERT_TRUE(std::ranges::equal(one.clean.edges.sides(e), many.clean.edges.sides(e)));
  }
  EXPECT_EQ(one.summary.area, many.summary.area);
  EXPECT_EQ(one.summary.degenerate_faces, many.summary.degenerate_faces);
  EXPECT_EQ(one.summary.mean_edge_length, many.summary.mean_edge_length);

  EXPECT_EQ(one.surface.mean_edge, many.surface.mean_edge);
  EXPECT_TRUE(same_bits(one.surface.intrinsic.faces, many.surface.intrinsic.faces));
  EXPECT_TRUE(same_bits(one.surface.intrinsic.lengths, many.surface.intrinsic.lengths));
  EXPECT_TRUE(same_bits(one.surface.intrinsic.twin, many.surface.intrinsic.twin));
  EXPECT_TRUE(same_bits(one.surface.kept->of_face, many.surface.kept->of_face));
  EXPECT_GT(one.surface.flips, 0);
  EXPECT_EQ(one.surface.flips, many.surface.flips);

  EXPECT_EQ(one.pattern.start, many.pattern.start);
  EXPECT_EQ(one.pattern.neighbor, many.pattern.neighbor);
  EXPECT_EQ(one.operators->pattern, many.operators->pattern);
  EXPECT_EQ(one.operators->components.of, many.operators->components.of);
  EXPECT_TRUE(same_bits(one.operators->intrinsic_face, many.operators->intrinsic_face));
  EXPECT_TRUE(same_bits(one.operators->faces, many.operators->faces));
  EXPECT_TRUE(same_bits(one.operators->layout, many.operators->layout));
  EXPECT_TRUE(same_bits(one.operators->mass, many.operators->mass));
  EXPECT_TRUE(same_bits(one.operators->stiffness_diagonal, many.operators->stiffness_diagonal));
  EXPECT_EQ(one.matrix.start, many.matrix.start);
  EXPECT_EQ(one.matrix.row, many.matrix.row);
  EXPECT_TRUE(same_bits(one.matrix.value, many.matrix.value));
}

std::string mesh_and_threads_name(const testing::TestParamInfo<MeshAndThreads>& info) {
  const bool spoilt = std::get<0>(info.param) == large_spoilt_mesh;
  return std::string(spoilt ? "Spoilt" : "Large") + std::to_string(std::get<1>(info.param));
}
INSTANTIATE_TEST_SUITE_P(Meshes, SetUpByThreads,
                         testing::Combine(testing::Values(large_mesh, large_spoilt_mesh),
                                          testing::Values(3)),
                         mesh_and_threads_name);
INSTANTIATE_TEST_SUITE_P(MeshesSlow, SetUpByThreads,
                         testing::Combine(testing::Values(large_mesh, large_spoilt_mesh),
                                          testing::Values(2, 7)),
                         mesh_and_threads_name);

class SurfacePatterns : public testing::TestWithParam<ZooMesh> {};

TEST_P(SurfacePatterns, AreThoseOfTheFlippedFaces) {
  const MeshPtr mesh = GetParam().mesh();
  const auto surface = build_intrinsic_surface(mesh, {.flip = FlipRule::kAlways});
  ASSERT_TRUE(surface) << surface.error().message;
  const Numbering numbers = numbering_of(*mesh, clean_faces(*mesh));
  const SymmetricPattern expected = pattern_of(surface->intrinsic, numbers);
  const SymmetricPattern pattern =
      surface_pattern(surface->intrinsic, surface->corners, numbers.vertex, numbers.local, 1);
  EXPECT_EQ(pattern.start, expected.start);
  EXPECT_EQ(pattern.neighbor, expected.neighbor);
}

INSTANTIATE_TEST_SUITE_P(Zoo, SurfacePatterns, testing::ValuesIn(zoo()), zoo_name);

}  // namespace
}  // namespace geotherm::test
