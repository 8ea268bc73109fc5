// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <queue>

#include "geotherm/build_method.h"
#include "geotherm/domains.h"
#include "tests/support/dice.h"

// Fast marching on grids from several sources and through several speeds, against closed forms.
namespace geotherm::test {
namespace {

DistanceResult marched_on(const Grid& grid, const SourceSet& sources) {
  MethodOptions options;
  options.method = MethodKind::kFastMarching;
  const auto method = build_method(std::make_shared<const Grid>(grid), options);
  return *(*method)->solve(sources, {.nearest = true});
}

Grid samples_of(Index x, Index y, Index z) { return {{x, y, z}, {1, 1, 1}, Vec3::Zero(), {}}; }

/// The nearest source in a straight line.
double nearest_line(const Grid& grid, const std::vector<Index>& sources, Index v) {
  double least = kUnreached;
  for (const Index source : sources) {
    least = std::min(least, (grid.position(source) - grid.position(v)).norm());
  }
  return least;
}

TEST(GridSources, InOpenGridsEachSampleHasTheLineToTheNearest) {
  Dice dice(29);
  for (const Grid& grid : {samples_of(41, 41, 1), samples_of(15, 14, 13)}) {
    for (const int count : {2, 2, 2, 2, 5, 5, 5, 20}) {
      std::vector<Index> sources;
      for (int i = 0; i < count; ++i) {
        sources.push_back(static_cast<Index>(dice.between(0, grid.sample_count() - 1)));
      }
      const DistanceResult d = marched_on(grid, SourceSet::of_vertices(sources));
      for (Index v = 0; v < grid.sample_count(); ++v) {
        const double line = nearest_line(grid, sources, v);
        ASSERT_NEAR(d.distances[v], line, 1e-12) << v << " of " << count;
        const Vec3 to = grid.position(sources[d.nearest_source[v]]) - grid.position(v);
        ASSERT_NEAR(to.norm(), line, 1e-12) << "the label of " << v;
      }
    }
  }
}

TEST(GridSources, OfSourcesAsNearAsEachOtherTheFirstIsNamed) {
  const Grid grid = samples_of(33, 9, 1);
  const DistanceResult d = marched_on(grid, SourceSet::of_vertices({32, 0}));
  EXPECT_EQ(d.nearest_source[grid.number({16, 0, 0})], 0);
  EXPECT_EQ(d.nearest_source[grid.number({16, 5, 0})], 0);
}

TEST(GridSources, OfManySideBySideTheNearestIsFoundAsWell) {
  Grid disc = samples_of(101, 101, 1);
  disc.speeds.assign(101 * 101, 0.0);
  std::vector<Index> rim;
  for (Index v = 0; v < disc.sample_count(); ++v) {
    const double radius = (disc.position(v) - Vec3(50, 50, 0)).norm();
    if (radius < 48) disc.speeds[v] = 1;
    if (radius < 48 && radius > 46.5) rim.push_back(v);
  }
  ASSERT_GT(rim.size(), 200U);
  const DistanceResult d = marched_on(disc, SourceSet::of_vertices(rim));
  double off = 0, sum = 0;
  for (Index v = 0; v < disc.sample_count(); ++v) {
    if (!(disc.speeds[v] > 0)) continue;
    const double line = nearest_line(disc, rim, v);
    ASSERT_GE(d.distances[v], line - 1e-12);
    ASSERT_LE(d.distances[v], line * 1.01 + 1e-12);
    off += d.distances[v] - line;
    sum += line;
  }
  EXPECT_LE(off, 1e-4 * sum);
}

TEST(GridSources, SamplesThatSeeTheirSourcePastAWallHaveTheLine) {
  Grid grid = samples_of(41, 41, 1);
  grid.speeds.assign(41 * 41, 1.0);
  for (Index y = 0; y <= 20; ++y) grid.speeds[grid.number({20, y, 0})] = 0;
  const Vec3 source(5, 9, 0), tip(19, 21, 0);
  const DistanceResult d = marched_on(grid, SourceSet::of_vertices({grid.number({5, 9, 0})}));
  for (Index v = 0; v < grid.sample_count(); ++v) {
    const Vec3 to = grid.position(v) - source, to_tip = tip - source;
    const bool sees = grid.position(v).x() < 20 || to_tip.x() * to.y() >= to_tip.y() * to.x();
    if (sees && grid.speeds[v] > 0) {
      ASSERT_NEAR(d.distances[v], to.norm(), 1e-12) << v;
    }
  }
}

/// The least time along the edges of the grid, each with the mean slowness of its ends.
std::vector<double> along_edges(const Grid& grid, Index source) {
  std::vector<double> time(static_cast<std::size_t>(grid.sample_count()), kUnreached);
  std::priority_queue<std::pair<double, Index>> queue;
  queue.push({0, source});
  time[source] = 0;
  while (!queue.empty()) {
    const auto [negative, v] = queue.top();
    queue.pop();
    if (-negative > time[v]) continue;
    const auto at = grid.place(v);
    for (const auto& [x, y] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
      if (at[0] + x < 0 || at[0] + x >= grid.size[0] || at[1] + y < 0 ||
          at[1] + y >= grid.size[1]) {
        continue;
      }
      const Index w = grid.number({at[0] + x, at[1] + y, 0});
      const double there = time[v] + (1 / grid.speed(v) + 1 / grid.speed(w)) / 2;
      if (there >= time[w]) continue;
      time[w] = there;
      queue.push({-there, w});
    }
  }
  return time;
}

TEST(GridSpeeds, NoSampleIsReachedLaterThanAlongEdges) {
  for (const double fast : {2.0, 20.0, 1000.0}) {
    for (const Index slow_rows : {4, 7, 13}) {
      Grid grid = samples_of(41, 41, 1);
      for (Index v = 0; v < grid.sample_count(); ++v) {
        grid.speeds.push_back(grid.place(v)[1] < slow_rows ? 1 : fast);
      }
      const auto most = along_edges(grid, 0);
      const DistanceResult d = marched_on(grid, SourceSet::of_vertices({0}));
      for (Index v = 0; v < grid.sample_count(); ++v) {
        ASSERT_LE(d.distances[v], most[v] * (1 + 1e-12)) << v << " of " << slow_rows;
      }
    }
  }
}

TEST(GridSpeeds, ErrorsOfSmoothSpeedsFallFasterThanTheSpacing) {
  constexpr double kSlope = 0.05, kSide = 60;
  double before = 1;
  for (const Index n : {31, 61, 121, 241}) {
    const double h = kSide / (n - 1);
    Grid grid{{n, n, 1}, {h, h, 1}, Vec3::Zero(), {}};
    for (Index v = 0; v < grid.sample_count(); ++v) {
      grid.speeds.push_back(1 + kSlope * grid.position(v).y());
    }
    // On the slow border, along which all samples have one speed.
    const Index source = grid.number({(n - 1) / 2, 0, 0});
    const DistanceResult d = marched_on(grid, SourceSet::of_vertices({source}));
    double most = 0, range = 0;
    for (Index v = 0; v < grid.sample_count(); ++v) {
      const double square = (grid.position(v) - grid.position(source)).squaredNorm();
      const double exact = std::acosh(1 + kSlope * kSlope * square / (2 * grid.speeds[v])) / kSlope;
      most = std::max(most, std::abs(d.distances[v] - exact));
      range = std::max(range, exact);
    }
    EXPECT_LE(most / range, 0.45 * before) << n;
    before = most / range;
  }
  EXPECT_LE(before, 2e-4);  // 1.5 % where lines of sight hide faster ways
}

}  // namespace
}  // namespace geotherm::test
