// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "solver/wave/wave_kernels.h"

namespace geotherm {

/// A queue of edges by distance: a ring of buckets, each first in first out. First out matters: the
/// last in would be revisited, and with a third more error (measured). Keys beyond the ring go to
/// its last bucket.
class BucketRing {
 public:
  /// `width` of a bucket; the ring spans at least `span`, or kMax buckets.
  BucketRing(double width, double span);

  /// Makes it empty and connects it to a pass, which then holds its state.
  void begin(WavePass& pass);

  /// Adds edges with keys, which may be anywhere: beyond the ring they wait outside.
  void add_seeds(const std::vector<std::pair<double, Index>>& seeds);

  /// Goes on to the next bucket that holds something, or to what waits outside; false when all is
  /// empty. Precondition: the current bucket is empty.
  bool advance(WavePass& pass);

  std::size_t bytes() const;

 private:
  static constexpr std::int64_t kMax = 1 << 20;

  void let_in(WavePass& pass);
  void grow(WaveBucket& bucket);

  double per_length_;
  std::vector<WaveBucket> buckets_;
  std::vector<std::vector<Index>> storage_;
  std::vector<std::pair<std::int64_t, Index>> outside_;  ///< bucket number, edge; ascending
  std::size_t let_in_ = 0;                               ///< of `outside_`, so many are in
};

}  // namespace geotherm
