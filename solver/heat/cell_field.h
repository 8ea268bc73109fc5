// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>

#include "solver/heat/cells_unit_field.h"

namespace geotherm {

struct CellDomain;

/// X = -grad u / |grad u| on every cell of a CellComplex, for K source sets. With t > 0 it is
/// shortened where fronts meet, as FaceField does it on triangle meshes, and beside a boundary,
/// where they meet their reflection; in one dimension, where fronts meet in points, it is not.
class CellField final : public CellsUnitField {
 public:
  /// `t` in squares of the unit, or 0 everywhere. Keeps references.
  CellField(const CellDomain& domain, const HeatField& heat, const PerComponent& t,
            const Workspace& work);

  Block divergence(std::span<const SourceAnchors> anchors) const override;
  CellCounts inspect(std::span<const double> phi, Eigen::Index column, const SourceAnchors& anchors,
                     std::span<const char> held_at_zero, int threads,
                     Quality& quality) const override;

 private:
  using Square = std::array<double, 9>;

  /// The inverse of G' G: with it a cell's extent along a direction is known.
  Square inverse_square(Index cell) const;
  Direction of_cell(Index cell, const Square& inverse, Eigen::Index column) const;
  double length(Index cell, const Square& inverse, Eigen::Index column) const;
  void add_cells(Index first_cell, Index end_cell, Block& b) const;
  void put_known(Index cell, std::span<const double> distances, Eigen::Index column,
                 Block& b) const;
  void put_near(const SourceAnchors& anchors, Eigen::Index column, Block& b) const;
  void add_tets(Index first_tet, Index end_tet, Eigen::Index first, int group, Block& b) const;

  const CellDomain& domain_;
};

}  // namespace geotherm
