// SPDX-License-Identifier: MIT
// One rank that cuts its share into many blocks, as large meshes make it do.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "geotherm/io.h"
#include "solver/distributed/shared_heat.h"
#include "solver/distributed/shared_solve.h"
#include "solver/linear/mpi_module.h"
#include "tests/support/compare.h"
#include "tests/support/shapes.h"
#include "tests/support/solve.h"

namespace geotherm::test {
namespace {

constexpr Index kOfBlock = 400;

class SeveralBlocks : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_mpi_module()) GTEST_SKIP() << "built without PETSc and MPI";
  }

  static HeatOptions options() {
    HeatOptions out;
    out.laplacian = LaplacianKind::kIntrinsicDelaunay;
    out.precision = Precision::kFull;
    return out;
  }

  static Result<SharedAnswer> solve_shared(const TriangleMesh& mesh, GlobalIndex source,
                                           const HeatOptions& options) {
    const std::string path =
        testing::TempDir() + testing::UnitTest::GetInstance()->current_test_info()->name() + ".ply";
    if (auto written = write_mesh(path, mesh); !written) return written.error();
    const auto ranks = start_mpi();
    if (!ranks) return ranks.error();
    const RankGroup alone(**mpi_module(), *ranks, [](const Result<void>& mine) { return mine; });
    MethodOptions heat;
    static_cast<HeatOptions&>(heat) = options;
    return solve_over_ranks(alone, path, {&source, 1}, heat, false, {}, kOfBlock);
  }

  /// Rounding of the sums, the bar of Poisson's iterations and kNews.
  static constexpr double kRoundOff = 1e-7;

  /// `most_rounds`: of so many blocks.
  static void expect_as_one(const MeshPtr& mesh, Index source, const HeatOptions& options,
                            double (*most_rounds)(int blocks)) {
    const auto shared = solve_shared(*mesh, source, options);
    ASSERT_TRUE(shared.has_value()) << shared.error().message;
    EXPECT_EQ(shared->blocks, (mesh->vertex_count() + kOfBlock - 1) / kOfBlock);
    EXPECT_LE(shared->rounds, most_rounds(shared->blocks));
    const DistanceResult one = solve(mesh, {source}, options);
    EXPECT_LE(relative_difference(shared->distances, one.distances), kRoundOff);
  }
};

TEST_F(SeveralBlocks, GiveTheDistancesOfOneProcess) {
  expect_as_one(finish(jittered_plane(70, 0.3, 1)), 12, options(),
                [](int blocks) { return 2 * std::sqrt(blocks) + 6; });
}

TEST_F(SeveralBlocks, CarryHeatFartherThanDoublesReach) {
  HeatOptions classic = options();
  classic.variant = Variant::kClassic;
  expect_as_one(finish(plane_grid(1500, 2, 1500, 2)), 0, classic,
                [](int /*blocks*/) { return 3.0; });  // one after the other, in one round
}

/// One source takes part in the heat step; another one is named while it is solved, so that the
/// right side of its row is that of no answer.
TEST_F(SeveralBlocks, RowThatIsOffIsAnError) {
  const std::string path = testing::TempDir() + "several_blocks.ply";
  ASSERT_TRUE(write_mesh(path, *finish(jittered_plane(30, 0.2, 1))).has_value());
  const auto started = start_mpi();
  ASSERT_TRUE(started.has_value());
  std::vector<char> is_source;
  const RankGroup alone(**mpi_module(), *started, [&](const Result<void>& mine) {
    if (!is_source.empty()) is_source.back() = 1;
    return mine;
  });
  auto slice = read_ply_slice(path, 0, 1);
  ASSERT_TRUE(slice.has_value());
  auto part = share_mesh(alone, *std::move(slice));
  ASSERT_TRUE(part.has_value());
  const auto components = name_components(alone, *part);
  ASSERT_TRUE(components.has_value());
  auto blocks = build_blocks(alone, {.most = kOfBlock}, *part);
  ASSERT_TRUE(blocks.has_value());
  ASSERT_GT(blocks->size(), 1U);
  const auto times = diffusion_times(components->sizes, part->unit, {});
  ASSERT_TRUE(times.has_value());
  std::vector<char> flags(static_cast<std::size_t>(part->size()), 0);
  flags.front() = 1;
  const HeatOptions usual = options();
  const SharedTask task = {.ranks = alone,
                           .part = *part,
                           .components = *components,
                           .times = *times,
                           .options = usual,
                           .is_source = flags,
                           .reached = {1}};
  ASSERT_TRUE(factorise_blocks(task, *blocks).has_value());
  EXPECT_TRUE(diffuse_over_ranks(task, *blocks).has_value());
  is_source.swap(flags);  // which leaves the places that the task looks at where they are
  const auto heat = diffuse_over_ranks(task, *blocks);
  ASSERT_FALSE(heat.has_value());
  EXPECT_EQ(heat.error().code, ErrorCode::kNumericalFailure);
  EXPECT_NE(heat.error().message.find("of its largest term, where 0.0001 is allowed"),
            std::string::npos)
      << heat.error().message;
}

}  // namespace
}  // namespace geotherm::test
