// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "geotherm/backend.h"

namespace geotherm {

/// A preconditioner for Laplacians without much mass: multigrid by aggregation (Notay 2010). Three
/// times over, each unknown is joined with the neighbour that it is most strongly coupled to, so
/// that a level has an eighth of the one before; levels below the first are solved by two steps of
/// flexible conjugate gradients each, the first and last smoothed by Jacobi's method. Not linear:
/// what it preconditions has to be flexible, too.
class Multigrid {
 public:
  /// Null where it would not help: few unknowns, a diagonal that outweighs the rest by far, a
  /// kernel, unknowns that cannot be joined. Cost: some passes over the matrix, and a third of its
  /// size in memory.
  static std::unique_ptr<const Multigrid> build(const SymmetricOperator& matrix);

  /// z = about M^-1 r. Keeps nothing: may be called from several threads.
  void apply(std::span<const double> r, std::span<double> z) const;

 private:
  struct Level;
  explicit Multigrid(const SymmetricOperator& matrix) : matrix_(matrix) {}

  void multiply(std::size_t level, std::span<const double> x, std::span<double> y) const;
  std::span<const double> diagonal(std::size_t level) const;
  void cycle(std::size_t level, std::span<const double> r, std::span<double> z) const;
  void solve_below(std::size_t level, std::span<const double> r, std::span<double> x) const;

  const SymmetricOperator& matrix_;
  std::vector<std::vector<Index>> joined_;  ///< of each level but the last: number on the next
  std::vector<std::shared_ptr<const Level>> levels_;  ///< below the first
};

}  // namespace geotherm
