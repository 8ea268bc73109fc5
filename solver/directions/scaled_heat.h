// SPDX-License-Identifier: MIT
#pragma once

#include <complex>
#include <cstdint>
#include <span>
#include <vector>

#include "geotherm/error.h"
#include "geotherm/progress.h"
#include "solver/heat/diffuse.h"

namespace geotherm {

/// -w r of an edge, r the rotation from its end to its begin.
struct Link {
  Index from, to;
  double weight, cosine, sine;
};

/// (A + t C) Y = Y0 with Y measured in the heat at each row, for backends that iterate: these end
/// by the largest entries of an answer, while vectors and values are wanted where heat is far less.
///
/// With the heat p of the same sources Z = Y / p is of one size everywhere. Its matrix
/// p^-1 (A + t C) p leads from warm rows to cold ones and little the other way, so that one sweep
/// over the rows by falling heat all but solves it. What leads back to warm rows goes to the
/// diagonal there, so that a sweep keeps constants, however far; GMRES (Saad, Schultz 1986) does
/// the rest. C is the connection Laplacian, or with turns left out the Laplacian. Immutable.
class ScaledHeat {
 public:
  using Complex = std::complex<double>;

  /// `mass`: lumped; `heat`: column 0, which may differ from p by some digits. Rows without heat
  /// are left out.
  ScaledHeat(std::span<const Link> links, std::span<const double> mass, double t,
             const HeatField& heat, bool turns);

  /// Z at all rows, 0 where there is no heat. `values[i]` is added to Y0 at `rows[i]`. Errors:
  /// kBudgetEnded, kCancelled.
  Result<std::vector<Complex>> solve(std::span<const Index> rows, std::span<const Complex> values,
                                     const Progress& progress) const;

 private:
  std::vector<Complex> sweep(std::vector<Complex> right) const;
  std::vector<Complex> swept_product(const std::vector<Complex>& z) const;

  Index size() const { return static_cast<Index>(row_.size()); }

  std::vector<Index> row_;                    ///< by falling heat
  std::vector<Index> place_;                  ///< of each row in row_, kNoIndex
  std::vector<double> inverse_;               ///< 1 / (p M_ii), of each place
  std::vector<double> kept_;                  ///< the diagonal of a sweep, of each place
  std::vector<std::int64_t> start_, middle_;  ///< entries of each place; from `middle_` on colder
  std::vector<Index> column_;                 ///< places
  std::vector<Complex> entry_;                ///< over the diagonal
};

}  // namespace geotherm
