// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>

#include "solver/heat/cells_unit_field.h"

namespace geotherm {

struct GridCell;
struct GridDomain;

/// X = -grad u / |grad u| at the middle of every cell of a grid, for K source sets. With t > 0 it
/// is shortened where fronts meet, as CellField does it.
class GridField final : public CellsUnitField {
 public:
  /// `t` in squares of the unit, or 0 everywhere. Keeps references.
  GridField(const GridDomain& domain, const HeatField& heat, const PerComponent& t,
            const Workspace& work);

  Block divergence(std::span<const SourceAnchors> anchors) const override;
  CellCounts inspect(std::span<const double> phi, Eigen::Index column, const SourceAnchors& anchors,
                     std::span<const char> held_at_zero, int threads,
                     Quality& quality) const override;

 private:
  /// A cell with its rows and the weights 1 / (2^(D-1) h) of its gradient.
  struct Element;

  Element element_of(const GridCell& cell) const;
  void straighten(const Element& element, const std::array<double, 8>& value, Direction& g) const;
  Direction of_cell(const Element& element, Eigen::Index column) const;
  double length(const Element& element, Eigen::Index column) const;
  void add_layers(Index first, Index end, Block& b) const;
  void put_near(const SourceAnchors& anchors, Eigen::Index column, Block& b) const;

  const GridDomain& domain_;
};

}  // namespace geotherm
