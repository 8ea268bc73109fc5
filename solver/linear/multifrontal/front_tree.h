// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "solver/linear/elimination_tree.h"

namespace geotherm {

/// Runs of columns of a Cholesky factor that are kept as one dense panel.
struct Supernodes {
  std::vector<Index> first = {0};  ///< S + 1: first column of each
  std::vector<Index> below;        ///< S: rows under its own
  std::vector<Index> parent;       ///< S: kNoIndex at roots

  Index count() const { return static_cast<Index>(first.size()) - 1; }
  Index width(Index s) const { return first[s + 1] - first[s]; }
};

/// The rows of a front come in slabs of this size: the doubles of the widest register.
inline constexpr Index kSlab = 8;

inline constexpr Index slabs(Index rows) { return (rows + kSlab - 1) / kSlab; }
inline constexpr Index padded(Index rows) { return slabs(rows) * kSlab; }

/// Size of a lower triangle of slabs: slab s has 8 (s + 1) columns of 8 rows.
inline constexpr std::int64_t triangle_size(std::int64_t slab_count) {
  return kSlab * kSlab * slab_count * (slab_count + 1) / 2;
}

/// Uninitialised doubles, for the work on a front.
using Doubles = std::unique_ptr<double[]>;
inline Doubles uncleared(std::int64_t count) {
  return std::make_unique_for_overwrite<double[]>(static_cast<std::size_t>(count));
}

/// Whole subtrees, or single fronts above them, that one thread works on at a time.
struct FrontTask {
  Index begin = 0, end = 0;  ///< fronts
  Index parent = kNoIndex;   ///< task that its last front's parent belongs to
  std::vector<Index> children;
};

/// The fronts of a multifrontal factorisation (Duff, Reid 1983), one a supernode. The rows of a
/// front are numbered by place: its own columns from 0, padded to whole slabs, then the rows below.
/// Serves every matrix of one pattern.
struct FrontTree {
  Supernodes nodes;
  EliminationTree tree;                   ///< of the fronts
  std::vector<char> is_leaf;              ///< S: the front has no children
  std::vector<std::int64_t> below_start;  ///< S + 1, into place_in_parent
  std::vector<Index> place_in_parent;     ///< of each row below, its place in the parent front
  std::vector<std::int64_t> value_start;  ///< S + 1: numbers that solves read
  std::vector<std::int64_t> entry_start;  ///< n + 1: entries of the matrix's columns
  std::vector<Index> entry_offset;        ///< per entry: where it goes in its front's panel
  std::vector<FrontTask> tasks;           ///< children before parents
  std::int64_t largest_panel = 0;         ///< doubles
  /// A front's update waits on one of two stacks for its parent, which puts its own on the other.
  std::vector<std::uint8_t> stack;
  std::array<std::int64_t, 2> update_stack{};  ///< doubles that wait on each, most in any task
  std::array<std::int64_t, 2> vector_stack{};  ///< the same of rows in solves
  std::int64_t vector_path = 0;                ///< rows of all fronts above one, most in any task
  std::int64_t waiting_updates = 0;            ///< doubles that wait between tasks with one thread
  std::int64_t largest_update = 0;             ///< of those
  double operations = 0;                       ///< of one factorisation

  Index count() const { return nodes.count(); }
  Index size() const { return nodes.first.back(); }
  Index below(Index s) const { return nodes.below[s]; }
  Index width(Index s) const { return nodes.width(s); }
  /// Rows of a front vector, with room for a slab that is only begun.
  Index places(Index s) const { return padded(width(s)) + padded(below(s)); }
  const Index* places_in_parent(Index s) const { return place_in_parent.data() + below_start[s]; }
};

/// Columns whose patterns are the same but for their own rows, and beyond that narrow children
/// with their parents where that stores few zeros (Ashcraft, Grimes 1989): dense kernels want some
/// columns at a time. Precondition: columns in postorder. Cost: O(n).
Supernodes find_supernodes(const ColumnCounts& counts);

/// Builds the fronts of a pattern. Where largest_panel is beyond what an Index counts, the rest is
/// not filled. `pattern`: in elimination order, which must be a postorder; `counts`: of it. The
/// result does not depend on `threads`. Cost: O(entries of the pattern + rows of all fronts).
FrontTree build_front_tree(const SymmetricPattern& pattern, const ColumnCounts& counts,
                           int threads);

/// The same with one front for each node of a tree, as order_along() gives it: every entry of
/// `pattern` joins a node and itself or an ancestor. The tasks are those of an `earlier` tree that
/// has the same nodes.
FrontTree build_front_tree(const SymmetricPattern& pattern, const NodeOrder& order, int threads,
                           const FrontTree* earlier = nullptr);

/// The same where few rows of a pattern have changed since an `earlier` tree with the nodes of the
/// order: only fronts above these rows are laid out anew. `lower`: the lower triangle of the
/// pattern.
FrontTree update_front_tree(const LowerPattern& lower, const NodeOrder& order,
                            const FrontTree& earlier, const EarlierRows& rows, int threads);

}  // namespace geotherm
