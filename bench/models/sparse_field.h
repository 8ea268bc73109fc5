// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bench/models/sculpture.h"
#include "geotherm/progress.h"

namespace geotherm::generate {

/// A point of the grid, counted from the box's lowest corner.
using GridPoint = std::array<int, 3>;

/// A sculpture's distances at the points of a cubic grid, kept in blocks of 4 x 4 x 4 points, and
/// only in blocks near the surface, each with the few shapes that matter there.
///
/// The grid stands aslant: a plane of the sculpture that ran along it, a little rough, would give
/// sometimes one and sometimes three squares of the grid's surface per square of its own.
///
/// Every point has one value, whichever cell asks for it. A block that is asked for and is not
/// there is made then. Cost: proportional to the surface, not to the volume.
class SparseField {
 public:
  static constexpr int kSide = 4;
  /// In spacings: values are exact where they are smaller; the surface crosses no grid edge that
  /// starts further away.
  static constexpr double kNear = 2.0;
  static constexpr int kPoints = kSide * kSide * kSide;

  /// Covers the box from `low` to `high`. `sculpture` must outlive the field.
  SparseField(const Sculpture& sculpture, double spacing, const Vec3& low, const Vec3& high);

  /// Finds and samples the blocks near the surface; false when the caller cancelled.
  bool sample(const Progress& progress);

  double spacing() const { return spacing_; }
  Vec3 position(const GridPoint& p) const { return place(Vec3(p[0], p[1], p[2])); }
  int block_count() const { return static_cast<int>(blocks_.size()); }
  GridPoint block_origin(int block) const;

  /// The block that holds the point, made when it is missing.
  int block_of(const GridPoint& p);
  static int slot_of(const GridPoint& p) {
    return (p[0] & 3) + kSide * ((p[1] & 3) + kSide * (p[2] & 3));
  }
  double value(const GridPoint& p) { return blocks_[index(block_of(p))].values[index(slot_of(p))]; }
  /// The values at the corners of the cell: bit 0 of a corner's number is x, bit 1 y, bit 2 z.
  std::array<double, 8> corner_values(const GridPoint& cell);
  void set_value(const GridPoint& p, double value) {
    blocks_[index(block_of(p))].values[index(slot_of(p))] = value;
  }

  /// The shapes that matter around `p`.
  Sculpture::Parts parts_near(const Vec3& p) const;
  const Sculpture& sculpture() const { return sculpture_; }

 private:
  /// Blocks are sampled in groups of 2 x 2 x 2 points, each with shapes of its own.
  static constexpr int kGroups = 8;
  struct Block {
    GridPoint at;                                      ///< in blocks
    std::array<std::int64_t, kGroups + 1> first_part;  ///< of each group, in parts_
    std::array<double, kPoints> values;
  };
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }
  std::size_t cell_of(const GridPoint& block) const;
  Vec3 place(const Vec3& steps) const { return low_ + spacing_ * (axes_ * steps); }
  Vec3 center_of(const GridPoint& block, int size) const;
  double reach_of(int size) const;  ///< from the centre of a cube of `size` blocks to its corners
  bool descend(const GridPoint& block, int size, Sculpture::Parts parts, const Progress& progress,
               double share, double part_of_whole);
  int make_block(const GridPoint& block, Sculpture::Parts parts);
  void sample_group(Block& block, int group, Sculpture::Parts parts);

  const Sculpture& sculpture_;
  double spacing_;
  Eigen::Matrix3d axes_;  ///< columns: the grid's directions
  Vec3 low_;
  GridPoint size_;  ///< in blocks
  std::vector<int> all_parts_;
  std::vector<int> lookup_;  ///< per cell of the block grid: its block, or -1
  std::vector<Block> blocks_;
  std::vector<int> parts_;  ///< of all groups, one after another
};

}  // namespace geotherm::generate
