// SPDX-License-Identifier: MIT
// Waves arrive the same on every processor.
#include <gtest/gtest.h>

#include <tuple>

#include "solver/polyhedral/wave_front.h"
#include "tests/support/mesh_zoo.h"

namespace geotherm::test {
namespace {

class InstructionSets : public testing::TestWithParam<std::tuple<ZooMesh, int>> {};

TEST_P(InstructionSets, GiveTheSameDistancesToTheLastBit) {
  const auto surface = build_wave_surface(std::get<0>(GetParam()).mesh());
  ASSERT_TRUE(surface) << surface.error().message;
  const WaveTables tables = build_wave_tables(**surface);
  const auto seeds = seed_sources(
      **surface, {{SurfacePoint::at_vertex(tables.vertex_of_rank[0]),
                   SurfacePoint::in_face((*surface)->base.mesh->face_count() / 2, {0.2, 0.3, 0.5})},
                  {}});
  ASSERT_TRUE(seeds) << seeds.error().message;
  WaveFront plain(tables, std::get<1>(GetParam()), InstructionSet::kPlain);
  plain.run(**surface, *seeds, true, {});
  WaveFront wide(tables, std::get<1>(GetParam()));
  wide.run(**surface, *seeds, true, {});
  EXPECT_TRUE(std::ranges::equal(wide.distances(), plain.distances()));
  EXPECT_TRUE(std::ranges::equal(wide.labels(), plain.labels()));
}

INSTANTIATE_TEST_SUITE_P(Zoo, InstructionSets,
                         testing::Combine(testing::ValuesIn(zoo(kRegular)), testing::Values(1, 3)),
                         [](const auto& each) {
                           return std::get<0>(each.param).name +
                                  ("_" + std::to_string(std::get<1>(each.param)));
                         });

}  // namespace
}  // namespace geotherm::test
