// SPDX-License-Identifier: MIT
#include "solver/mesh/connectivity.h"

#include <gtest/gtest.h>

#include "tests/support/shapes.h"

namespace geotherm::test {
namespace {

class EdgePaths : public testing::Test {
 protected:
  void use(Draft draft) {
    mesh_ = finish(std::move(draft));
    const EdgeTable edges(mesh_->vertex_count(), mesh_->faces());
    graph_ = std::make_unique<EdgeGraph>(mesh_->positions(), edges);
  }
  double length(const std::vector<Index>& path) const {
    double sum = 0;
    for (std::size_t i = 1; i < path.size(); ++i) {
      sum += (mesh_->positions()[static_cast<std::size_t>(path[i])] -
              mesh_->positions()[static_cast<std::size_t>(path[i - 1])])
                 .norm();
    }
    return sum;
  }

  MeshPtr mesh_;
  std::unique_ptr<EdgeGraph> graph_;
};

TEST_F(EdgePaths, FollowTheGridLine) {
  use(plane_grid(10, 4, 10, 4));
  const auto path = graph_->shortest_path(grid_vertex(10, 1, 2), grid_vertex(10, 6, 2));
  ASSERT_TRUE(path);
  std::vector<Index> expected;
  for (Index i = 1; i <= 6; ++i) expected.push_back(grid_vertex(10, i, 2));
  EXPECT_EQ(*path, expected);
}

TEST_F(EdgePaths, StepFromVertexToAdjacentVertexAndAreAsLongBothWays) {
  use(sphere(3));
  const auto there = graph_->shortest_path(0, 300);
  const auto back = graph_->shortest_path(300, 0);
  ASSERT_TRUE(there && back);
  EXPECT_EQ(there->front(), 0);
  EXPECT_EQ(there->back(), 300);
  for (std::size_t i = 1; i < there->size(); ++i) {
    EXPECT_TRUE(graph_->adjacent((*there)[i - 1], (*there)[i]));
  }
  EXPECT_NEAR(length(*there), length(*back), 1e-12 * length(*there));
}

TEST_F(EdgePaths, OfAVertexToItselfAreThatVertex) {
  use(plane_grid(2, 2, 1, 1));
  EXPECT_EQ(*graph_->shortest_path(4, 4), std::vector<Index>{4});
}

TEST_F(EdgePaths, DoNotLeaveAComponent) {
  Draft two = plane_grid(1, 1, 1, 1);
  append(two, plane_grid(1, 1, 1, 1));
  use(std::move(two));
  const auto path = graph_->shortest_path(0, 5);
  ASSERT_FALSE(path);
  EXPECT_EQ(path.error().code, ErrorCode::kBadInput);
  EXPECT_NE(sentence(path.error()).find("vertex 0 to vertex 5"), std::string::npos);
}

TEST_F(EdgePaths, KnowWhichVerticesAreAdjacent) {
  use(plane_grid(3, 3, 1, 1));
  EXPECT_TRUE(graph_->adjacent(0, 1));
  EXPECT_TRUE(graph_->adjacent(1, 0));
  EXPECT_FALSE(graph_->adjacent(0, 2));
}

}  // namespace
}  // namespace geotherm::test
