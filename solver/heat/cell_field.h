// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "solver/heat/diffuse.h"
#include "solver/heat/domain.h"
#include "solver/heat/linear_system.h"

namespace geotherm {

struct CellDomain;

/// X = -grad u / |grad u| on every cell of a CellComplex, for K source sets. With t > 0 it is
/// shortened where fronts meet, as FaceField does it on triangle meshes, in cells off the boundary;
/// in one dimension, where fronts meet in points, it is not.
class CellField final : public UnitField {
 public:
  /// `t` in squares of the unit, or 0 everywhere. Keeps references.
  CellField(const CellDomain& domain, const HeatField& heat, const PerComponent& t,
            const Workspace& work);
  ~CellField() override { work_.pool.give(std::move(log_u_)); }
  CellField(const CellField&) = delete;
  CellField& operator=(const CellField&) = delete;

  Block divergence(std::span<const SourceAnchors> anchors) const override;
  CellCounts inspect(std::span<const double> phi, Eigen::Index column, const SourceAnchors& anchors,
                     std::span<const char> held_at_zero, int threads,
                     Quality& quality) const override;

 private:
  static constexpr int kMaxDimension = 3;
  using Direction = std::array<double, kMaxDimension>;
  using Square = std::array<double, kMaxDimension * kMaxDimension>;

  /// The inverse of G' G: with it a cell's extent along a direction is known.
  Square inverse_square(Index cell) const;
  Direction of_cell(Index cell, const Square& inverse, Eigen::Index column) const;
  double length(Index cell, const Square& inverse, Eigen::Index column) const;
  void add_cells(Index first_cell, Index end_cell, Block& b) const;
  void add_tets(Index first_tet, Index end_tet, Eigen::Index first, int group, Block& b) const;

  const CellDomain& domain_;
  const HeatField& heat_;
  PerComponent root_t_;
  bool shortens_;
  Workspace work_;
  Block log_u_;  ///< n x K, natural logarithm of u with its exponent; empty where nothing shortens
};

}  // namespace geotherm
