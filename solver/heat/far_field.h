// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/heat/diffuse.h"

namespace geotherm {

/// Columns that are restarted together: a bit each.
inline constexpr std::size_t kColumnsOfFarField = 16;

/// Solves what lies below the floor of a heat field again, as diffuse() says, all columns of a
/// block together: a restart reads the factor once, whatever their number, and of its backward pass
/// only what leads to the far rows.
class FarField {
 public:
  /// The largest and the smallest |u| of each component and column.
  struct Range {
    Block largest, smallest;
    Range(Eigen::Index components, Eigen::Index columns)
        : largest(Block::Zero(components, columns)),
          smallest(Block::Constant(components, columns, kUnreached)) {}

    void take(Index component, Eigen::Index column, double u) {
      double& high = largest(component, column);
      double& low = smallest(component, column);
      if (u > high) high = u;
      if (u < low) low = u;
    }
    void take(const Range& other) {
      largest = largest.cwiseMax(other.largest);
      smallest = smallest.cwiseMin(other.smallest);
    }
  };

  /// Keeps references. `field.u`: solved.
  FarField(const LinearSystem& system, const Components& components,
           const std::vector<std::vector<char>>& reached, double floor, const Workspace& work,
           HeatField& field);

  /// Restarts outwards until every reached entry of these columns lies above the floor or nothing
  /// more comes. `of_columns`: the range of these columns' entries, whatever their component.
  /// Errors: the solve's, kCancelled.
  Result<void> extend(std::span<const Eigen::Index> columns, const Range& of_columns,
                      const Progress& progress);

 private:
  using Columns = ColumnSet;  ///< bit k is columns_[k]
  using Rows = std::vector<Columns>;

  /// Entries below the floor, and how many in each column.
  struct Far {
    Rows rows;
    std::vector<std::int64_t> count;
  };
  Range range() const;
  double end_of_level(double first, double largest) const;
  Far below(const Range& range, const Rows& candidates) const;
  void mark_below(const Block& least, std::int64_t begin, std::int64_t end, Rows& rows) const;
  std::vector<Index> ask(const Rows& far, int level, Block& right) const;
  double outflow(Index i, int k, int level, const Rows& far, const Rows& layer) const;
  Columns heated(const Rows& far, const Block& right) const;
  Range take(const Rows& far, Columns which, int level, const Block& right);
  Far keep(Far next, Columns which, const std::vector<std::int64_t>& before);

  int level_of(Index row, Eigen::Index column) const {
    return field_.level.empty()
               ? 0
               : field_.level[static_cast<std::size_t>(row * field_.u.cols() + column)];
  }

  const LinearSystem& system_;
  const Components& components_;
  const std::vector<std::vector<char>>& reached_;
  const double floor_;
  const Workspace& work_;
  const Workspace passes_;  ///< for what notes something of each component in each thread
  HeatField& field_;
  std::vector<Eigen::Index> columns_;
  Block first_;  ///< components x columns_: the largest |u| of the first level
};

}  // namespace geotherm
