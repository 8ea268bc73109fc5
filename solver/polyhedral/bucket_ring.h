// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "solver/polyhedral/wave_kernels.h"

namespace geotherm {

/// A queue of edges by distance: a ring of buckets, each first in, first out. A last-in bucket
/// would visit edges more often and, by measurement, give a third more error. Keys beyond the ring
/// go to its last bucket.
class BucketRing {
 public:
  /// `width` of a bucket; the ring spans at least `span`, or kMax buckets.
  BucketRing(double width, double span);

  /// Empties the ring and connects it to a pass, which then holds its state.
  void begin(WavePass& pass);

  /// Adds edges with their keys, of one bucket in this order; those beyond the ring wait outside.
  void add_seeds(const std::vector<std::pair<double, Index>>& seeds);

  /// Goes on to the next bucket that holds something, or to what waits outside; false when all is
  /// empty. Precondition: the current bucket is empty.
  bool advance(WavePass& pass);

  /// The same for a wave in steps, up to the buckets that begin below `until`: nothing that comes
  /// later has a key below `from`.
  bool advance_within(WavePass& pass, double from, double until);
  /// Takes edges with keys from `from` on again. They go to the right buckets while the ring spans
  /// what waits.
  void go_back(WavePass& pass, double from) const;
  /// Lets an edge wait, in the current bucket where that of its key is past; once more where it
  /// waits already, perhaps with a key that was larger.
  void add(WavePass& pass, double key, Index edge);
  /// At most the least key that waits, kUnreached where nothing does.
  double next(const WavePass& pass) const;

 private:
  static constexpr std::int64_t kMax = 1 << 20;

  std::int64_t bucket_of(double key) const;
  void let_in(WavePass& pass);
  void grow(WaveBucket& bucket);

  double per_length_;
  std::vector<WaveBucket> buckets_;
  std::vector<std::vector<Index>> storage_;
  std::vector<std::pair<std::int64_t, Index>> outside_;  ///< number of a bucket, ascending; edge
  std::size_t let_in_ = 0;                               ///< of `outside_`, so many are in
};

}  // namespace geotherm
