// SPDX-License-Identifier: MIT
// The symbolic side of the multifrontal factorisation, against elimination played through.
#include "solver/linear/multifrontal/front_tree.h"

#include <gtest/gtest.h>

#include <atomic>
#include <numeric>
#include <set>

#include "solver/linear/multifrontal/front_tasks.h"
#include "tests/linear/front_fixture.h"

namespace geotherm::test {
namespace {

/// A graph with edges at random.
SymmetricPattern random_graph(Index size, int edges, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<Index> vertex(0, size - 1);
  std::vector<std::set<Index>> neighbors(static_cast<std::size_t>(size));
  for (int e = 0; e < edges; ++e) {
    const Index a = vertex(random), b = vertex(random);
    if (a == b) continue;
    neighbors[a].insert(b);
    neighbors[b].insert(a);
  }
  SymmetricPattern pattern;
  for (const auto& list : neighbors) {
    pattern.neighbor.insert(pattern.neighbor.end(), list.begin(), list.end());
    pattern.start.push_back(static_cast<std::int64_t>(pattern.neighbor.size()));
  }
  return pattern;
}

/// Rows below the diagonal of every column of the factor: eliminating joins all later neighbours.
std::vector<std::set<Index>> eliminate(const SymmetricPattern& pattern) {
  std::vector<std::set<Index>> below(static_cast<std::size_t>(pattern.size()));
  for (Index j = 0; j < pattern.size(); ++j) {
    for (const Index i : pattern.neighbors(j)) {
      if (i > j) below[j].insert(i);
    }
  }
  for (Index j = 0; j < pattern.size(); ++j) {
    if (below[j].empty()) continue;
    const Index parent = *below[j].begin();
    below[parent].insert(std::next(below[j].begin()), below[j].end());
  }
  return below;
}

TEST(ColumnCounts, AreThoseOfElimination) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    const SymmetricPattern pattern = random_graph(40, 20 + static_cast<int>(seed), seed);
    const auto below = eliminate(pattern);
    const ColumnCounts counts = count_columns(pattern);
    for (Index j = 0; j < pattern.size(); ++j) {
      EXPECT_EQ(counts.below[j], static_cast<Index>(below[j].size())) << "seed " << seed;
      EXPECT_EQ(counts.parent[j], below[j].empty() ? kNoIndex : *below[j].begin());
    }
  }
}

TEST(Postorder, KeepsSubtreesTogetherBeforeTheirRoots) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    const std::vector<Index> parent =
        elimination_parents(random_graph(60, 40 + static_cast<int>(seed), seed));
    const std::vector<Index> order = postorder(parent);
    const std::vector<Index> place = inverse_permutation(order);
    std::vector<Index> size(parent.size(), 1);
    for (const Index node : order) {
      if (parent[node] != kNoIndex) size[parent[node]] += size[node];
    }
    std::vector<Index> first(place);
    for (const Index node : order) {
      EXPECT_EQ(place[node] - first[node] + 1, size[node]);
      if (parent[node] == kNoIndex) continue;
      EXPECT_GT(place[parent[node]], place[node]);
      first[parent[node]] = std::min(first[parent[node]], first[node]);
    }
  }
}

TEST(Path, HasAllAncestorsOnceAndAscends) {
  const Fronts fronts(torus(60, 40, 0.4));
  const EliminationTree& tree = fronts.tree.tree;
  std::vector<Index> rows(30);
  for (Index k = 0; k < 30; ++k) rows[k] = (k * 7919) % fronts.tree.size();
  std::set<Index> expected;
  for (const Index row : rows) {
    for (Index s = tree.node_of_row[row]; s != kNoIndex; s = tree.parent[s]) expected.insert(s);
  }
  EXPECT_EQ(tree.path(rows), std::vector<Index>(expected.begin(), expected.end()));
  EXPECT_TRUE(tree.path({}).empty());
}

