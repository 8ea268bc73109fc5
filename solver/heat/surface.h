// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "geotherm/error.h"
#include "geotherm/heat_method.h"
#include "geotherm/mesh.h"
#include "geotherm/options.h"
#include "solver/geometry/intrinsic_surface.h"
#include "solver/geometry/operator_mesh.h"
#include "solver/heat/domain.h"

namespace geotherm {

/// The order that the surfaces of a mesh that moves keep: that of the last fresh analysis.
struct KeptOrder {
  std::vector<Index> parent;          ///< its tree: EliminationTree::parent
  std::vector<Index> vertices;        ///< of the mesh, in that order
  std::vector<Index> node_of_vertex;  ///< V: the node of each vertex of the mesh, or kNoIndex
  std::int64_t factor_bytes = 0;      ///< of a factor in that order, as it was foreseen
};

/// A triangle mesh made ready for the heat method: cleaned, triangulated intrinsically, analysed by
/// a backend and renumbered into its elimination order.
struct Surface final : IntrinsicSurface, Domain {
  LaplacianKind laplacian = LaplacianKind::kCotan;
  LaplacianKind asked = LaplacianKind::kAuto;   ///< what was asked for; `laplacian` came of it
  bool is_delaunay = true;                      ///< false: edges that ask for a flip were kept
  const Backend* backend = nullptr;             ///< that analysed it
  std::shared_ptr<const KeptOrder> kept_order;  ///< null where the analysis is fresh
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
  void apply_straight_line_bound(const SourceSet& sources, BelowLine below, int threads,
                                 DistanceResult& result) const override;
  Index flip_count() const override { return flips; }
  const RefinementCounts& inserted() const override { return refinement; }
  const Surface* surface() const override { return this; }

  /// Whether its triangulation is that of waves: Delaunay, refined where needed, and no cover.
  bool serves_waves() const {
    return (asked == LaplacianKind::kAuto || asked == LaplacianKind::kRefined) && !tufted;
  }
};

/// `progress` is asked between operators, flips and analysis, as stages "operators" and "analyze".
/// Errors: kBadInput (no face with area), kCancelled, and the backend's. `earlier`: the same faces
/// with vertices elsewhere, or null. Its elimination order is kept, and its whole analysis where
/// the triangulation is the same; a new order is made where factors in the kept one would be larger
/// by more than 15 % than they were when it was made. `ready`: as in HeatMethod::build().
Result<std::shared_ptr<const Surface>> build_surface(std::shared_ptr<const TriangleMesh> mesh,
                                                     const Backend& backend,
                                                     LaplacianKind laplacian, int threads,
                                                     const Progress& progress = {},
                                                     const Surface* earlier = nullptr,
                                                     const TriangulationReady& ready = {});

/// What makes the domain of a mesh; `earlier` and `ready` as in build_surface().
std::shared_ptr<const Domain::Input> surface_input(std::shared_ptr<const TriangleMesh> mesh,
                                                   std::shared_ptr<const Surface> earlier = {},
                                                   TriangulationReady ready = {});

}  // namespace geotherm
