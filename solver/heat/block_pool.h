// SPDX-License-Identifier: MIT
#pragma once

#include <mutex>
#include <vector>

#include "solver/linear/backend.h"

namespace geotherm {

/// Blocks kept between queries. At a million faces a block of eight fields is 35 MB, which the
/// system would hand out and clear page by page each time: more work than the solves. Safe from
/// several threads; grows to what one query of each thread holds.
class BlockPool {
 public:
  /// A block with any content.
  Block take(Eigen::Index rows, Eigen::Index columns) {
    {
      const std::lock_guard lock(mutex_);
      for (Block& block : free_) {
        if (block.rows() != rows || block.cols() != columns) continue;
        Block out = std::move(block);
        block = std::move(free_.back());
        free_.pop_back();
        return out;
      }
    }
    return Block(rows, columns);
  }

  Block take_zero(Eigen::Index rows, Eigen::Index columns) {
    Block out = take(rows, columns);
    out.setZero();
    return out;
  }

  void give(Block block) {
    if (block.size() == 0) return;
    const std::lock_guard lock(mutex_);
    // Batches and single queries alternate at most: other shapes make room.
    if (free_.size() >= kMost) free_.erase(free_.begin());
    free_.push_back(std::move(block));
  }

 private:
  static constexpr std::size_t kMost = 16;
  std::mutex mutex_;
  std::vector<Block> free_;
};

}  // namespace geotherm