void expect_places_for_all_entries(const FrontTree& tree, const SymmetricPattern& pattern) {
  const auto below = eliminate(pattern);
  // Rows of each front from its parent's, the roots' from nothing.
  std::vector<std::vector<Index>> rows(static_cast<std::size_t>(tree.count()));
  for (Index s = tree.count(); s-- > 0;) {
    for (Index j = tree.nodes.first[s]; j < tree.nodes.first[s + 1]; ++j) rows[s].push_back(j);
    rows[s].resize(static_cast<std::size_t>(padded(tree.width(s))), kNoIndex);
    for (Index i = 0; i < tree.below(s); ++i) {
      rows[s].push_back(rows[tree.tree.parent[s]][tree.places_in_parent(s)[i]]);
      EXPECT_NE(rows[s].back(), kNoIndex);
    }
    for (Index j = tree.nodes.first[s]; j < tree.nodes.first[s + 1]; ++j) {
      const std::set<Index> there(rows[s].begin(), rows[s].end());
      for (const Index row : below[j]) EXPECT_TRUE(there.contains(row));
    }
  }
}

TEST(FrontTree, HasAPlaceForEveryEntryOfTheFactor) {
  const Fronts fronts(torus(40, 30, 0.4));
  expect_places_for_all_entries(fronts.tree, fronts.pattern);
}

std::vector<Index> in_order(Index size) {
  std::vector<Index> order(static_cast<std::size_t>(size));
  std::iota(order.begin(), order.end(), 0);
  return order;
}

/// Faces of the graph's edges, then some at random; corners from `size` on are new vertices.
std::vector<Face> with_other_faces(const SymmetricPattern& pattern, Index added, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<Index> vertex(0, pattern.size() - 1);
  std::vector<Face> faces;
  for (Index i = 0; i < pattern.size(); ++i) {
    for (const Index j : pattern.neighbors(i)) faces.push_back({i, j, j});
  }
  for (int k = 0; k < 12; ++k) {
    const Index at = vertex(random);
    const Index next = pattern.neighbors(at).front();
    faces.push_back({at, pattern.neighbors(next).back(), vertex(random)});
  }
  // Each new vertex beside the one before, the last of them beside old ones.
  for (Index k = 0; k < added; ++k) {
    const Index at = pattern.size() + k;
    const Index beside = k + 1 < added ? at + 1 : vertex(random);
    faces.push_back({at, beside, beside});
  }
  return faces;
}

TEST(OrderAlong, LeavesAPlaceForEveryEntryOfTheFactor) {
  const Fronts fronts(torus(24, 16, 0.4));
  const Index old = fronts.pattern.size();
  for (unsigned seed = 0; seed < 50; ++seed) {
    const auto added = static_cast<Index>(seed % 4);
    std::vector<Index> node = fronts.tree.tree.node_of_row;
    node.resize(static_cast<std::size_t>(old + added), kNoIndex);
    node.push_back(kNoIndex);  // in no face
    std::vector<Face> faces = with_other_faces(fronts.pattern, added, seed);
    const auto order = order_along(fronts.tree.tree.parent, in_order(old), node, faces);
    ASSERT_TRUE(order);
    ASSERT_EQ(std::ssize(order->order), old + added);
    ASSERT_EQ(std::set<Index>(order->order.begin(), order->order.end()).size(),
              order->order.size());
    const std::vector<Index> place = inverse_permutation(order->order);
    for (Face& face : faces) {
      for (Index& corner : face) corner = place[corner];
    }
    const SymmetricPattern pattern = pattern_of_faces(old + added, faces);
    expect_places_for_all_entries(build_front_tree(pattern, *order, 1), pattern);
  }
}

void expect_same_tree(const FrontTree& tree, const FrontTree& expected) {
  EXPECT_EQ(tree.nodes.first, expected.nodes.first);
  EXPECT_EQ(tree.nodes.below, expected.nodes.below);
  EXPECT_EQ(tree.tree.parent, expected.tree.parent);
  EXPECT_EQ(tree.tree.node_of_row, expected.tree.node_of_row);
  EXPECT_EQ(tree.is_leaf, expected.is_leaf);
  EXPECT_EQ(tree.place_in_parent, expected.place_in_parent);
  EXPECT_EQ(tree.value_start, expected.value_start);
  EXPECT_EQ(tree.entry_start, expected.entry_start);
  EXPECT_EQ(tree.entry_offset, expected.entry_offset);
  EXPECT_EQ(tree.largest_panel, expected.largest_panel);
  EXPECT_EQ(tree.update_stack, expected.update_stack);
  EXPECT_EQ(tree.operations, expected.operations);
}

