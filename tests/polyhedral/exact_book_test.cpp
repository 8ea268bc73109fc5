// SPDX-License-Identifier: MIT
// Three flat pages at one spine: every edge of the spine has three faces.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "tests/polyhedral/exact_fixture.h"

namespace geotherm::test {
namespace {

constexpr Index kWide = 4;
constexpr Index kSheet = (kWide + 1) * (kWide + 1);

/// Unit squares that share the column x = 0, each turned by a third of a circle.
struct Book {
  Draft draft;
  std::vector<Vec3> flat;  ///< places of the vertices on their pages
  std::vector<int> page;

  explicit Book(unsigned seed) {
    for (int turn = 0; turn < 3; ++turn) {
      const double u = 2 * std::numbers::pi * turn / 3;
      const Draft sheet = jittered_plane(kWide, 0.3, seed + static_cast<unsigned>(turn));
      const Index first = draft.vertex_count();
      for (const Vec3& p : sheet.positions) {
        flat.push_back(p);
        page.push_back(turn);
        draft.add({p.x() * std::cos(u), p.x() * std::sin(u), p.y()});
      }
      for (Face face : sheet.faces) {
        for (Index& v : face) v = v % (kWide + 1) == 0 ? v : v + first;
        draft.faces.push_back(face);
      }
    }
  }

  /// The spine's vertices are those of the first page.
  bool in_use(Index v) const { return v < kSheet || v % kSheet % (kWide + 1) != 0; }

  double between(Index v, Index w) const {
    const Vec3 &p = flat[v], &q = flat[w];
    const double across = page[v] == page[w] ? p.x() - q.x() : p.x() + q.x();
    return std::hypot(across, p.y() - q.y());
  }

  void expect_least(const SourceSet& set) const {
    const auto d = exact_distances(finish(draft), set);
    for (Index v = 0; v < 3 * kSheet; ++v) {
      if (!in_use(v)) continue;
      double least = kUnreached;
      for (std::size_t i = 0; i < set.points.size(); ++i) {
        least = std::min(least, set.offsets[i] + between(set.points[i].vertex, v));
      }
      EXPECT_NEAR(d[v], least, kRoundOff) << "vertex " << v;
    }
  }
};

class ExactInABook : public testing::TestWithParam<unsigned> {};

TEST_P(ExactInABook, UnfoldsAnyTwoPages) {
  const Book book(GetParam());
  const auto method = exact_method(finish(book.draft));
  for (const Index source : {Index{7}, kSheet + 17, 2 * kSheet + 23}) {
    const auto d = solve_exactly(*method, SourceSet::of_vertices({source})).distances;
    for (Index v = 0; v < 3 * kSheet; ++v) {
      if (!book.in_use(v)) continue;
      EXPECT_NEAR(d[v], book.between(source, v), kRoundOff) << "vertex " << v;
    }
  }
}

TEST_P(ExactInABook, GivesTheLeastSumWhereWavesOfTwoPagesMeetOnTheThird) {
  const Book book(GetParam());
  std::mt19937 random(GetParam());
  std::uniform_real_distribution<double> offset(0, 0.5);
  SourceSet set;
  while (set.points.size() < 6) {
    const auto v = static_cast<Index>(random() % (2 * kSheet));
    if (!book.in_use(v)) continue;
    set.points.push_back(SurfacePoint::at_vertex(v));
    set.offsets.push_back(offset(random));
  }
  book.expect_least(set);
}

TEST_P(ExactInABook, AWaveThatIsAheadByAHairOnTheThirdPageLeavesTheOtherTheRest) {
  const Book book(GetParam());
  std::mt19937 random(GetParam());
  std::uniform_real_distribution<double> uniform(0, 1);
  // Far from the spine on the first page, and nearer to it on the second in front of that.
  SourceSet set =
      SourceSet::of_vertices({grid_vertex(kWide, kWide, static_cast<Index>(GetParam()) % kWide)});
  set.offsets = {0};
  for (Index v = kSheet; v < 2 * kSheet; ++v) {
    if (!book.in_use(v) || random() % 8 != 0) continue;
    const double r = uniform(random);
    set.points.push_back(SurfacePoint::at_vertex(v));
    set.offsets.push_back((book.flat[v] - book.flat[set.points[0].vertex]).norm() *
                          (1 - 0.1 * r * r));
  }
  book.expect_least(set);
}

// Among them two (407, 452) where a wave needs what passes another source on either side.
INSTANTIATE_TEST_SUITE_P(Seeds, ExactInABook, testing::Range(401U, 461U));

}  // namespace
}  // namespace geotherm::test
