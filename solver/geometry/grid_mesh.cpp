// SPDX-License-Identifier: MIT
#include "solver/geometry/grid_mesh.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "solver/core/parallel.h"
#include "solver/core/text.h"

namespace geotherm {
namespace {

/// Minimum rows per thread.
constexpr std::int64_t kGridRowGrain = 1 << 12;

Error bad_grid(std::string message) { return {ErrorCode::kBadInput, std::move(message)}; }

/// slowness^power for the few whole powers that there are.
double power_of(double slowness, int power) {
  if (slowness == 1 || power == 0) return 1;
  return power < 0 ? 1 / slowness : power == 1 ? slowness : std::pow(slowness, power);
}

}  // namespace

namespace {

/// Squares and quotients of such numbers neither under- nor overflow.
bool is_in_range(double value) { return value >= 1e-100 && value <= 1e100; }

}  // namespace

Result<void> check_grid(const Grid& grid) {
  std::int64_t samples = 1;
  for (std::size_t e = 0; e < 3; ++e) {
    if (grid.size[e] < 1) {
      return bad_grid("the grid is " + std::to_string(grid.size[0]) + " x " +
                      std::to_string(grid.size[1]) + " x " + std::to_string(grid.size[2]) +
                      " samples; each must be 1 or more");
    }
    samples *= grid.size[e];
    if (samples > kMaxGridSamples) {
      return bad_grid("the grid has more than " + std::to_string(kMaxGridSamples) + " samples");
    }
    const double spacing = grid.spacing[e];
    if (!is_in_range(std::abs(spacing)) ||
        !std::isfinite(grid.origin[static_cast<Eigen::Index>(e)])) {
      return bad_grid("axis " + std::to_string(e) + " of the grid has a spacing of " +
                      rounded_text(spacing) + " from " +
                      rounded_text(grid.origin[static_cast<Eigen::Index>(e)]) +
                      " on; its size must be from 1e-100 to 1e100");
    }
  }
  if (!grid.speeds.empty() && std::ssize(grid.speeds) != samples) {
    return bad_grid("there are " + std::to_string(grid.speeds.size()) + " speeds for " +
                    std::to_string(samples) + " samples");
  }
  for (std::size_t i = 0; i < grid.speeds.size(); ++i) {
    if (grid.speeds[i] == 0 || is_in_range(grid.speeds[i])) continue;
    return bad_grid("the speed of sample " + std::to_string(i) + " is " +
                    rounded_text(grid.speeds[i]) +
                    "; it must be 0, which is wall, or from 1e-100 to 1e100");
  }
  std::int64_t stride = 1;
  for (const Index length : grid.size) {
    for (std::int64_t v = 0; v < samples; ++v) {
      if (v / stride % length + 1 == length) continue;
      const auto here = static_cast<Index>(v), next = static_cast<Index>(v + stride);
      if (grid.speed(here) > 0 && grid.speed(next) > 0) return {};
    }
    stride *= length;
  }
  return bad_grid("no two neighbouring samples of the grid pass");
}

template <class Body>
void GridLattice::for_cells_at(Index sample, int e, const Body& body) const {
  // Their lowest corners are here, or one step back along axes other than the edge's.
  for (int k = 0; k < 1 << dimension_; ++k) {
    if (e != kNoIndex && (k >> e & 1) != 0) continue;
    Index lowest = sample;
    bool inside = true;
    for (int f = 0; f < dimension_; ++f) {
      if ((k >> f & 1) == 0) continue;
      inside = inside && !at_start(sample, f);
      lowest -= stride_[f];
    }
    if (inside && has_cell(lowest)) body(lowest);
  }
}

GridLattice::GridLattice(std::shared_ptr<const Grid> grid) : grid_(std::move(grid)) {
  Index stride = 1;
  for (std::size_t e = 0; e < 3; ++e) {
    const Index length = grid_->size[e];
    if (length > 1) {
      spacing_[dimension_] = std::abs(grid_->spacing[e]);
      stride_[dimension_] = stride;
      length_[dimension_++] = length;
    }
    stride *= length;
  }
  uniform_ = std::ranges::all_of(grid_->speeds, [](double f) { return f == 0 || f == 1; });
  double first = 0;
  for (const double speed : grid_->speeds) {
    if (first == 0) first = speed;
    one_speed_ = one_speed_ && (speed == 0 || speed == first);
  }
  bits_.assign(static_cast<std::size_t>(stride), 0);
  for (Index v = 0; v < stride; ++v) {
    bool whole = true;
    for (int e = 0; e < dimension_ && whole; ++e) whole = !at_end(v, e);
    for (int k = 0; k < 1 << dimension_ && whole; ++k) {
      Index corner = v;
      for (int e = 0; e < dimension_; ++e) corner += (k >> e & 1) * stride_[e];
      whole = grid_->speed(corner) > 0;
    }
    bits_[v] = whole ? 1 : 0;
    cells_ += whole ? 1 : 0;
  }
  for (Index v = 0; v < stride; ++v) {
    for (int e = 0; e < dimension_; ++e) {
      if (!has_edge(v, e)) continue;
      bool alone = true;
      for_cells_at(v, e, [&alone](Index) { alone = false; });
      if (!alone) continue;
      bits_[v] |= static_cast<std::uint8_t>(2 << e);
      ++cells_;
    }
  }
}

double GridLattice::mean_spacing() const {
  return (spacing_[0] + spacing_[1] + spacing_[2]) / dimension_;
}

double GridLattice::measure() const {
  double product = 1;
  for (int e = 0; e < dimension_; ++e) product *= spacing_[e];
  return product;
}

bool is_same_slowness(double slowness, double other) {
  constexpr double kRoundOff = 1e-12;
  return std::abs(slowness - other) <= kRoundOff * other;
}

bool GridLattice::passes(const std::array<Index, 3>& cell_at, const GridPlace& way,
                         double slowness) const {
  for (int side = 0; side < 1 << dimension_; ++side) {
    Index lowest = 0;
    bool is_there = true;
    for (int e = 0; e < dimension_; ++e) {
      const bool before = (side >> e & 1) != 0;
      const Index at = cell_at[e] - (before ? 1 : 0);
      is_there = is_there && !(before && way[e] != 0) && at >= 0 && at + 1 < length_[e];
      lowest += at * stride_[e];
    }
    if (!is_there || !has_cell(lowest)) continue;
    if (one_speed_ || is_same_slowness(cell(lowest).slowness, slowness)) return true;
  }
  return false;
}

bool GridLattice::has_edge(Index sample, int e) const {
  return grid_->speed(sample) > 0 && !at_end(sample, e) && grid_->speed(sample + stride_[e]) > 0;
}

int GridLattice::cells_at(Index sample) const {
  int count = 0;
  for_cells_at(sample, kNoIndex, [&count](Index) { ++count; });
  return count;
}

GridCell GridLattice::cell(Index sample) const {
  GridCell out{{}, 1 << dimension_, -1, 1};
  double sum = 0;
  for (int k = 0; k < out.count; ++k) {
    Index corner = sample;
    for (int e = 0; e < dimension_; ++e) corner += (k >> e & 1) * stride_[e];
    out.corners[static_cast<std::size_t>(k)] = corner;
    if (!uniform_) sum += slowness(corner);
  }
  if (!uniform_) out.slowness = sum / out.count;
  return out;
}

GridCell GridLattice::edge(Index sample, int e) const {
  const Index next = sample + stride_[e];
  return {{sample, next}, 2, e, (slowness(sample) + slowness(next)) / 2};
}

double GridLattice::edge_weight(Index sample, int e) const {
  if ((bits_[sample] >> (e + 1) & 1) != 0) {
    return power_of(edge(sample, e).slowness, dimension_ - 2);
  }
  double sum = 0;
  for_cells_at(sample, e, [&](Index lowest) {
    sum += uniform_ ? 1 : power_of(cell(lowest).slowness, dimension_ - 2);
  });
  return sum / (1 << (dimension_ - 1));
}

CellPattern pattern_of_grid(const GridLattice& lattice) {
  CellPattern out;
  const Index samples = lattice.grid().sample_count();
  out.local.assign(static_cast<std::size_t>(samples), kNoIndex);
  const auto is_behind = [&](Index v, int e) {
    const Index before = v - lattice.stride(e);
    return before >= 0 && lattice.has_edge(before, e);
  };
  for (Index v = 0; v < samples; ++v) {
    bool used = false;
    for (int e = 0; e < lattice.dimension() && !used; ++e) {
      used = lattice.has_edge(v, e) || is_behind(v, e);
    }
    if (!used) continue;
    out.local[v] = static_cast<Index>(out.vertices.size());
    out.vertices.push_back(v);
  }
  SymmetricPattern& pattern = out.pattern;
  pattern.start.reserve(out.vertices.size() + 1);
  pattern.neighbor.reserve(2 * out.vertices.size() * static_cast<std::size_t>(lattice.dimension()));
  for (const Index v : out.vertices) {
    for (int e = lattice.dimension() - 1; e >= 0; --e) {
      if (is_behind(v, e)) pattern.neighbor.push_back(out.local[v - lattice.stride(e)]);
    }
    for (int e = 0; e < lattice.dimension(); ++e) {
      if (lattice.has_edge(v, e)) pattern.neighbor.push_back(out.local[v + lattice.stride(e)]);
    }
    pattern.start.push_back(std::ssize(pattern.neighbor));
  }
  out.parts = connected_components(pattern);
  return out;
}

std::shared_ptr<const CellMatrix> build_grid_matrix(const GridLattice& lattice,
                                                    const CellPattern& pattern,
                                                    std::span<const Index> order, double unit,
                                                    double mean_measure, int threads) {
  auto out = std::make_shared<CellMatrix>();
  const auto size = static_cast<Index>(order.size());
  const std::vector<Index> position = inverse_permutation(order, threads);
  out->pattern = pattern_hash(permuted_lower(pattern.pattern, order, threads), threads);
  name_components(pattern.parts, order, out->components);

  const double relative = lattice.measure() / mean_measure;
  const int d = lattice.dimension();
  out->mass.assign(order.size(), 0.0);
  lattice.for_each_cell(0, lattice.layer_count(), [&](const GridCell& cell) {
    const double share = relative * power_of(cell.slowness, d) / cell.count;
    for (int k = 0; k < cell.count; ++k) {
      out->mass[position[pattern.local[cell.corners[static_cast<std::size_t>(k)]]]] += share;
    }
  });

  out->row_start.assign(order.size() + 1, 0);
  for (Index i = 0; i < size; ++i) {
    out->row_start[i + 1] = out->row_start[i] + std::ssize(pattern.pattern.neighbors(order[i]));
  }
  out->column.resize(static_cast<std::size_t>(out->row_start.back()));
  out->entry.resize(out->column.size());
  parallel_each(threads, size, kGridRowGrain, [&](std::int64_t i) {
    const Index v = pattern.vertices[order[i]];
    std::array<std::pair<Index, double>, 6> row;
    std::size_t count = 0;
    for (const Index j : pattern.pattern.neighbors(order[i])) {
      const Index w = pattern.vertices[j];
      int e = 0;
      while (lattice.stride(e) != std::abs(w - v)) ++e;
      const double length = lattice.spacing(e) / unit;
      row[count++] = {position[j],
                      -relative * lattice.edge_weight(std::min(v, w), e) / (length * length)};
    }
    std::sort(row.begin(), row.begin() + static_cast<std::ptrdiff_t>(count));
    for (std::size_t k = 0; k < count; ++k) {
      out->column[static_cast<std::size_t>(out->row_start[i]) + k] = row[k].first;
      out->entry[static_cast<std::size_t>(out->row_start[i]) + k] = row[k].second;
    }
  });
  return out;
}

}  // namespace geotherm
