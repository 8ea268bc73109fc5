// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "geotherm/domains.h"
#include "solver/geometry/grid_mesh.h"
#include "solver/heat/cell_domain.h"

namespace geotherm {

/// A Grid made ready for the heat method. Cells are never stored: they are a byte a sample.
struct GridDomain final : MatrixDomain {
  std::shared_ptr<const GridLattice> lattice;
  double mean_measure = 1;  ///< of the cells, model units: what measures are relative to

  Result<SourceAnchors> place(const SourceSet& sources) const override;
  std::unique_ptr<const UnitField> unit_field(const HeatField& heat, const PerComponent& t,
                                              const Workspace& work) const override;
  void apply_straight_line_bound(const SourceSet& sources, BelowLine below, int threads,
                                 DistanceResult& result) const override;
};

/// What makes the domain of a grid. Errors: those of check_grid().
Result<std::shared_ptr<const Domain::Input>> grid_input(std::shared_ptr<const Grid> grid);

}  // namespace geotherm
