// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "geotherm/progress.h"
#include "solver/polyhedral/wave_kernels.h"
#include "solver/polyhedral/wave_tables.h"

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

  /// Adds edges with their keys; those beyond the ring wait outside of it.
  void add_seeds(const std::vector<std::pair<double, Index>>& seeds);

  /// Goes on to the next bucket that holds something, or to what waits outside; false when all is
  /// empty. Precondition: the current bucket is empty.
  bool advance(WavePass& pass);

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

/// How far a wave runs. Lengths in units of the intrinsic mesh.
struct WaveReach {
  double radius = kUnreached;      ///< what is farther need not have its distance
  std::span<const Index> ranks{};  ///< ends when these have theirs; empty: all within the radius
  bool is_bounded() const { return radius < kUnreached || !ranks.empty(); }
};

/// Runs one wave at a time from sources over the surface, and keeps its memory for the next one.
class WaveFront {
 public:
  /// Keeps a reference. `samples`: 1 or 3 on each edge.
  WaveFront(const WaveTables& tables, int samples, InstructionSet set = best_instruction_set());

  /// With the memory of one that is not needed any more.
  WaveFront(const WaveTables& tables, WaveFront&& spare);

  enum class Outcome {
    kDone,
    kCancelled,  ///< `progress` (stage "solve") returned false
    kEndless,    ///< distances still fell after hundreds of visits of each edge
  };

  /// Runs the wave. Where the reach is bounded, what lies within has the bits of a wave that is
  /// not; cost: O(n) once, and after that O(what was reached), if take_reached() follows.
  Outcome run(const WaveSurface& surface, const SourceSeeds& seeds, bool labels,
              const Progress& progress, const WaveReach& reach = {});

  /// A vertex that a wave has reached, with what distances() and labels() say.
  struct Reached {
    Index rank;
    double distance;
    Index label;  ///< kNoIndex where nobody asked
  };
  /// After run(): all of them, in no order. The front is as if it had never run.
  std::vector<Reached> take_reached();

  /// After run(), by rank, in units of the intrinsic mesh; kUnreached where no source can be.
  std::span<const double> distances() const { return distance_; }
  /// Of edges, `samples` each, in their direction.
  std::span<const double> sample_distances() const { return sample_; }
  /// Whether the next run need not clear the values first.
  bool is_clean() const { return clean_; }
  /// Groups of the nearest sources, when labels were asked for.
  std::span<const Index> labels() const { return label_; }
  /// The least of the distances at an edge's ends and samples, in the same units.
  double least_on(Index edge) const;
  /// The least offset, which has to be added to every distance.
  double base() const { return base_; }
  /// The number of visits of edges, and of corners where fans touch.
  std::size_t visits() const { return visits_; }

 private:
  using Keys = std::vector<std::pair<double, Index>>;

  void reset(bool labels);
  bool has_all(const WavePass& pass, const WaveReach& reach);
  bool take_corner(Index rank, std::vector<Reached>& out);
  bool clear_edge(Index edge);
  void seed(const WaveSurface& surface, const SourceSeeds& seeds);
  void seed_face(const WaveSurface& surface, const SourceSeeds::Piece& piece);
  void lower(double& value, Index* label, double candidate, Index group);
  WavePass pass();

  const WaveTables& tables_;
  int samples_;
  InstructionSet set_;
  BucketRing ring_;
  std::vector<double> distance_, sample_;
  std::vector<Index> label_, sample_label_;
  std::vector<std::uint8_t> queued_;
  std::vector<double> spread_below_;
  Keys keys_;
  double base_ = 0;
  std::size_t has_ = 0;  ///< so many of WaveReach::ranks have their final distance
  bool clean_ = false;   ///< all values are as reset() leaves them
  std::size_t visits_ = 0;
};

}  // namespace geotherm
