// SPDX-License-Identifier: MIT
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <new>
#include <string>

#include "geotherm/domains.h"
#include "solver/core/text.h"

namespace geotherm {
namespace {

using Element = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// A square or a cube at speed 1. Corner k lies at +1 along axis e where bit e of k is set.
struct GridElement {
  int dimension = 0;
  double measure = 1, width = 0;
  Element gradient;    ///< corners x D, at the middle
  Element stabilizer;  ///< corners x corners: the stiffness of the bi- or trilinear element but for
                       ///< measure G' G
};

GridElement grid_element(int dimension, const std::array<double, 3>& spacing) {
  GridElement out;
  out.dimension = dimension;
  const int corners = 1 << dimension;
  for (int e = 0; e < dimension; ++e) {
    out.measure *= spacing[e];
    out.width += spacing[e] / dimension;
  }
  // The derivative along axis e at a point: signs along e, the other axes' hat functions.
  const auto gradients_at = [&](const std::array<double, 3>& point) {
    Element g(corners, dimension);
    for (int k = 0; k < corners; ++k) {
      for (int e = 0; e < dimension; ++e) {
        double value = ((k >> e & 1) != 0 ? 1 : -1) / spacing[e];
        for (int f = 0; f < dimension; ++f) {
          if (f != e) value *= (k >> f & 1) != 0 ? point[f] : 1 - point[f];
        }
        g(k, e) = value;
      }
    }
    return g;
  };
  out.gradient = gradients_at({0.5, 0.5, 0.5});
  // Two points of Gauss along each axis integrate the stiffness exactly.
  const std::array<double, 2> gauss = {0.5 - std::sqrt(1.0 / 12), 0.5 + std::sqrt(1.0 / 12)};
  Element stiffness = Element::Zero(corners, corners);
  for (int q = 0; q < corners; ++q) {
    std::array<double, 3> point{};
    for (int e = 0; e < dimension; ++e) point[e] = gauss[q >> e & 1];
    const Element g = gradients_at(point);
    stiffness += out.measure / corners * g * g.transpose();
  }
  out.stabilizer = stiffness - out.measure * out.gradient * out.gradient.transpose();
  return out;
}

Error bad_grid(std::string message) { return {ErrorCode::kBadInput, std::move(message)}; }

Result<void> check_grid(const Grid& grid) {
  std::int64_t samples = 1;
  for (int e = 0; e < 3; ++e) {
    if (grid.size[e] < 1) {
      return bad_grid("the grid is " + std::to_string(grid.size[0]) + " x " +
                      std::to_string(grid.size[1]) + " x " + std::to_string(grid.size[2]) +
                      " samples; each must be 1 or more");
    }
    samples *= grid.size[e];
    constexpr std::int64_t kMaxSamples = 1'000'000'000;
    if (samples > kMaxSamples) {
      return bad_grid("the grid has more than " + std::to_string(kMaxSamples) + " samples");
    }
    if (!(grid.spacing[e] > 0) || !std::isfinite(grid.spacing[e])) {
      return bad_grid("the spacing of the grid is " + rounded_text(grid.spacing[e]) +
                      "; it must be above 0");
    }
  }
  if (!grid.speeds.empty() && std::ssize(grid.speeds) != samples) {
    return bad_grid("there are " + std::to_string(grid.speeds.size()) + " speeds for " +
                    std::to_string(samples) + " samples");
  }
  for (std::size_t i = 0; i < grid.speeds.size(); ++i) {
    if (grid.speeds[i] >= 0 && std::isfinite(grid.speeds[i])) continue;
    return bad_grid("the speed of sample " + std::to_string(i) + " is " +
                    rounded_text(grid.speeds[i]) + "; it must be 0 or more");
  }
  return {};
}

/// Walks over the lattice and adds what passes.
class GridCells {
 public:
  explicit GridCells(const Grid& grid) : grid_(grid) {
    axes_.clear();
    for (int e = 0; e < 3; ++e) {
      if (grid.size[e] > 1) axes_.push_back(e);
    }
    std::array<double, 3> spacing{};
    for (std::size_t e = 0; e < axes_.size(); ++e) spacing[e] = grid.spacing[axes_[e]];
    element_ = grid_element(static_cast<int>(axes_.size()), spacing);
    out_.cell_name = "cell";
    out_.cells_name = "cells";
    out_.dimension = static_cast<int>(axes_.size());
    out_.start.push_back(0);
    out_.vertices = grid.size[0] * grid.size[1] * grid.size[2];
  }

  CellComplex make() {
    for_each_sample([this](const std::array<Index, 3>& at) {
      out_.positions.push_back(grid_.origin + Vec3(at[0] * grid_.spacing[0],
                                                   at[1] * grid_.spacing[1],
                                                   at[2] * grid_.spacing[2]));
    });
    cells_at_.assign(static_cast<std::size_t>(out_.vertices), 0);
    in_cell_.assign(static_cast<std::size_t>(out_.vertices) * axes_.size(), 0);
    for_each_sample([this](const std::array<Index, 3>& at) { add_cell(at); });
    for_each_sample([this](const std::array<Index, 3>& at) { add_edges(at); });
    // A sample that is a corner of fewer cells than one inside lies on the boundary.
    for (const char count : cells_at_) out_.on_boundary.push_back(count < 1 << axes_.size());
    return std::move(out_);
  }

