// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "app/announce.h"
#include "app/cmd_solve.h"
#include "app/command_output.h"

namespace geotherm::app {

/// `solve --pairs`: the distances between each two of K vertices.
Result<CommandOutput> run_pairs(const SolveArguments& arguments, const Progress& progress,
                                const Announce& announce);

/// Distances between K vertices, row by row: entry (i, j) is the distance at vertex j from a source
/// at vertex i. On a polyhedral surface it would be that of (j, i); by the heat method it is so but
/// for the discretisation error.
struct PairMatrix {
  std::vector<Index> vertices;
  std::vector<double> entries;  ///< K x K

  std::size_t size() const { return vertices.size(); }
  double at(std::size_t i, std::size_t j) const { return entries[i * size() + j]; }
};

/// How far the two directions are apart where both are finite.
struct Asymmetry {
  double most = 0;           ///< |d_ij - d_ji|, model units
  double of_larger = 0;      ///< the same for the most of |d_ij - d_ji| / max(d_ij, d_ji)
  std::size_t i = 0, j = 0;  ///< where `most` is
};
Asymmetry asymmetry(const PairMatrix& pairs);

/// Both directions become their mean.
void symmetrise(PairMatrix& pairs);

}  // namespace geotherm::app
