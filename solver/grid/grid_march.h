// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <queue>
#include <span>
#include <utility>
#include <vector>

#include "solver/geometry/grid_mesh.h"

namespace geotherm {

/// Where a march begins.
struct GridSource {
  GridPlace place;  ///< in samples
  double offset;    ///< model units
  double slowness;  ///< of the sample, or of the cell that it lies in
  Index lowest;     ///< the sample, or the lowest corner of the cell
  bool in_cell;
  Index number;  ///< of the source in its set
};

/// Where a sample is, in samples.
GridPlace place_in(const GridLattice& lattice, Index sample);

/// body(sample) for those at most one step before this one and `behind` steps behind it along each
/// axis.
template <class Body>
void for_samples_around(const GridLattice& lattice, Index sample, int behind, const Body& body) {
  const int d = lattice.dimension();
  const GridPlace at = place_in(lattice, sample);
  for (int k = 0; k < 1 << (2 * d); ++k) {
    Index v = sample;
    bool there = true;
    for (int e = 0; e < d; ++e) {
      const int step = (k >> (2 * e) & 3) - 1;
      const double i = at[e] + step;
      there = there && step <= behind && i >= 0 && i < lattice.length(e);
      v += step * lattice.stride(e);
    }
    if (there) body(v);
  }
}

/// The march of one front: from one source, or from several that lie side by side. A front is
/// spread over the samples one after the other, and `merge()` keeps what is less than before.
class GridMarch {
 public:
  /// What all fronts so far came to.
  struct Found {
    std::vector<double> distances;  ///< kUnreached where none is
    std::vector<Index> nearest;     ///< numbers of sources; kNoIndex
    std::vector<Index> reached;     ///< the samples that have a distance
  };

  /// Samples farther than `reach` are not asked for.
  GridMarch(const GridLattice& lattice, double reach);

  /// One front. What is farther than `found`, where it is not null, by more than the widths
  /// of two cells in the slowest samples is left out. False: `report` said so.
  template <class Report>
  bool march(std::span<const GridSource> sources, const Found* found, const Report& report);
  /// Puts the front's samples into `found` where they are nearer, and forgets them. Of sources as
  /// near as each other the one with the lower number stays.
  void merge(Found& found);
  /// The front alone, where it has all sources and no end. The march is over.
  Found take();

 private:
  enum : std::uint8_t { kFinal = 1, kSees = 2, kFaster = 4 };
  struct News {
    double distance;
    Index sample;
    bool operator<(const News& other) const {  // the queue's top is its largest
      return distance != other.distance ? distance > other.distance : sample > other.sample;
    }
  };
  struct Offer {
    double distance;
    bool faster;  ///< from a sample that was reached through faster ones than the source's
  };
  /// A front round the source with the speed at a sample. The differences between samples are wrong
  /// by much near the source, of this front as of the one that is asked for.
  struct Round {
    double slowness, distance;
    GridPlace way, slope;
  };
  enum class Corners { kNoneSees, kSomeSee, kAllSee };

  void start(const GridSource& source);
  void settle(Index v);

  bool is(Index v, std::uint8_t what) const { return (state_[v] & what) != 0; }
  Index coordinate(Index v, int e) const {
    return e + 1 < d_ ? v % lattice_.stride(e + 1) / lattice_.stride(e) : v / lattice_.stride(e);
  }
  double length_of(const GridPlace& way) const;
  /// In samples, and the axis along which that is longest.
  std::pair<GridPlace, int> way_to(const GridSource& source, const GridPlace& at) const;
  double line_from(const GridSource& source, const GridPlace& at) const;
  bool is_faster(Index v, Index source) const;
  Index neighbor(Index v, int e, int step) const;
  Index cell_towards(Index v, const std::array<int, 3>& steps) const;
  void start_at(Index v, double distance, Index source);
  void set(Index v, double distance, Index source);
  void update(Index v, Index from, int axis, int step);
  bool may_be_faster(Index v, Index source) const;
  bool round_at(Index v, Index source, Round& round) const;
  Offer slope_in(Index v, const std::array<int, 3>& steps, Index source, const Round* round,
                 const Offer& most) const;
  void see_those_of_neighbors(Index v);
  bool see(Index v, Index source, bool follows);
  Corners corners_at(const GridPlace& at, int main, Index source, bool wants_some) const;
  bool is_in_sight(const GridPlace& at, const GridPlace& way, int main, Index source,
                   double samples) const;

  const GridLattice& lattice_;
  const Grid& grid_;
  const int d_;
  const double reach_;
  double fastest_ = kUnreached, slowest_ = 0;  ///< least and largest slowness, of several speeds
  std::span<const GridSource> sources_;
  std::vector<double> distance_;
  std::vector<Index> nearest_;  ///< into sources_
  std::vector<std::uint8_t> state_;
  std::vector<Index> touched_;
  std::priority_queue<News> queue_;
};

template <class Report>
bool GridMarch::march(std::span<const GridSource> sources, const Found* found,
                      const Report& report) {
  constexpr std::int64_t kReported = 1 << 16;
  std::int64_t done = 0;
  double slack = 0;
  sources_ = sources;
  for (const GridSource& source : sources) {
    start(source);
    for (int e = 0; e < d_; ++e) {
      slack = std::max(slack, 2 * lattice_.spacing(e) * std::max(source.slowness, slowest_));
    }
  }
  while (!queue_.empty()) {
    const auto [distance, v] = queue_.top();
    queue_.pop();
    if (is(v, kFinal) || distance != distance_[v]) continue;  // it was changed meanwhile
    if (sources.size() > 1) see_those_of_neighbors(v);
    // What lies between may have become final after the last neighbour.
    if (see(v, nearest_[v], true) && distance != distance_[v]) continue;
    if (distance > reach_) break;
    state_[v] |= kFinal;
    if (++done % kReported == 0 && !report(done)) return false;
    if (found != nullptr && distance > found->distances[v] + slack) continue;
    settle(v);
  }
  return true;
}

}  // namespace geotherm
