// SPDX-License-Identifier: MIT
#include "solver/linear/elimination_tree.h"

#include <algorithm>
#include <array>
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

namespace {

/// Which nodes of a postorder are above which, and where branches meet.
class Ancestors {
 public:
  explicit Ancestors(std::span<const Index> parent) : parent_(parent), first_(parent.size()) {
    for (Index s = 0; s < std::ssize(parent); ++s) first_[s] = s;
    for (Index s = 0; s < std::ssize(parent); ++s) {
      if (parent[s] != kNoIndex) first_[parent[s]] = std::min(first_[parent[s]], first_[s]);
    }
  }
  /// Whether one is above the other, or they are the same.
  bool related(Index a, Index b) const {
    const auto [low, high] = std::minmax(a, b);
    return first_[high] <= low;
  }
  /// The lowest node above `low` that is above `high`, too; kNoIndex where there is none.
  Index meeting(Index low, Index high) const {
    while (low != kNoIndex && (low < high || first_[low] > high)) low = parent_[low];
    return low;
  }

 private:
  std::span<const Index> parent_;
  std::vector<Index> first_;  ///< the lowest node of each subtree
};

/// The sides of faces that join vertices of unrelated nodes, or new vertices; most faces have none.
std::vector<std::array<Index, 2>> edges_to_settle(const Ancestors& tree,
                                                  std::span<const Index> node,
                                                  std::span<const Face> faces) {
  std::vector<std::array<Index, 2>> edges;
  for (const Face& face : faces) {
    for (int k = 0; k < 3; ++k) {
      const Index a = face[k], b = face[k == 2 ? 0 : k + 1];
      const bool placed = node[a] != kNoIndex && node[b] != kNoIndex;
      if (!placed || !tree.related(node[a], node[b])) edges.push_back({a, b});
    }
  }
  return edges;
}

/// Puts new vertices into the lowest node of a neighbour that has one. False where one has none.
bool place_new(std::span<const std::array<Index, 2>> edges, std::vector<Index>& node) {
  // A vertex whose neighbours are all new waits until one of them has a node.
  for (bool waits = true; waits;) {
    waits = false;
    std::vector<std::pair<Index, Index>> found;
    for (const auto& [a, b] : edges) {
      if (node[a] == kNoIndex && node[b] != kNoIndex) found.emplace_back(a, node[b]);
      if (node[b] == kNoIndex && node[a] != kNoIndex) found.emplace_back(b, node[a]);
      waits |= node[a] == kNoIndex || node[b] == kNoIndex;
    }
    std::sort(found.begin(), found.end());
    for (auto at = found.rbegin(); at != found.rend(); ++at) node[at->first] = at->second;
    if (waits && found.empty()) return false;
  }
  return true;
}

}  // namespace

std::optional<NodeOrder> order_along(std::span<const Index> parent, std::span<const Index> order,
                                     std::vector<Index>& node, std::span<const Face> faces) {
  std::vector<char> is_new(node.size());
  for (std::size_t v = 0; v < node.size(); ++v) is_new[v] = node[v] == kNoIndex ? 1 : 0;
  const Ancestors tree(parent);
  const auto edges = edges_to_settle(tree, node, faces);
  if (!place_new(edges, node)) return std::nullopt;
  for (const auto& [a, b] : edges) {
    const Index low = node[a] < node[b] ? a : b, high = low == a ? b : a;
    if (tree.related(node[low], node[high])) continue;
    node[high] = tree.meeting(node[high], node[low]);
    if (node[high] == kNoIndex) return std::nullopt;
  }
  NodeOrder out;
  std::vector<Index> start(parent.size() + 1, 0);
  for (const Index s : node) {
    if (s != kNoIndex) ++start[s + 1];
  }
  std::vector<Index> number(parent.size(), kNoIndex);
  for (std::size_t s = 0; s < parent.size(); ++s) {
    if (start[s + 1] > 0) {
      number[s] = static_cast<Index>(out.first.size());
      out.first.push_back(start[s]);
    }
    start[s + 1] += start[s];
  }
  out.first.push_back(start.back());
  for (std::size_t s = 0; s < parent.size(); ++s) {
    if (number[s] == kNoIndex) continue;
    Index above = parent[s];
    while (above != kNoIndex && number[above] == kNoIndex) above = parent[above];
    out.parent.push_back(above == kNoIndex ? kNoIndex : number[above]);
  }
  out.order.resize(static_cast<std::size_t>(out.first.back()));
  for (const Index v : order) out.order[start[node[v]]++] = v;
  for (std::size_t v = 0; v < node.size(); ++v) {
    if (is_new[v] != 0 && node[v] != kNoIndex) {
      out.order[start[node[v]]++] = static_cast<Index>(v);
    }
  }
  return out;
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
  std::vector<Index> next_sibling(parent.size(), kNoIndex);
  for (Index node = size; node-- > 0;) {
    const auto above = static_cast<std::size_t>(parent[node] == kNoIndex ? size : parent[node]);
    next_sibling[node] = first_child[above];
    first_child[above] = node;
  }
  std::vector<Index> order;
  order.reserve(parent.size());
  for (Index node = first_child.back(); node != kNoIndex;) {
    while (first_child[node] != kNoIndex) {  // downwards; a child that was entered is taken off
      const Index child = first_child[node];
      first_child[node] = next_sibling[child];
      next_sibling[child] = kNoIndex;
      node = child;
    }
    order.push_back(node);
    if (parent[node] != kNoIndex) {
      node = parent[node];
    } else {
      node = next_sibling[node];
    }
  }
  return order;
}

