// SPDX-License-Identifier: MIT
#include "solver/mesh/generate/erosion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <queue>
#include <utility>

namespace geotherm::generate {
namespace {

struct Neighbour {
  int column, row;
  double way;
};
constexpr double kDiagonal = 1.4142135623730951;
constexpr std::array<Neighbour, 8> kNeighbours = {{{1, 0, 1},
                                                   {0, 1, 1},
                                                   {-1, 0, 1},
                                                   {0, -1, 1},
                                                   {1, 1, kDiagonal},
                                                   {-1, 1, kDiagonal},
                                                   {-1, -1, kDiagonal},
                                                   {1, -1, kDiagonal}}};

bool on_border(const HeightGrid& grid, int column, int row) {
  return row == 0 || column == 0 || row == grid.side - 1 || column == grid.side - 1;
}

/// Where each point drains to, and an order in which every point comes after the one it drains to.
struct Drainage {
  std::vector<int> receiver;
  std::vector<double> way;  ///< to the receiver
  std::vector<int> upstream;
};

void find_receivers(const HeightGrid& grid, Drainage& drainage) {
  const int side = grid.side;
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      const std::size_t here = grid.index(column, row);
      drainage.receiver[here] = static_cast<int>(here);
      drainage.way[here] = grid.step;
      if (on_border(grid, column, row)) continue;
      double steepest = 0;
      for (const Neighbour& to : kNeighbours) {
        const std::size_t there = grid.index(column + to.column, row + to.row);
        const double slope = (grid.heights[here] - grid.heights[there]) / to.way;
        if (slope <= steepest) continue;
        steepest = slope;
        drainage.receiver[here] = static_cast<int>(there);
        drainage.way[here] = to.way * grid.step;
      }
    }
  }
}

void order_upstream(Drainage& drainage) {
  const std::size_t count = drainage.receiver.size();
  std::vector<int> first(count + 1, 0);  // the points that drain to each
  for (std::size_t i = 0; i < count; ++i)
    ++first[static_cast<std::size_t>(drainage.receiver[i]) + 1];
  for (std::size_t i = 0; i < count; ++i) first[i + 1] += first[i];
  std::vector<int> donors(count);
  std::vector<int> filled(first.begin(), first.end() - 1);
  for (std::size_t i = 0; i < count; ++i) {
    const auto to = static_cast<std::size_t>(drainage.receiver[i]);
    donors[static_cast<std::size_t>(filled[to]++)] = static_cast<int>(i);
  }
  drainage.upstream.clear();
  for (std::size_t mouth = 0; mouth < count; ++mouth) {
    if (drainage.receiver[mouth] != static_cast<int>(mouth)) continue;
    std::size_t next = drainage.upstream.size();
    drainage.upstream.push_back(static_cast<int>(mouth));
    for (; next < drainage.upstream.size(); ++next) {  // breadth first
      const int point = drainage.upstream[next];
      for (int k = first[static_cast<std::size_t>(point)];
           k < first[static_cast<std::size_t>(point) + 1]; ++k) {
        const int donor = donors[static_cast<std::size_t>(k)];
        if (donor != point) drainage.upstream.push_back(donor);
      }
    }
  }
}

void slide(HeightGrid& grid, double steepest) {
  const std::vector<double> before = grid.heights;
  for (int row = 1; row + 1 < grid.side; ++row) {
    for (int column = 1; column + 1 < grid.side; ++column) {
      const std::size_t here = grid.index(column, row);
      double sum = 0;
      for (const Neighbour& to : kNeighbours) {
        const double drop = before[here] - before[grid.index(column + to.column, row + to.row)];
        const double allowed = steepest * to.way * grid.step;
        sum += std::clamp(drop, -allowed, allowed) - drop;
      }
      grid.heights[here] += sum / 8;
    }
  }
}

/// Raises the ground of every hollow so that all of it drains to the border (priority flood).
void fill_hollows(HeightGrid& grid) {
  using Shore = std::pair<double, int>;  // lowest first; of equals the lower number
  std::priority_queue<Shore, std::vector<Shore>, std::greater<>> shore;
  std::vector<bool> seen(grid.heights.size(), false);
  for (int i = 0; i < static_cast<int>(grid.heights.size()); ++i) {
    if (!on_border(grid, i % grid.side, i / grid.side)) continue;
    seen[static_cast<std::size_t>(i)] = true;
    shore.emplace(grid.heights[static_cast<std::size_t>(i)], i);
  }
  while (!shore.empty()) {
    const auto [level, point] = shore.top();
    shore.pop();
    const int column = point % grid.side;
    const int row = point / grid.side;
    for (const Neighbour& to : kNeighbours) {
      const int c = column + to.column;
      const int r = row + to.row;
      if (c < 0 || r < 0 || c >= grid.side || r >= grid.side || seen[grid.index(c, r)]) continue;
      seen[grid.index(c, r)] = true;
      grid.at(c, r) = std::max(grid.at(c, r), level + 1e-4 * to.way * grid.step);
      shore.emplace(grid.at(c, r), static_cast<int>(grid.index(c, r)));
    }
  }
}

}  // namespace

double HeightGrid::interpolate(double column, double row) const {
  const auto blend = [](double a, double b, double c, double d, double t) {
    return b + 0.5 * t * ((c - a) + t * ((2 * a - 5 * b + 4 * c - d) + t * (3 * (b - c) + d - a)));
  };
  const auto inside = [&](int i) { return std::clamp(i, 0, side - 1); };
  const double x = std::clamp(column, 0.0, side - 1.0);
  const double y = std::clamp(row, 0.0, side - 1.0);
  const int i = std::min(static_cast<int>(x), side - 2);
  const int j = std::min(static_cast<int>(y), side - 2);
  std::array<double, 4> rows{};
  for (int k = 0; k < 4; ++k) {
    const int r = inside(j + k - 1);
    rows[static_cast<std::size_t>(k)] =
        blend(at(inside(i - 1), r), at(i, r), at(i + 1, r), at(inside(i + 2), r), x - i);
  }
  return blend(rows[0], rows[1], rows[2], rows[3], y - j);
}

void erode(HeightGrid& grid, const std::vector<double>& uplift, double rate, double steepest,
           int rounds) {
  const std::size_t count = grid.heights.size();
  Drainage drainage{std::vector<int>(count), std::vector<double>(count), {}};
  std::vector<double> area(count);
  fill_hollows(grid);
  for (int round = 0; round < rounds; ++round) {
    find_receivers(grid, drainage);
    order_upstream(drainage);
    std::fill(area.begin(), area.end(), grid.step * grid.step);
    for (std::size_t i = count; i-- > 0;) {
      const auto point = static_cast<std::size_t>(drainage.upstream[i]);
      const auto to = static_cast<std::size_t>(drainage.receiver[point]);
      if (to != point) area[to] += area[point];
    }
    for (const int p : drainage.upstream) {
      const auto point = static_cast<std::size_t>(p);
      const auto to = static_cast<std::size_t>(drainage.receiver[point]);
      if (on_border(grid, p % grid.side, p / grid.side)) continue;
      double& height = grid.heights[point];
      height += uplift[point];
      if (to == point) continue;
      const double cut = rate * std::sqrt(area[point]) / drainage.way[point];
      height = std::max((height + cut * grid.heights[to]) / (1 + cut), grid.heights[to]);
    }
    slide(grid, steepest);
  }
}

}  // namespace geotherm::generate
