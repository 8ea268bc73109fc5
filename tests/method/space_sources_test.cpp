// SPDX-License-Identifier: MIT
// Every method on grids and in volumes refuses the sources that DistanceMethod::solve() does not
// take, and says what is wrong with them.
#include <gtest/gtest.h>

#include <memory>
#include <ostream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/models/volumes.h"
#include "geotherm/build_method.h"
#include "tests/support/compare.h"

namespace geotherm::test {
namespace {

struct BadSpaceSource {
  const char* name;
  SourceSet sources;
  const char* says;  ///< part of the message
};

void PrintTo(const BadSpaceSource& bad, std::ostream* out) { *out << bad.name; }

SourceSet two_with_offsets(std::vector<double> offsets) {
  SourceSet set = SourceSet::of_vertices({0, 3});
  set.offsets = std::move(offsets);
  return set;
}

SourceSet in_cell(std::vector<double> weights) {
  SourceSet set;
  set.cell_points = {{0, std::move(weights)}};
  return set;
}

/// A square of samples; cells have four corners, as tets do.
std::shared_ptr<const Grid> square_grid(Index n) {
  Grid grid;
  grid.size = {n, n, 1};
  return std::make_shared<const Grid>(grid);
}

/// A box, and vertex 8 in no tet.
std::shared_ptr<const TetMesh> box_and_a_vertex() {
  const TetMesh box = make_box_tets(1, 1, 1, Vec3(1, 1, 1));
  std::vector<Vec3> positions(box.positions().begin(), box.positions().end());
  positions.emplace_back(2, 2, 2);
  return std::make_shared<const TetMesh>(
      *TetMesh::build(std::move(positions), {box.tets().begin(), box.tets().end()}));
}

template <class Space>
std::shared_ptr<const DistanceMethod> space_method(std::shared_ptr<const Space> space,
                                                   MethodKind kind) {
  MethodOptions options;
  options.method = kind;
  return *build_method(std::move(space), options);
}

class SourcesInSpaces : public testing::TestWithParam<BadSpaceSource> {};

TEST_P(SourcesInSpaces, AreRefusedByWhatIsWrong) {
  for (const MethodKind kind : {MethodKind::kHeat, MethodKind::kFastMarching}) {
    for (const auto& method :
         {space_method(square_grid(5), kind), space_method(box_and_a_vertex(), kind)}) {
      const auto result = method->solve(GetParam().sources);
      ASSERT_FALSE(result) << to_text(kind);
      EXPECT_EQ(result.error().code, ErrorCode::kBadInput);
      EXPECT_NE(result.error().message.find(GetParam().says), std::string::npos)
          << result.error().message;
    }
  }
}

const BadSpaceSource kBadSpaceSources[] = {
    {"none", {}, "no source"},
    {"vertex_beyond_the_last", SourceSet::of_vertices({25}), "25"},
    {"negative_vertex", SourceSet::of_vertices({-5}), "-5"},
    {"fewer_offsets_than_points", two_with_offsets({0}), "1 offset is given for 2 source points"},
    {"more_offsets_than_points", two_with_offsets({0, 0, 0}), "3 offsets are given for 2 source"},
    {"negative_offset", two_with_offsets({0, -0.5}), "source point 1 is -0.5"},
    {"offset_that_is_no_number", two_with_offsets({kNan, 0}), "source point 0 is nan"},
    {"offset_without_end", two_with_offsets({0, kUnreached}), "source point 1 is inf"},
    {"cell_beyond_the_last", {{}, {}, {}, {{77, {1, 0, 0, 0}}}}, "77"},
    {"three_weights", in_cell({0.5, 0.25, 0.25}), "needs 4 weights"},
    {"weights_that_sum_to_two", in_cell({1, 0.5, 0.5, 0}), "sum to 1"},
    {"negative_weight", in_cell({-0.5, 1, 0.5, 0}), "not negative"},
    {"weight_that_is_no_number", in_cell({kNan, 0.5, 0.5, 0}), "sum to 1"},
};

INSTANTIATE_TEST_SUITE_P(All, SourcesInSpaces, testing::ValuesIn(kBadSpaceSources),
                         [](const auto& bad) { return std::string(bad.param.name); });

TEST(SourcesInVolumes, AreInATet) {
  for (const MethodKind kind : {MethodKind::kHeat, MethodKind::kFastMarching}) {
    const auto result = space_method(box_and_a_vertex(), kind)->solve(SourceSet::of_vertices({8}));
    ASSERT_FALSE(result) << to_text(kind);
    EXPECT_EQ(result.error().message, "source vertex 8 is in no tet");
  }
}

TEST(ReachInSpaces, IsCheckedBeforeTheMarch) {
  const auto method = space_method(square_grid(300), MethodKind::kFastMarching);
  bool marched = false;
  const Progress watch = [&marched](std::string_view, double) { return marched = true; };
  const SourceSet corner = SourceSet::of_vertices({0});
  ASSERT_TRUE(method->solve(corner, {}, watch));
  EXPECT_TRUE(marched);
  marched = false;
  QueryOptions beyond;
  beyond.reach.targets = {90000};
  const auto result = method->solve(corner, beyond, watch);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kBadInput);
  EXPECT_NE(result.error().message.find("vertex 90000"), std::string::npos);
  EXPECT_FALSE(marched);
}

}  // namespace
}  // namespace geotherm::test