namespace {

/// The columns in which one row of the factor has entries are a subtree of the elimination tree,
/// whose leaves are entries of the matrix. Leaves are met in postorder; each adds to the counts the
/// path up to where it meets the path of the leaf before.
class RowSubtrees {
 public:
  RowSubtrees(const std::vector<Index>& parent, const std::vector<Index>& order)
      : parent_(parent),
        first_descendant_(parent.size(), kNoIndex),
        last_first_(parent.size(), kNoIndex),
        last_leaf_(parent.size(), kNoIndex),
        set_(parent.size()) {
    for (std::size_t k = 0; k < order.size(); ++k) {
      set_[k] = static_cast<Index>(k);
      for (Index j = order[k]; j != kNoIndex && first_descendant_[j] == kNoIndex; j = parent_[j]) {
        first_descendant_[j] = static_cast<Index>(k);
      }
    }
  }

  /// Whether no descendant of `column` has an entry in `row`; columns come in postorder.
  bool is_leaf(Index row, Index column) {
    if (first_descendant_[column] <= last_first_[row]) return false;
    last_first_[row] = first_descendant_[column];
    return true;
  }

  /// Where the path of this leaf meets that of the leaf of the row before; kNoIndex for the first.
  Index meeting(Index row, Index leaf) {
    const Index before = last_leaf_[row];
    last_leaf_[row] = leaf;
    if (before == kNoIndex) return kNoIndex;
    Index root = before;
    while (set_[root] != root) root = set_[root];
    for (Index j = before; j != root;) {  // path compression
      const Index next = set_[j];
      set_[j] = root;
      j = next;
    }
    return root;
  }

  /// All leaves of this column have been met.
  void finish(Index column) {
    if (parent_[column] != kNoIndex) set_[column] = parent_[column];
  }

 private:
  const std::vector<Index>& parent_;
  std::vector<Index> first_descendant_;  ///< place in postorder
  std::vector<Index> last_first_;        ///< per row: first descendant of its last leaf
  std::vector<Index> last_leaf_;         ///< per row
  std::vector<Index> set_;               ///< disjoint sets of finished columns under their ancestor
};

}  // namespace

ColumnCounts count_columns(const SymmetricPattern& pattern) {
  ColumnCounts out{elimination_parents(pattern), {}};
  const std::vector<Index>& parent = out.parent;
  const std::vector<Index> order = postorder(parent);
  RowSubtrees subtrees(parent, order);
  // Differences along the tree first, sums up the tree then. The diagonal is counted until the end.
  std::vector<Index>& count = out.below;
  count.assign(parent.size(), 1);
  for (std::size_t j = 0; j < parent.size(); ++j) {
    if (parent[j] != kNoIndex) count[parent[j]] = 0;  // no leaf of the tree
  }
  for (const Index column : order) {
    if (parent[column] != kNoIndex) --count[parent[column]];
    for (const Index row : pattern.neighbors(column)) {
      if (row < column || !subtrees.is_leaf(row, column)) continue;
      ++count[column];
      const Index meeting = subtrees.meeting(row, column);
      if (meeting != kNoIndex) --count[meeting];
    }
    subtrees.finish(column);
  }
  for (const Index column : order) {
    if (parent[column] != kNoIndex) count[parent[column]] += count[column];
  }
  for (Index& c : count) --c;
  return out;
}

}  // namespace geotherm
