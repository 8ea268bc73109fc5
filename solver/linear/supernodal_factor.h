// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "solver/linear/triangular_factor.h"

namespace geotherm {

/// Which columns form supernodes and which rows each has: shared by every factor of a pattern.
struct SupernodalStructure {
  std::vector<Index> first = {0};               ///< S + 1: first column of each supernode
  std::vector<std::int64_t> row_start = {0};    ///< S + 1, into `rows`
  std::vector<Index> rows;                      ///< rows below each supernode's own
  std::vector<std::int64_t> value_start = {0};  ///< S + 1, into a factor's values
  EliminationTree tree;
  Index tallest = 0;  ///< rows of the tallest supernode, its own included

  Index count() const { return static_cast<Index>(first.size()) - 1; }
  /// Fills `tree` and `tallest` from the other members.
  void finish();
};

/// FactorStats::bytes of every factor of this structure.
std::int64_t supernodal_factor_bytes(const SupernodalStructure& structure);

/// M = L L^T stored as dense panels. `owner` keeps `values` alive.
std::unique_ptr<TriangularFactor> make_supernodal_factor(
    std::shared_ptr<const SupernodalStructure> structure, const double* values,
    std::shared_ptr<const void> owner);

}  // namespace geotherm
