// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "geotherm/backend.h"
#include "geotherm/types.h"
#include "solver/geometry/operator_mesh.h"

namespace geotherm {

/// A number for each component of a surface, or one for all of them.
class PerComponent {
 public:
  PerComponent(double all) : values_{all} {}  // NOLINT: a number is one for all
  /// Precondition: not empty. Numbers that are all the same become one.
  explicit PerComponent(std::vector<double> values) : values_(std::move(values)) {
    if (std::ranges::adjacent_find(values_, std::not_equal_to{}) == values_.end()) {
      values_.resize(1);
    }
  }

  double of(Index component) const {
    return values_.size() == 1 ? values_[0] : values_[static_cast<std::size_t>(component)];
  }
  /// f of each.
  template <class F>
  PerComponent map(const F& f) const {
    std::vector<double> out;
    for (const double value : values_) out.push_back(f(value));
    return PerComponent(std::move(out));
  }
  bool same() const { return values_.size() == 1; }
  double least() const { return std::ranges::min(values_); }
  double most() const { return std::ranges::max(values_); }

  bool operator==(const PerComponent&) const = default;

 private:
  std::vector<double> values_;
};

/// M = a A + s L on a surface: A the mass (rows sum to the lumped masses), L the cotan stiffness
/// (positive semidefinite, rows sum to 0). A = (1 - c) lumped + c consistent mass; c = 0 is the
/// usual lumped mass, c = 1/2 is of fourth order in the wave number on regular meshes (Goudreau,
/// Taylor 1973). No off-diagonal entry of M changes its sign for c. Rows and columns of held
/// vertices are those of the identity, which keeps M symmetric and its pattern unchanged: the
/// caller moves known values to the right side. s and c may differ between components, which share
/// no entry.
class FemOperator final : public SymmetricOperator {
 public:
  /// `held`: vertices in elimination numbering, in any order; empty for none. `threads`: those that
  /// set it up and assemble it; they change no bit.
  FemOperator(std::shared_ptr<const OperatorMesh> mesh, double mass_factor,
              PerComponent stiffness_factor, std::vector<Index> held = {},
              PerComponent consistent_share = 0.0, int threads = 1);

  Index size() const override { return mesh_->size(); }
  void apply(std::span<const double> x, std::span<double> y) const override;
  /// (M x)_i alone, x as a function of the row. Cost: the faces at i.
  double product_at(Index i, const std::function<double(Index)>& x) const;
  std::span<const double> diagonal() const override { return diagonal_; }
  Kernel kernel() const override;
  std::uint64_t pattern() const override { return mesh_->pattern; }
  const LowerMatrix& assembled() const override;

  /// The operator without its held rows, y = (a A + s L) x: what moves known values to the right.
  void apply_free(std::span<const double> x, std::span<double> y) const;

  /// r = b - M x, columns side by side. The same bits with any number of threads.
  void residual(const Block& b, const Block& x, Block& r, int threads) const;

  const OperatorMesh& mesh() const { return *mesh_; }
  std::span<const Index> held() const { return held_; }
  bool is_held(Index i) const { return !is_held_.empty() && is_held_[i] != 0; }

 private:
  /// Subtracts from r what these faces give of M x.
  void subtract_faces(Index first_face, Index end_face, const Block& x, Block& r) const;
  /// Weights of a face's pairs of corners: M is its row sums plus, for each pair, weight times the
  /// squared difference.
  std::array<double, 3> weights(std::size_t face) const;
  /// Those of all sides, by Side.
  RawVector<double> side_weights() const;
  void set_diagonal();
  void assemble_column(Index j, const RawVector<double>& weight) const;
  double of_face(const PerComponent& factor, std::size_t face) const {
    return factor.same() ? factor.of(0) : factor.of(mesh_->components.of[mesh_->faces[face][0]]);
  }

  std::shared_ptr<const OperatorMesh> mesh_;
  double mass_factor_;
  PerComponent stiffness_factor_, consistent_share_;
  int threads_;
  std::vector<Index> held_;
  std::vector<char> is_held_;  ///< n, or empty when nothing is held
  std::vector<double> diagonal_;
  mutable LowerMatrix assembled_;
};

}  // namespace geotherm
