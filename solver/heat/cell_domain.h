// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "geotherm/domains.h"
#include "solver/core/stopwatch.h"
#include "solver/geometry/cell_mesh.h"
#include "solver/geometry/polygon_flips.h"
#include "solver/heat/domain.h"

namespace geotherm {

/// A Domain whose operators are a CellMatrix.
struct MatrixDomain : Domain {
  std::shared_ptr<const CellMatrix> matrix;

  const Components& parts_of_rows() const override { return matrix->components; }
  std::span<const double> mass() const override { return matrix->mass; }
  std::shared_ptr<const DomainOperator> combine(double mass_factor,
                                                const PerComponent& stiffness_factor,
                                                std::vector<Index> held,
                                                const PerComponent& consistent_share,
                                                int threads) const override;
  void apply_stiffness(std::span<const double> x, std::span<double> y, int threads) const override;

  /// Has a pattern analysed, whose vertices lie at these places, and numbers the rows. `begins`:
  /// the share of the work at which that is. `watch`: of what came before.
  Result<void> analyze(const Backend& backend, const CellPattern& pattern,
                       std::span<const Vec3> places, int threads, const Progress& progress,
                       double begins, Stopwatch& watch);
  /// The straight-line bound where vertices and sources lie at these places, model units.
  void bound_by_lines(std::span<const Vec3> positions, std::span<const Vec3> sources,
                      BelowLine below, int threads, DistanceResult& result) const;
};

/// Errors (kBadInput): a Laplacian that triangle meshes alone have. `space`: "this is a grid".
Result<void> refuse_laplacian(LaplacianKind laplacian, const std::string& space);

/// A CellComplex made ready for the heat method.
struct CellDomain final : MatrixDomain {
  std::shared_ptr<const CellComplex> given;
  /// Polygons whose triangles were flipped; null elsewhere.
  std::shared_ptr<const FlippedPolygons> flipped;
  CellTable
      faces_at;  ///< of each given vertex, the first cells of its faces, where some were flipped
  std::shared_ptr<const CellMesh> mesh;  ///< which is `matrix`, too
  std::vector<Index> cell_of_given;      ///< number in `mesh` of each of cells()

  /// What `mesh` was made of: the cells that were given, or as many and then those that refinement
  /// has made. Vertices from `input_vertices` on are in no answer.
  const CellComplex& cells() const { return flipped ? flipped->cells : *given; }
  /// The rows of the corners that a given cell has for sources.
  std::vector<Index> rows_of_given(Index cell) const;
  /// The row of the virtual vertex of a given cell; kNoIndex where it has none.
  Index virtual_row(Index cell) const;
  /// Where a row lies, model units. Precondition: the complex has positions.
  const Vec3& place_of(Index row) const { return cells().positions[vertex_of_row[row]]; }

  /// The given cell that sources call by this number; kNoIndex: there is none.
  Index find_cell(Index number) const;

  Result<SourceAnchors> place(const SourceSet& sources) const override;
  std::unique_ptr<const UnitField> unit_field(const HeatField& heat, const PerComponent& t,
                                              const Workspace& work) const override;
  Result<std::vector<NearVertex>> near_field(const SourceAnchors& anchors) const override;
  void apply_straight_line_bound(const SourceSet& sources, BelowLine below, int threads,
                                 DistanceResult& result) const override;
  Index flip_count() const override { return flipped ? flipped->flips : 0; }
  const RefinementCounts& inserted() const override {
    return flipped ? flipped->inserted : Domain::inserted();
  }

  /// From one corner of a cell of `mesh` to another: within a triangle that was flipped, else
  /// straight. In units of the domain. Precondition: the complex has positions.
  double length_within(Index cell, Index row, Index to) const;

  /// Where the corners of a given cell lie, up to a shift: their positions, in units of the domain,
  /// or without such where the linear functions are that have the cell's gradients, in its frame
  /// (the pseudo-inverse of G).
  std::vector<Vec3> corner_places(Index cell) const;
};

/// A cell beside a source, with the distances of its corners, in units of the domain.
struct NearCell {
  Index cell;
  std::array<double, 4> distances;
};

/// The tets up to three mean widths from the sources that see one along a straight line, with its
/// length. None for more than 64 sources, and where the cells are no tets in space.
/// The same whatever the elimination order. Cost: some microseconds for each of their vertices.
std::vector<NearCell> near_tets(const CellDomain& domain, const SourceAnchors& anchors);

/// Near-exact distances at the polygons around the sources, by a march over the triangles at their
/// virtual vertices or that they were cut into; sources inside faces become corners of these. None
/// where a face there does not see all its sides from its virtual vertex and is not cut, and in
/// other cells. Cost: some ten microseconds for each face.
std::vector<NearVertex> near_polygons(const CellDomain& domain, const SourceAnchors& anchors);

/// What makes the domain of a complex.
std::shared_ptr<const Domain::Input> cell_input(std::shared_ptr<const CellComplex> cells);

}  // namespace geotherm
