// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "geotherm/domains.h"
#include "solver/geometry/grid_mesh.h"
#include "solver/heat/domain.h"

namespace geotherm {

/// A Grid made ready for the heat method. Cells are never stored: they are a byte a sample.
struct GridDomain final : Domain {
  std::shared_ptr<const GridLattice> lattice;
  std::shared_ptr<const CellMatrix> matrix;
  double mean_measure = 1;  ///< of the cells, model units: what measures are relative to

  const Components& parts_of_rows() const override { return matrix->components; }
  std::span<const double> mass() const override { return matrix->mass; }
  std::shared_ptr<const DomainOperator> combine(double mass_factor,
                                                const PerComponent& stiffness_factor,
                                                std::vector<Index> held,
                                                const PerComponent& consistent_share,
                                                int threads) const override;
  void apply_stiffness(std::span<const double> x, std::span<double> y, int threads) const override;
  Result<SourceAnchors> place(const SourceSet& sources) const override;
  std::unique_ptr<const UnitField> unit_field(const HeatField& heat, const PerComponent& t,
                                              const Workspace& work) const override;
  void apply_straight_line_bound(const SourceSet& sources, BelowLine below, int threads,
                                 DistanceResult& result) const override;
};

/// What makes the domain of a grid. Errors: those of check_grid().
Result<std::shared_ptr<const Domain::Input>> grid_input(std::shared_ptr<const Grid> grid);

}  // namespace geotherm
