// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "geotherm/progress.h"
#include "solver/polyhedral/bucket_ring.h"
#include "solver/polyhedral/near_windows.h"
#include "solver/polyhedral/wave_kernels.h"
#include "solver/polyhedral/wave_order.h"
#include "solver/polyhedral/wave_tables.h"

namespace geotherm {

/// How far a wave runs. Lengths in units of the intrinsic mesh.
struct WaveReach {
  double radius = kUnreached;      ///< what is farther need not have its distance
  std::span<const Index> ranks{};  ///< ends when these have theirs; empty: all within the radius
  bool is_bounded() const { return radius < kUnreached || !ranks.empty(); }
};

/// How a wave begins at curves: with the straight distances inside their faces, or with exact
/// distances in a strip about them (NearWindows), which takes longer and is right also where edges
/// are long beside their distance.
enum class CurveStart { kStraight, kWindows };

/// Runs one wave at a time from sources over the surface, and keeps its memory for the next one.
class WaveFront {
 public:
  /// Keeps a reference. `samples`: 1 or 3 on each edge.
  WaveFront(const WaveTables& tables, int samples, InstructionSet set = best_instruction_set());

  /// A front that takes over the memory of one that is not needed any more.
  WaveFront(const WaveTables& tables, WaveFront&& spare);

  enum class Outcome {
    kDone,
    kCancelled,  ///< `progress` (stage "solve") returned false
    kEndless,    ///< distances still fell after hundreds of visits of each edge
  };

  /// Runs the wave. Where the reach is bounded, what lies within has the bits of a wave that is
  /// not; cost: O(n) once, and after that O(what was reached), if take_reached() follows.
  Outcome run(const WaveSurface& surface, const SourceSeeds& seeds, bool labels,
              const Progress& progress, const WaveReach& reach = {},
              CurveStart curves = CurveStart::kStraight);

  /// A wave in steps, over a piece of a surface of which others have the rest: begin() instead of
  /// run(), then go_on() and hear() in turn, for bands of keys that ascend. No labels.
  void begin(const WaveSurface& surface, const SourceSeeds& seeds);
  /// Visits what waits with keys below `until`. What was heard and what will be has keys of `from`
  /// and more.
  Outcome go_on(double from, double until);
  /// At most the least key that waits, kUnreached where nothing does.
  double next_key() const { return ring_.next(pass_); }
  /// Values that others found, of a vertex by its rank or of an edge's only sample. `is_shared`: of
  /// each edge: others see where it falls; at vertices that do not hand their distance on by
  /// themselves no other edge waits again.
  struct Heard {
    Index at;
    double value;
  };
  void hear(std::span<const Heard> vertices, std::span<const Heard> edges,
            const std::vector<char>& is_shared);
  /// Lets the edges wait at which something fell since the last call.
  void wake();

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
  /// The distances of edge samples, `samples` of each edge, in the direction of the edge.
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

  void start(const WaveSurface& surface, const SourceSeeds& seeds, bool labels, CurveStart curves);
  void reset(bool labels);
  bool has_all(const WavePass& pass, const WaveReach& reach);
  bool take_corner(Index rank, std::vector<Reached>& out);
  bool clear_edge(Index edge);
  void seed(const WaveSurface& surface, const SourceSeeds& seeds, CurveStart curves);
  void seed_face(Index rank, const SourceSeeds::Piece& piece);
  Keys keys_beyond_windows(const SourceSeeds& seeds);
  WaveValues values();
  double key_of(Index edge) const;
  std::array<WaveOrder, 3> orders_of(const WaveSurface& surface, Index edge) const;
  WavePass pass();

  const WaveTables& tables_;
  int samples_;
  InstructionSet set_;
  BucketRing ring_;
  WavePass pass_{};
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