/// A graph in an order along the nodes of a tree.
struct Followed {
  NodeOrder order;
  std::vector<Index> place, node;  ///< of each vertex
  SymmetricPattern pattern;
};

Followed follow_faces(const Fronts& fronts, std::vector<Face> faces) {
  Followed out{{}, {}, fronts.tree.tree.node_of_row, {}};
  out.order =
      *order_along(fronts.tree.tree.parent, in_order(fronts.pattern.size()), out.node, faces);
  out.place = inverse_permutation(out.order.order);
  for (Face& face : faces) {
    for (Index& corner : face) corner = out.place[corner];
  }
  out.pattern = pattern_of_faces(fronts.pattern.size(), faces);
  return out;
}

/// Whether a vertex has other neighbours, or one of them or itself is in another node.
bool has_changed(const Followed& before, const Followed& now, Index vertex) {
  const auto around = [vertex](const Followed& graph) {
    std::set<std::pair<Index, Index>> found = {{vertex, graph.node[vertex]}};
    for (const Index row : graph.pattern.neighbors(graph.place[vertex])) {
      const Index neighbor = graph.order.order[row];
      found.insert({neighbor, graph.node[neighbor]});
    }
    return found;
  };
  return around(before) != around(now);
}

// Edges come and go, and vertices rise and return.
TEST(FrontTree, IsUpdatedToWhatItWouldBe) {
  const Fronts fronts(torus(40, 30, 0.4));
  Followed before = follow_faces(fronts, with_other_faces(fronts.pattern, 0, 0));
  FrontTree tree = build_front_tree(before.pattern, before.order, 1);
  int compared = 0;
  for (unsigned seed = 1; seed < 30; ++seed) {
    Followed now = follow_faces(fronts, with_other_faces(fronts.pattern, 0, seed));
    const FrontTree expected = build_front_tree(now.pattern, now.order, 1, &tree);
    if (expected.tree.parent == tree.tree.parent) {
      std::vector<Index> number;
      std::vector<char> changed;
      for (const Index vertex : now.order.order) {
        number.push_back(before.place[vertex]);
        changed.push_back(has_changed(before, now, vertex) ? 1 : 0);
      }
      ASSERT_LT(std::ranges::count(changed, 1), now.pattern.size() / 2);
      expect_same_tree(
          update_front_tree(lower_of(now.pattern, 1), now.order, tree, {number, changed}, 2),
          expected);
      ++compared;
    }
    before = std::move(now);
    tree = expected;
  }
  EXPECT_GT(compared, 20);
}

TEST(OrderAlong, LeavesVerticesWhereTheyAreWhereNothingChanges) {
  const Fronts fronts(torus(24, 16, 0.4));
  const EliminationTree& tree = fronts.tree.tree;
  std::vector<Index> node = tree.node_of_row;
  std::vector<Face> faces;
  for (Index i = 0; i < fronts.pattern.size(); ++i) {
    for (const Index j : fronts.pattern.neighbors(i)) faces.push_back({i, j, j});
  }
  const auto order = order_along(tree.parent, in_order(fronts.pattern.size()), node, faces);
  ASSERT_TRUE(order);
  EXPECT_EQ(node, tree.node_of_row);
  EXPECT_EQ(order->parent, tree.parent);
  EXPECT_EQ(order->first, fronts.tree.nodes.first);
}

TEST(OrderAlong, GivesUpWhereTreesAreJoined) {
  std::vector<Index> node = {0, 1, 2};
  const std::vector<Index> parent = {1, kNoIndex, kNoIndex};
  EXPECT_FALSE(order_along(parent, in_order(3), node, std::vector<Face>{{0, 2, 2}}));
  node = {0, 1, kNoIndex, kNoIndex};
  EXPECT_FALSE(order_along(parent, in_order(2), node, std::vector<Face>{{2, 3, 3}}));
}

