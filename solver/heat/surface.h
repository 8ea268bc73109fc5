// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "geotherm/error.h"
#include "geotherm/mesh.h"
#include "geotherm/options.h"
#include "solver/geometry/intrinsic_surface.h"
#include "solver/geometry/operator_mesh.h"
#include "solver/heat/domain.h"

namespace geotherm {

/// A triangle mesh made ready for the heat method: cleaned, triangulated intrinsically, analysed by
/// a backend and renumbered into its elimination order.
struct Surface final : IntrinsicSurface, Domain {
  LaplacianKind laplacian = LaplacianKind::kCotan;
  std::shared_ptr<const OperatorMesh> operators;

  const Components& parts_of_rows() const override { return operators->components; }
  std::span<const double> mass() const override { return operators->mass; }
  std::shared_ptr<const DomainOperator> combine(double mass_factor,
                                                const PerComponent& stiffness_factor,
                                                std::vector<Index> held,
                                                const PerComponent& consistent_share,
                                                int threads) const override;
  void apply_stiffness(std::span<const double> x, std::span<double> y, int threads) const override;
  Result<SourceAnchors> place(const SourceSet& sources) const override;
  std::unique_ptr<const UnitField> unit_field(const HeatField& heat, const PerComponent& t,
                                              const Workspace& work) const override;
  Result<std::vector<NearVertex>> near_field(const SourceAnchors& anchors) const override;
  void check_straight_lines(const SourceSet& sources, int threads,
                            DistanceResult& result) const override;
  const Surface* surface() const override { return this; }
};

/// `progress` is asked between operators, flips and analysis, as stages "operators" and "analyze".
/// Errors: kBadInput (no face with area), kCancelled, and the backend's.
Result<std::shared_ptr<const Surface>> build_surface(std::shared_ptr<const TriangleMesh> mesh,
                                                     const Backend& backend,
                                                     LaplacianKind laplacian, int threads,
                                                     const Progress& progress = {});

/// What makes the domain of a mesh.
std::shared_ptr<const Domain::Input> surface_input(std::shared_ptr<const TriangleMesh> mesh);

}  // namespace geotherm
