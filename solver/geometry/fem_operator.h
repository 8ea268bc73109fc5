// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "solver/geometry/domain_operator.h"
#include "solver/geometry/operator_mesh.h"

namespace geotherm {

/// M = a A + s L on a surface, L the cotan stiffness. A = (1 - c) lumped + c consistent mass; c = 0
/// is the usual lumped mass, c = 1/2 is of fourth order in the wave number on regular meshes
/// (Goudreau, Taylor 1973). No off-diagonal entry of M changes its sign for c. s and c may differ
/// between components, which share no entry.
class FemOperator final : public DomainOperator {
 public:
  /// `held`: vertices in elimination numbering, in any order; empty for none. `threads`: those that
  /// set it up and assemble it; they change no bit.
  FemOperator(std::shared_ptr<const OperatorMesh> mesh, double mass_factor,
              PerComponent stiffness_factor, std::vector<Index> held = {},
              PerComponent consistent_share = 0.0, int threads = 1);

  Index size() const override { return mesh_->size(); }
  std::shared_ptr<const DomainOperator> copy() const override {
    return std::make_shared<const FemOperator>(*this);
  }
  std::span<const double> diagonal() const override { return diagonal_; }
  Kernel kernel() const override;
  std::uint64_t pattern() const override { return mesh_->pattern; }
  const LowerMatrix& assembled() const override;
  const LowerMatrix& assembled_where(std::span<const char> wanted) const override;
  void drop_assembled() const override {
    assembled_ = {};
    has_all_ = false;
  }
  void list_row(Index i, std::vector<Index>& columns, std::vector<double>& values) const override;
  void apply_free(std::span<const double> x, std::span<double> y) const override;
  double product_at(Index i, const std::function<double(Index)>& x) const override;
  void residual(const Block& b, const Block& x, Block& r, int threads) const override;
  void list_neighbors(Index i, std::vector<Index>& rows) const override;
  std::vector<ColumnSet> columns_beside(std::span<const ColumnSet> sets, int threads,
                                        std::vector<Index>& listed) const override;

 private:
  /// Subtracts from r what these faces give of M x.
  void subtract_faces(Index first_face, Index end_face, const Block& x, Block& r) const;
  /// Weights of a face's pairs of corners: M is its row sums plus, for each pair, weight times the
  /// squared difference.
  std::array<double, 3> weights(std::size_t face) const;
  /// The weights of all sides, by Side; where `wanted` is not empty, only those of faces at a row
  /// with a flag.
  RawVector<double> side_weights(std::span<const char> wanted = {}) const;
  void set_diagonal();
  void assemble_column(Index j, const RawVector<double>& weight) const;
  double of_face(const PerComponent& factor, std::size_t face) const {
    return factor.same() ? factor.of(0) : factor.of(mesh_->components.of[mesh_->faces[face][0]]);
  }

  std::shared_ptr<const OperatorMesh> mesh_;
  double mass_factor_;
  PerComponent stiffness_factor_, consistent_share_;
  int threads_;
  std::vector<double> diagonal_;
  mutable LowerMatrix assembled_;
  mutable bool has_all_ = false;  ///< columns of `assembled_`
};

}  // namespace geotherm
