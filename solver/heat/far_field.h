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
  /// Keeps references. `field.u`: solved.
  FarField(const LinearSystem& system, const Components& components,
           const std::vector<std::vector<char>>& reached, double floor, const Workspace& work,
           HeatField& field);

  /// Restarts outwards until every reached entry of these columns lies above the floor or nothing
  /// more comes. Errors: the solve's, kCancelled.
  Result<void> extend(std::span<const Eigen::Index> columns, const Progress& progress);

 private:
  using Columns = std::uint16_t;  ///< a set of them: bit k is columns_[k]
  struct Rows {
    std::vector<Columns> far;   ///< n: where the entry is below the floor
    std::vector<Columns> near;  ///< n: one layer before that
    std::vector<Index> asked;   ///< the layer and the rows beside it
  };

  std::vector<Columns> below(int level) const;
  std::vector<std::int64_t> count(const std::vector<Columns>& rows) const;
  std::vector<Columns> beside(const std::vector<Columns>& rows,
                              const std::vector<Columns>& far) const;
  void ask(Rows& rows, int level, Block& right) const;
  Columns heated(const std::vector<Columns>& far, const Block& right) const;
  void take(const std::vector<Columns>& far, Columns which, int level, const Block& right);

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
  HeatField& field_;
  std::vector<Eigen::Index> columns_;
};

}  // namespace geotherm