// Some zeros are the price of fewer fronts; they weigh less the larger the mesh is.
TEST(FrontTree, StoresFewZeros) {
  const Fronts fronts(many_tasks());
  const auto below = count_columns(fronts.pattern).below;
  const auto entries = std::accumulate(below.begin(), below.end(), std::int64_t{0}) +
                       static_cast<std::int64_t>(below.size());
  EXPECT_GE(fronts.tree.value_start.back(), entries);
  EXPECT_LE(static_cast<double>(fronts.tree.value_start.back()),
            1.5 * static_cast<double>(entries));
}

TEST(FrontTree, IsTheSameForAnyNumberOfThreads) {
  const Draft draft = torus(150, 100, 0.4);
  const Fronts one(draft, 1), three(draft, 3);
  EXPECT_EQ(one.tree.place_in_parent, three.tree.place_in_parent);
  EXPECT_EQ(one.tree.entry_offset, three.tree.entry_offset);
}

void expect_sound_tasks(const FrontTree& tree) {
  Index next = 0;
  for (std::size_t t = 0; t < tree.tasks.size(); ++t) {
    const FrontTask& task = tree.tasks[t];
    EXPECT_EQ(task.begin, next);
    EXPECT_GT(task.end, task.begin);
    next = task.end;
    // Whole subtrees: only the last front's parent may lie outside, or there is none.
    for (Index s = task.begin; s + 1 < task.end; ++s) {
      const Index p = tree.tree.parent[s];
      EXPECT_TRUE(p == kNoIndex || p < task.end);
    }
    EXPECT_TRUE(task.children.empty() || task.end == task.begin + 1);
    for (const Index child : task.children) {
      EXPECT_LT(child, static_cast<Index>(t));
      EXPECT_EQ(tree.tree.parent[tree.tasks[child].end - 1], task.begin);
      EXPECT_EQ(tree.tasks[child].parent, static_cast<Index>(t));
    }
  }
  EXPECT_EQ(next, tree.count());
}

TEST(FrontTasks, CoverTheTreeByWholeSubtrees) {
  expect_sound_tasks(Fronts(many_tasks()).tree);
  expect_sound_tasks(Fronts(sphere(2)).tree);
  // Large and small components in turns.
  Draft draft = torus(90, 60, 0.4);
  for (int k = 0; k < 6; ++k) {
    append(draft, sphere(1));
    append(draft, torus(50, 40, 0.4));
  }
  expect_sound_tasks(Fronts(draft).tree);
}

TEST(FrontTasks, AreWorkedOnInOrderByManyThreads) {
  const Fronts fronts(many_tasks());
  const auto& tasks = fronts.tree.tasks;
  for (const auto direction : {TaskQueue::Direction::kUp, TaskQueue::Direction::kDown}) {
    std::vector<std::atomic<int>> done(tasks.size());
    std::atomic<int> early{0};
    run_tasks(
        fronts.tree, direction, 5, [] { return 0; },
        [&](const FrontTask& task, Index number, int) {
          if (direction == TaskQueue::Direction::kUp) {
            for (const Index child : task.children) early += done[child] == 0;
          } else if (task.parent != kNoIndex) {
            early += done[task.parent] == 0;
          }
          ++done[number];
          return true;
        });
    EXPECT_EQ(early, 0);
    for (const auto& count : done) EXPECT_EQ(count, 1);
  }
}

TEST(FrontTasks, HandOnWhatIsThrown) {
  const Fronts fronts(many_tasks());
  EXPECT_THROW(run_tasks(
                   fronts.tree, TaskQueue::Direction::kUp, 3, [] { return 0; },
                   [](const FrontTask&, Index number, int) -> bool {
                     if (number == 5) throw std::bad_alloc();
                     return true;
                   }),
               std::bad_alloc);
}

}  // namespace
}  // namespace geotherm::test
