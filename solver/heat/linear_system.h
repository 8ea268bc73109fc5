// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "geotherm/backend.h"
#include "solver/core/memory.h"
#include "solver/core/parallel.h"
#include "solver/geometry/domain_operator.h"
#include "solver/heat/domain.h"

namespace geotherm {

/// Blocks kept between queries. At a million faces a block of 16 fields is 64 MB, which the
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

/// What one block of source sets works with, beside the blocks of other threads.
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

class LinearSystem;

/// The same system of the domain from which one has moved, or null: what Domain::changed_rows
/// leaves is not factorised again.
struct EarlierSystem {
  const Domain* domain = nullptr;
  const LinearSystem* system = nullptr;
};

/// An operator on a domain and its factorisation by some backend. Immutable.
class LinearSystem {
 public:
  /// Factorises a A + s L with `held` rows replaced by the identity's.
  static Result<std::shared_ptr<const LinearSystem>> build(
      const Domain& domain, double mass_factor, const PerComponent& stiffness_factor,
      std::vector<Index> held, const FactorOptions& options,
      const PerComponent& consistent_share = 0.0, const EarlierSystem& earlier = {});

  /// The same system and factor; with `refine` each solve is followed by a step of iterative
  /// refinement, x += M^-1 (b - M x), with M x in double (Wilkinson 1963). The residual is small
  /// beside M x row by row, and M^-1, whose entries are the heat that reaches one row from another,
  /// carries it no farther than it carries u: entries far below the largest gain as many digits.
  std::shared_ptr<const LinearSystem> refined(bool refine) const;
  bool refines() const { return refine_; }

  const DomainOperator& matrix() const { return *matrix_; }
  const Factorization& factor() const { return *factor_; }

  /// Solves with the held rows at the values that x brings: their influence is moved to the right
  /// side. `support` and `progress` as in Factorization::solve; `support` is ignored when a held
  /// value is not 0.
  Result<SolveReport> solve(Block& x, std::span<const Index> support, const Workspace& work,
                            const Progress& progress = {}) const;

  /// The same with the operator as it stands: held rows are the identity's, and nothing is moved.
  Result<SolveReport> invert(Block& x, std::span<const Index> support, const Workspace& work,
                             const Progress& progress = {}) const;
  /// invert() where only rows with a flag in `wanted` (n) are of use.
  Result<SolveReport> invert_where(Block& x, std::span<const Index> support,
                                   std::span<const char> wanted, const Workspace& work,
                                   const Progress& progress = {}) const;

 private:
  LinearSystem() = default;
  std::shared_ptr<const DomainOperator> matrix_;
  std::shared_ptr<const Factorization> factor_;
  bool refine_ = false;
};

}  // namespace geotherm
