// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "geotherm/backend.h"

namespace geotherm {

/// A sparse symmetric system whose entries are added up one by one, analysed once and factorised
/// for any entries. Immutable.
class SpreadSystem {
 public:
  /// Adds to entry (i, j), and so to (j, i): each pair in one order alone.
  using Add = std::function<void(Index i, Index j, double value)>;
  /// A matrix with the pattern.
  using Entries = std::function<void(const Add& add)>;

  /// Two rows, 2 i and 2 i + 1, for each row i of `pattern`, which is numbered as `analysis` of
  /// `backend` eliminates it: the order is kept where the backend can. `positions`: a point for
  /// each i. Errors: those of the backend.
  static Result<SpreadSystem> build_doubled(const Backend& backend, const Analysis& analysis,
                                            const SymmetricPattern& pattern,
                                            std::span<const Vec3> positions, int threads);

  /// Errors: those of the backend.
  Result<std::shared_ptr<const Factorization>> factorize(const Entries& entries, int threads) const;

  /// Solves for one column, rows as in the pattern.
  Result<std::vector<double>> solve(const Factorization& factor, std::span<const double> right,
                                    const Progress& progress, int threads) const;

  Index size() const { return static_cast<Index>(row_.size()); }

 private:
  LowerPattern lower_;
  std::uint64_t hash_ = 0;
  std::shared_ptr<const Analysis> analysis_;
  std::vector<Index> row_;  ///< in elimination order, of each row of the pattern
};

}  // namespace geotherm