 private:
  template <class Work>
  void for_each_sample(const Work& work) const {
    for (Index z = 0; z < grid_.size[2]; ++z) {
      for (Index y = 0; y < grid_.size[1]; ++y) {
        for (Index x = 0; x < grid_.size[0]; ++x) work(std::array<Index, 3>{x, y, z});
      }
    }
  }
  Index number(const std::array<Index, 3>& at) const {
    return at[0] + grid_.size[0] * (at[1] + grid_.size[1] * at[2]);
  }
  double speed(Index sample) const { return grid_.speeds.empty() ? 1 : grid_.speeds[sample]; }

  /// The cell whose lowest corner this is.
  void add_cell(const std::array<Index, 3>& at) {
    const int corners = 1 << axes_.size();
    std::array<Index, 8> vertex{};
    double slowness = 0;
    for (int k = 0; k < corners; ++k) {
      std::array<Index, 3> corner = at;
      for (std::size_t e = 0; e < axes_.size(); ++e) corner[axes_[e]] += k >> e & 1;
      for (int e = 0; e < 3; ++e) {
        if (corner[e] >= grid_.size[e]) return;
      }
      vertex[k] = number(corner);
      if (!(speed(vertex[k]) > 0)) return;
      slowness += 1 / (speed(vertex[k]) * corners);
    }
    for (int k = 0; k < corners; ++k) {
      ++cells_at_[vertex[k]];
      for (std::size_t e = 0; e < axes_.size(); ++e) {
        if ((k >> e & 1) == 0) in_cell_[vertex[k] * axes_.size() + e] = 1;
      }
    }
    add({vertex.data(), static_cast<std::size_t>(corners)}, element_, slowness);
  }

  /// The edges from here along the axes that lie in no cell.
  void add_edges(const std::array<Index, 3>& at) {
    const Index from = number(at);
    if (!(speed(from) > 0)) return;
    for (std::size_t e = 0; e < axes_.size(); ++e) {
      std::array<Index, 3> next = at;
      if (++next[axes_[e]] >= grid_.size[axes_[e]]) continue;
      const Index to = number(next);
      if (in_cell_[from * axes_.size() + e] != 0 || !(speed(to) > 0)) continue;
      GridElement edge;
      edge.dimension = 1;
      const double length = grid_.spacing[axes_[e]];
      edge.measure = element_.measure;  // a corridor as wide as a cell
      edge.width = length;
      edge.gradient = Element::Zero(2, out_.dimension);
      edge.gradient(0, static_cast<Eigen::Index>(e)) = -1 / length;
      edge.gradient(1, static_cast<Eigen::Index>(e)) = 1 / length;
      edge.stabilizer = Element::Zero(2, 2);
      const std::array<Index, 2> ends = {from, to};
      add(ends, edge, (1 / speed(from) + 1 / speed(to)) / 2);
    }
  }

  /// Lengths grow by the slowness: gradients shrink by it, the measure grows by it D times.
  void add(std::span<const Index> corners, const GridElement& element, double slowness) {
    out_.corners.insert(out_.corners.end(), corners.begin(), corners.end());
    out_.start.push_back(std::ssize(out_.corners));
    for (Eigen::Index i = 0; i < element.gradient.size(); ++i) {
      out_.gradients.push_back(element.gradient.data()[i] / slowness);
    }
    const double volume = std::pow(slowness, out_.dimension);
    for (Eigen::Index k = 0; k < std::ssize(corners); ++k) {
      for (Eigen::Index j = 0; j <= k; ++j) {
        out_.stabilizers.push_back(element.stabilizer(k, j) * volume / (slowness * slowness));
      }
    }
    out_.measures.push_back(element.measure * volume);
    out_.widths.push_back(element.width * slowness);
  }

  const Grid& grid_;
  std::vector<int> axes_;  ///< along which there are several samples
  GridElement element_;
  std::vector<char> in_cell_;   ///< samples x axes: the edge from there along the axis is in a cell
  std::vector<char> cells_at_;  ///< samples: how many squares or cubes
  CellComplex out_;
};

}  // namespace

Result<CellComplex> cells_of(const Grid& grid) try {
  if (const auto valid = check_grid(grid); !valid) return valid.error();
  if (std::ranges::all_of(grid.size, [](Index count) { return count == 1; })) {
    return bad_grid("the grid has one sample alone");
  }
  CellComplex cells = GridCells(grid).make();
  if (cells.measures.empty()) return bad_grid("no two neighbouring samples have a speed above 0");
  // Speeds are no lengths of this space: straight lines bound nothing.
  const bool unit_speed =
      std::ranges::all_of(grid.speeds, [](double f) { return f == 0 || f == 1; });
  if (!unit_speed) cells.lengths_are_straight = false;
  return cells;
} catch (const std::bad_alloc&) {
  return Error{ErrorCode::kOutOfMemory, "the memory ended while cells were made of a grid"};
}

}  // namespace geotherm
