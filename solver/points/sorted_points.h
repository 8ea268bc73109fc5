// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "geotherm/types.h"

namespace geotherm {

/// The points of a cloud at different places, sorted so that neighbours stand near each other, in a
/// cube from -1 to 1. All further work is done on these: it depends neither on the order of the
/// file nor on units, and memory is read nearly in order.
struct SortedPoints {
  std::vector<Vec3> positions;  ///< Q <= P of them, no two equal
  std::vector<Index> number;    ///< Q: the lowest number of a point at that place
  std::vector<Index> same_as;   ///< P: that number for each point; empty where all differ
  double unit = 1;              ///< a length of 1 here, in model units
};

/// Sorts along a Z-shaped curve (Morton 1966). Precondition: finite positions, at least one. Cost:
/// O(P log P).
SortedPoints sort_points(std::span<const Vec3> positions, int threads);

/// Finds nearest neighbours: a k-d tree over the sorted points, by nanoflann.
class NeighbourTree {
 public:
  static constexpr int kMaxNeighbours = 100;

  /// Keeps a reference to the points. Cost: O(Q log Q). Throws std::bad_alloc.
  explicit NeighbourTree(const std::vector<Vec3>& points);
  ~NeighbourTree();
  NeighbourTree(const NeighbourTree&) = delete;
  NeighbourTree& operator=(const NeighbourTree&) = delete;

  /// The `count` points nearest to `point` without itself, fewer where there are no more, in order
  /// of distance. `numbers` and `squares` (of the distances) have room for kMaxNeighbours + 1.
  /// Returns how many there are. From any number of threads. Precondition: count <= kMaxNeighbours.
  int nearest(Index point, int count, Index* numbers, double* squares) const;

 private:
  struct Tree;
  std::unique_ptr<const Tree> tree_;
};

}  // namespace geotherm
