// SPDX-License-Identifier: MIT
#include "solver/linear/elimination_tree.h"

#include <algorithm>
#include <functional>

namespace geotherm {

std::vector<Index> EliminationTree::path(std::span<const Index> rows) const {
  std::vector<Index> nodes;
  for (const Index row : rows) nodes.push_back(node_of_row[row]);
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  // Paths that meet are merged front by front: parents have larger numbers than children.
  std::vector<Index> path;
  std::vector<Index> heads = std::move(nodes);
  std::make_heap(heads.begin(), heads.end(), std::greater<>());
  while (!heads.empty()) {
    std::pop_heap(heads.begin(), heads.end(), std::greater<>());
    const Index node = heads.back();
    heads.pop_back();
    if (!path.empty() && path.back() == node) continue;
    path.push_back(node);
    if (parent[node] == kNoIndex) continue;
    heads.push_back(parent[node]);
    std::push_heap(heads.begin(), heads.end(), std::greater<>());
  }
  return path;
}

std::vector<Index> EliminationTree::path_of_flags(std::span<const char> rows) const {
  std::vector<char> visited(parent.size(), 0);
  for (std::size_t row = 0; row < rows.size(); ++row) {
    if (rows[row] != 0) visited[node_of_row[row]] = 1;
  }
  std::vector<Index> path;
  for (Index node = 0; node < static_cast<Index>(parent.size()); ++node) {
    if (visited[node] == 0) continue;
    path.push_back(node);
    if (parent[node] != kNoIndex) visited[parent[node]] = 1;
  }
  return path;
}

std::vector<Index> elimination_parents(const SymmetricPattern& pattern) {
  const auto size = static_cast<std::size_t>(pattern.size());
  std::vector<Index> parent(size, kNoIndex);
  std::vector<Index> highest(size, kNoIndex);  // ancestor found so far: a short cut upwards
  for (Index row = 0; row < pattern.size(); ++row) {
    for (const Index neighbor : pattern.neighbors(row)) {
      if (neighbor > row) break;
      for (Index column = neighbor; column != kNoIndex && column < row;) {
        const Index next = highest[column];
        highest[column] = row;
        if (next == kNoIndex) parent[column] = row;
        column = next;
      }
    }
  }
  return parent;
}

std::vector<Index> postorder(std::span<const Index> parent) {
  const auto size = static_cast<Index>(parent.size());
  std::vector<Index> first_child(parent.size() + 1, kNoIndex);  // the last: of all roots
  std::vector<Index> next_brother(parent.size(), kNoIndex);
  for (Index node = size; node-- > 0;) {
    const auto above = static_cast<std::size_t>(parent[node] == kNoIndex ? size : parent[node]);
    next_brother[node] = first_child[above];
    first_child[above] = node;
  }
  std::vector<Index> order;
  order.reserve(parent.size());
  for (Index node = first_child.back(); node != kNoIndex;) {
    while (first_child[node] != kNoIndex) {  // downwards; a child that was entered is taken off
      const Index child = first_child[node];
      first_child[node] = next_brother[child];
      next_brother[child] = kNoIndex;
      node = child;
    }
    order.push_back(node);
    if (parent[node] != kNoIndex) {
      node = parent[node];
    } else {
      node = next_brother[node];
    }
  }
  return order;
}

}  // namespace geotherm
