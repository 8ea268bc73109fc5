// SPDX-License-Identifier: MIT
#include "solver/geometry/clean_faces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "tests/support/mesh_zoo.h"

namespace geotherm::test {
namespace {

using Pair = std::pair<Index, Index>;

class EdgeTables : public testing::TestWithParam<ZooMesh> {};

TEST_P(EdgeTables, ListEveryEdgeWithItsSides) {
  const CleanFaces clean = clean_faces(*GetParam().mesh());
  std::map<Pair, std::vector<Side>> expected;
  for (std::size_t f = 0; f < clean.faces.size(); ++f) {
    for (int k = 0; k < 3; ++k) {
      expected[std::minmax(clean.faces[f][k], clean.faces[f][next_corner(k)])].push_back(
          static_cast<Side>(3 * f + k));
    }
  }
  ASSERT_EQ(clean.edges.edge_count(), static_cast<Index>(expected.size()));
  Index e = 0;
  for (const auto& [ends, sides] : expected) {
    EXPECT_EQ(Pair(clean.edges.low(e), clean.edges.high(e)), ends);
    EXPECT_TRUE(std::ranges::equal(clean.edges.sides(e), sides));
    ++e;
  }
}

INSTANTIATE_TEST_SUITE_P(Zoo, EdgeTables, testing::ValuesIn(zoo()), zoo_name);

class CleanedFaces : public testing::TestWithParam<ZooMesh> {};

TEST_P(CleanedFaces, AreTheFacesOfTheMeshLessThoseLeftOut) {
  const MeshPtr mesh = GetParam().mesh();
  const CleanFaces clean = clean_faces(*mesh);
  EXPECT_EQ(static_cast<Index>(clean.faces.size()),
            mesh->face_count() - clean.repeated_corner - clean.duplicate);
  std::set<std::set<Index>> seen;
  for (std::size_t f = 0; f < clean.faces.size(); ++f) {
    const Face& face = clean.faces[f];
    EXPECT_TRUE(std::ranges::is_permutation(
        face, mesh->faces()[static_cast<std::size_t>(clean.original[f])]));
    EXPECT_TRUE(seen.insert({face.begin(), face.end()}).second) << "face " << f << " occurs twice";
    EXPECT_EQ(std::set<Index>(face.begin(), face.end()).size(), 3U);
  }
}

INSTANTIATE_TEST_SUITE_P(Zoo, CleanedFaces, testing::ValuesIn(zoo()), zoo_name);

CleanFaces clean(Draft draft) { return clean_faces(*finish(std::move(draft))); }

TEST(CleanFacesCount, RepeatedCorners) {
  Draft draft = plane_grid(4, 4, 1, 1);
  draft.faces.push_back({0, 1, 0});
  draft.faces.push_back({2, 2, 2});
  const CleanFaces out = clean(draft);
  EXPECT_EQ(out.repeated_corner, 2);
  EXPECT_EQ(out.duplicate, 0);
  EXPECT_EQ(out.faces.size(), 32U);
}

TEST(CleanFacesCount, DuplicatesHoweverTheyAreTurned) {
  Draft draft = plane_grid(4, 4, 1, 1);
  const auto [a, b, c] = draft.faces[9];
  for (const Face& again : {Face{a, b, c}, Face{b, c, a}, Face{c, b, a}})
    draft.faces.push_back(again);
  const CleanFaces out = clean(draft);
  EXPECT_EQ(out.duplicate, 3);
  EXPECT_EQ(out.faces.size(), 32U);
  EXPECT_EQ(out.reoriented, 0) << "a duplicate says nothing about orientation";
}

TEST(CleanFacesCount, FacesTurnedRound) {
  Draft draft = sphere(2);
  for (const std::size_t f : {5U, 70U, 201U}) std::swap(draft.faces[f][0], draft.faces[f][1]);
  const CleanFaces out = clean(draft);
  EXPECT_EQ(out.reoriented, 3);
  for (Index e = 0; e < out.edges.edge_count(); ++e) {
    const auto sides = out.edges.sides(e);
    ASSERT_EQ(sides.size(), 2U);
    EXPECT_NE(out.faces[face_of(sides[0])][corner_of(sides[0])],
              out.faces[face_of(sides[1])][corner_of(sides[1])]);
  }
}

TEST(CleanFacesCount, NothingOnAGoodMesh) {
  const CleanFaces out = clean(torus(12, 8, 0.3));
  EXPECT_EQ(out.repeated_corner + out.duplicate + out.reoriented, 0);
}

}  // namespace
}  // namespace geotherm::test
