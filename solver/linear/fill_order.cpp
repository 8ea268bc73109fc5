// SPDX-License-Identifier: MIT
#include "solver/linear/fill_order.h"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>

#include "solver/linear/nested_dissection.h"

namespace geotherm {
namespace {

std::vector<Index> minimum_degree(const SymmetricPattern& pattern) {
  const Index n = pattern.size();
  Eigen::SparseMatrix<double> graph(n, n);
  std::vector<int> counts(static_cast<std::size_t>(n));
  for (Index i = 0; i < n; ++i) counts[i] = static_cast<int>(pattern.neighbors(i).size()) + 1;
  graph.reserve(counts);
  for (Index i = 0; i < n; ++i) {
    graph.insert(i, i) = 1;
    for (const Index j : pattern.neighbors(i)) graph.insert(j, i) = 1;
  }
  graph.makeCompressed();
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> inverse;
  Eigen::AMDOrdering<int>()(graph.selfadjointView<Eigen::Lower>(), inverse);
  const auto& indices = inverse.indices();
  return {indices.data(), indices.data() + n};
}

}  // namespace

std::vector<Index> fill_reducing_order(const SymmetricPattern& pattern,
                                       std::span<const Vec3> positions, int threads) {
  const bool placed = positions.size() == static_cast<std::size_t>(pattern.size());
  if (placed && pattern.size() >= kDissectFrom) {
    return nested_dissection(pattern, positions, threads);
  }
  return minimum_degree(pattern);
}

}  // namespace geotherm
