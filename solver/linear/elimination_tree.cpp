// SPDX-License-Identifier: MIT
#include "solver/linear/elimination_tree.h"

#include <algorithm>

namespace geotherm {

std::vector<Index> EliminationTree::path(std::span<const Index> rows) const {
  std::vector<char> seen(parent.size(), 0);
  std::vector<Index> nodes;
  for (const Index row : rows) {
    for (Index node = node_of_row[row]; node != kNoIndex && !seen[node]; node = parent[node]) {
      seen[node] = 1;
      nodes.push_back(node);
    }
  }
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

}  // namespace geotherm
