// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "solver/heat/diffuse.h"
#include "solver/heat/domain.h"
#include "solver/heat/field_kernels.h"
#include "solver/heat/linear_system.h"

namespace geotherm {

/// What X = -grad u / |grad u| on the cells of a space has in common, whatever the cells are: u
/// with its levels and its logarithm, and what an inspection adds up.
class CellsUnitField : public UnitField {
 public:
  ~CellsUnitField() override { work_.pool.give(std::move(log_u_)); }
  CellsUnitField(const CellsUnitField&) = delete;
  CellsUnitField& operator=(const CellsUnitField&) = delete;

 protected:
  using Direction = std::array<double, 3>;

  /// `t` in squares of the unit, or 0 everywhere: nothing is shortened then, nor in one dimension,
  /// where fronts meet in points. Keeps references.
  CellsUnitField(const HeatField& heat, const PerComponent& t, int dimension, const Workspace& work)
      : heat_(heat),
        root_t_(t.map([](double each) { return std::sqrt(each); })),
        shortens_(root_t_.most() > 0 && dimension > 1),
        work_(work) {
    if (!shortens_) return;
    log_u_ = work.pool.take(heat.u.rows(), heat.u.cols());
    const double step = std::log(heat.step);
    work_.for_rows(log_u_.size(), 1, [&](std::int64_t begin, std::int64_t end) {
      logarithms(heat_.u.data() + begin, log_u_.data() + begin,
                 static_cast<std::size_t>(end - begin));
      for (std::int64_t e = begin; e < end && !heat_.level.empty(); ++e) {
        log_u_.data()[e] += step * heat_.level[static_cast<std::size_t>(e)];
      }
    });
  }

  static double norm(const Direction& g) {
    return std::sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
  }

  int level_of(Index row, Eigen::Index column) const {
    if (heat_.level.empty()) return 0;
    return heat_.level[static_cast<std::size_t>(row * heat_.u.cols() + column)];
  }
  int least_level(std::span<const Index> rows, Eigen::Index column) const {
    int least = level_of(rows.front(), column);
    for (const Index row : rows) least = std::min(least, level_of(row, column));
    return least;
  }
  /// u of a row at another level, that of the largest values around it.
  double value_at(Index row, Eigen::Index column, int least) const {
    const int above = level_of(row, column) - least;
    const double u = heat_.u(row, column);
    return above > 0 ? u * std::pow(heat_.step, above) : u;
  }

  struct Sums {
    double error = 0, measure = 0;
    CellCounts counts;
    Index lost = 0;

    void add(const Sums& other) {
      error += other.error;
      measure += other.measure;
      counts.in_reach += other.counts.in_reach;
      counts.without_direction += other.counts.without_direction;
      lost += other.lost;
    }
    CellCounts write_to(Quality& quality) const {
      quality.zero_gradient_faces = lost;
      quality.eikonal_error_mean = measure > 0 ? error / measure : 0.0;
      return counts;
    }
  };

  /// Which cells an inspection is about, and where there is nothing to lose.
  class Inspection {
   public:
    Inspection(const Components& parts, std::size_t rows, const SourceAnchors& anchors,
               std::span<const char> held_at_zero)
        : parts_(parts), held_(rows, 0), holds_(static_cast<std::size_t>(parts.count), 0) {
      std::ranges::copy(held_at_zero, held_.begin());
      for (const auto& anchor : anchors.anchors) held_[anchor.row] = 1;
      for (const Index c : anchors.components) holds_[c] = 1;
    }

    bool reaches(std::span<const Index> rows) const { return holds_[parts_.of[rows.front()]] != 0; }
    /// Counts a cell that is reached.
    void count(std::span<const Index> rows, bool has_direction, Sums& sum) const {
      ++sum.counts.in_reach;
      if (has_direction) return;
      ++sum.counts.without_direction;
      sum.lost += knows(rows) ? 0 : 1;
    }
    /// Adds the slope |grad phi| of a cell that is reached, or of a part of it.
    void add_slope(std::span<const Index> rows, double slope, double measure, Sums& sum) const {
      if (slope == 0 && knows(rows)) return;  // sources alone: no distance rises here
      sum.error += measure * std::abs(slope - 1);
      sum.measure += measure;
    }

   private:
    bool knows(std::span<const Index> rows) const {
      return std::ranges::all_of(rows, [this](Index row) { return held_[row] != 0; });
    }

    const Components& parts_;
    std::vector<char> held_, holds_;
  };

  const HeatField& heat_;
  PerComponent root_t_;
  bool shortens_;
  Workspace work_;
  Block log_u_;  ///< n x K, natural logarithm of u with its exponent; empty where nothing shortens
};

}  // namespace geotherm
