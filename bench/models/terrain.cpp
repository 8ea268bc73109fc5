// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <queue>
#include <utility>

#include "bench/models/draft_mesh.h"

namespace geotherm::generate {
namespace {

/// A square grid of heights: `side` x `side` values, row by row, `step` apart.
struct HeightGrid {
  int side;
  double step;
  std::vector<double> heights;

  double& at(int column, int row) { return heights[index(column, row)]; }
  double at(int column, int row) const { return heights[index(column, row)]; }
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(side) +
           static_cast<std::size_t>(column);
  }
  /// Catmull-Rom interpolation at grid coordinates, which are clamped to the grid.
  double interpolate(double column, double row) const {
    const auto blend = [](double a, double b, double c, double d, double t) {
      return b +
             0.5 * t * ((c - a) + t * ((2 * a - 5 * b + 4 * c - d) + t * (3 * (b - c) + d - a)));
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
};

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

/// Rivers at work: `rounds` times the ground rises by `uplift` (per point), and rivers, which
/// follow the steepest descent, cut it: dh/dt = uplift - rate sqrt(drained area) slope, solved
/// implicitly from the mouths upwards (Braun & Willett 2013). The border keeps its height; hollows
/// are filled before, so that all of the ground drains to it. Slopes slide to at most `steepest`.
/// Cost: O(side^2) per round.
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

// Rivers are carved on a grid of this side whatever the size of the mesh, so that more faces show
// the same mountains.
constexpr int kSide = 144;
constexpr int kEpochs = 8;
constexpr int kRoundsPerEpoch = 12;

/// The landscape as a function: the eroded grid, and rock too fine for it.
class Landscape {
 public:
  Landscape() : grid_{kSide, 2.0 / (kSide - 1), {}}, uplift_(kSide * kSide) {
    grid_.heights.resize(uplift_.size());
    for (int row = 0; row < kSide; ++row) {
      for (int column = 0; column < kSide; ++column) {
        const Vec3 p(grid_.step * column - 1, 0, grid_.step * row - 1);
        const Vec3 bent = p + 0.22 * Vec3(gradient_noise(1.7 * p + Vec3(0, 3.5, 0), 31), 0,
                                          gradient_noise(1.7 * p + Vec3(0, 7.5, 0), 32));
        const double edge = std::pow(std::pow(p.x(), 4) + std::pow(p.z(), 4), 0.25);
        const double ridges = ridged_noise(1.35 * bent + Vec3(0.3, 0.4, 0.9), 5, 21);
        const double hills = fractal_noise(1.9 * p + Vec3(0, 0.5, 0), 4, 25);
        grid_.at(column, row) = 0.07 * hills + 0.06 * ridges;
        // The range runs across the square in a bow; foothills around it.
        const double off = bent.z() + 0.10 - 0.35 * bent.x() * bent.x() - 0.25 * bent.x();
        const double range = std::exp(-off * off / 0.22);
        uplift_[grid_.index(column, row)] =
            0.0062 * (0.20 + 0.50 * range + 0.55 * ridges) * (1 - smooth_step(0.65, 1.12, edge));
      }
    }
  }

  void erode_epoch() { erode(grid_, uplift_, 0.11, 1.0, kRoundsPerEpoch); }

  double height(double x, double z) const {
    const double ground = grid_.interpolate((x + 1) / grid_.step, (z + 1) / grid_.step);
    const Vec3 p(x, 0.31, z);
    const double rock = ridged_noise(7 * p, 3, 41) - 0.5;
    return ground + 0.05 * smooth_step(0.03, 0.4, ground) * rock;
  }

 private:
  HeightGrid grid_;
  std::vector<double> uplift_;
};

/// A grid of `columns` x `rows` squares whose inner points are shifted at random.
DraftMesh shaken_grid(int columns, int rows, const Landscape& land) {
  DraftMesh mesh;
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      const bool inner_x = i > 0 && i < columns;
      const bool inner_z = j > 0 && j < rows;
      const double x = i + (inner_x ? 0.6 * (hash_unit(i, j, 0, 51) - 0.5) : 0);
      const double z = j + (inner_z ? 0.6 * (hash_unit(i, j, 1, 51) - 0.5) : 0);
      const Vec3 p(2 * x / columns - 1, 0, 2 * z / rows - 1);
      mesh.positions.emplace_back(p.x(), land.height(p.x(), p.z()), p.z());
    }
  }
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const Index a = j * (columns + 1) + i;
      const Index b = a + 1;
      const Index c = a + columns + 1;
      const Index d = c + 1;
      if ((i + j) % 2 == 0) {
        mesh.faces.push_back({a, c, d});
        mesh.faces.push_back({a, d, b});
      } else {
        mesh.faces.push_back({a, c, b});
        mesh.faces.push_back({b, c, d});
      }
    }
  }
  return mesh;
}

}  // namespace

Result<DraftMesh> make_terrain(Index faces, const Progress& progress) {
  Landscape land;
  for (int epoch = 0; epoch < kEpochs; ++epoch) {
    if (!report(progress, "eroding", static_cast<double>(epoch) / kEpochs)) {
      return cancelled_error();
    }
    land.erode_epoch();
  }
  const int columns = static_cast<int>(std::lround(std::sqrt(faces / 2.0)));
  const int rows = static_cast<int>(std::lround(faces / (2.0 * columns)));
  DraftMesh mesh = shaken_grid(columns, rows, land);
  constexpr int kRounds = 4;
  for (int round = 0; round < kRounds; ++round) {
    if (!report(progress, "smoothing", static_cast<double>(round) / kRounds)) {
      return cancelled_error();
    }
    relax(mesh, [&](Index v, const Vec3& target, const Vec3&) -> Vec3 {
      const int i = v % (columns + 1);
      const int j = v / (columns + 1);
      if (i == 0 || j == 0 || i == columns || j == rows) {
        return mesh.positions[static_cast<std::size_t>(v)];
      }
      return {target.x(), land.height(target.x(), target.z()), target.z()};
    });
  }
  return mesh;
}

}  // namespace geotherm::generate
