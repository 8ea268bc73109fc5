// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <mutex>
#include <vector>

#include "geotherm/backend.h"
#include "solver/core/large_buffer.h"
#include "solver/core/parallel.h"

namespace geotherm {

/// Blocks kept between queries. At a million faces a block of eight fields is 35 MB, which the
/// system would hand out and clear page by page each time: more work than the solves. Safe from
/// several threads; grows to what one query of each thread holds.
class BlockPool {
 public:
  BlockPool() { free_.reserve(kMax); }  // so that give() never fails, destructors call it

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
    Block out(rows, columns);
    prefer_large_pages(out.data(), static_cast<std::size_t>(out.size()) * sizeof(double));
    return out;
  }

  void give(Block block) {
    if (block.size() == 0) return;
    const std::lock_guard lock(mutex_);
    // Batches and single queries alternate at most: other shapes make room.
    if (free_.size() >= kMax) free_.erase(free_.begin());
    free_.push_back(std::move(block));
  }

 private:
  static constexpr std::size_t kMax = 16;
  std::mutex mutex_;
  std::vector<Block> free_;
};

/// What one group of source sets works with, beside the groups of other threads.
struct Workspace {
  BlockPool& pool;
  int threads = 1;  ///< that a step may use; no answer depends on it

  Block take_zero(Eigen::Index rows, Eigen::Index columns) const {
    Block out = pool.take(rows, columns);
    for_rows(out.size(), 1, [&](std::int64_t begin, std::int64_t end) {
      std::fill(out.data() + begin, out.data() + end, 0.0);
    });
    return out;
  }

  /// body(begin, end) for a pass along memory over rows of so many values, about a nanosecond each.
  template <class Body>
  void for_rows(std::int64_t rows, std::int64_t width, Body&& body) const {
    parallel_for(threads, rows, kValuesOfThread / width, body);
  }

 private:
  /// Several times what it costs to call a helper that sleeps.
  static constexpr std::int64_t kValuesOfThread = 1 << 17;
};

}  // namespace geotherm
