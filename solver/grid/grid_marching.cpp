// SPDX-License-Identifier: MIT
#include "solver/grid/grid_marching.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <queue>
#include <string>
#include <utility>

#include "solver/core/parallel.h"
#include "solver/core/stopwatch.h"
#include "solver/method/marching_method.h"

namespace geotherm {
namespace {

/// One query.
class GridMarch {
 public:
  explicit GridMarch(const GridLattice& lattice, double reach = kUnreached)
      : lattice_(lattice), grid_(lattice.grid()), d_(lattice.dimension()), reach_(reach) {
    const auto count = static_cast<std::size_t>(grid_.sample_count());
    distance_.assign(count, kUnreached);
    nearest_.assign(count, kNoIndex);
    state_.assign(count, 0);
  }

  Result<void> add_sample(Index sample, double offset) {
    if (sample < 0 || sample >= grid_.sample_count() || !(grid_.speed(sample) > 0)) {
      return Error{ErrorCode::kBadInput,
                   "source sample " + std::to_string(sample) + " is not there, or does not pass"};
    }
    sources_.push_back({place_of(sample), offset, 1 / grid_.speed(sample)});
    start_at(sample, offset);
    return {};
  }

  Result<void> add_point(const CellPoint& point) {
    if (auto valid = check_cell_point(lattice_, point); !valid) return valid;
    const GridCell cell = lattice_.cell(point.cell);
    GridPlace at{};
    for (int k = 0; k < cell.count; ++k) {
      const GridPlace corner = place_of(cell.corners[k]);
      for (int e = 0; e < d_; ++e) at[e] += point.weights[k] * corner[e];
    }
    for (int e = 0; e < d_; ++e) {  // weights are rounded
      const double low = coordinate(point.cell, e);
      at[e] = std::clamp(at[e], low, low + 1);
    }
    sources_.push_back({at, 0, cell.slowness});
    for (int k = 0; k < cell.count; ++k) {
      start_at(cell.corners[k], line_from(sources_.back(), place_of(cell.corners[k])));
    }
    start_around(point.cell);
    return {};
  }

  Result<void> march(const Progress& progress) {
    constexpr std::int64_t kReported = 1 << 16;
    const auto samples = static_cast<double>(distance_.size());
    std::int64_t done = 0;
    while (!queue_.empty()) {
      const auto [distance, v] = queue_.top();
      queue_.pop();
      if (is(v, kFinal) || distance != distance_[v]) continue;  // it was changed meanwhile
      // What lies between may have become final after the last neighbour.
      if (see(v, nearest_[v]) && distance != distance_[v]) continue;
      if (distance > reach_) break;
      state_[v] |= kFinal;
      if (reach_ < kUnreached) near_.push_back({v, distance});
      if (++done % kReported == 0 &&
          !report(progress, "marching", static_cast<double>(done) / samples)) {
        return cancelled_error();
      }
      for (int e = 0; e < d_; ++e) {
        for (const int step : {-1, 1}) {
          const Index w = neighbor(v, e, step);
          if (w != kNoIndex && !is(w, kFinal)) update(w, v, e, -step);
        }
      }
    }
    return {};
  }

  std::vector<double> take_distances() { return std::move(distance_); }
  std::vector<Index> take_nearest() { return std::move(nearest_); }
  /// The samples within reach, where the march has one.
  std::vector<NearSample> take_near() { return std::move(near_); }

 private:
  enum : std::uint8_t { kFinal = 1, kSees = 2 };
  struct Source {
    GridPlace place;
    double offset, slowness;
  };
  struct News {
    double distance;
    Index sample;
    bool operator<(const News& other) const {  // the queue's top is its largest
      return distance != other.distance ? distance > other.distance : sample > other.sample;
    }
  };

  bool is(Index v, std::uint8_t what) const { return (state_[v] & what) != 0; }
  Index coordinate(Index v, int e) const {
    return e + 1 < d_ ? v % lattice_.stride(e + 1) / lattice_.stride(e) : v / lattice_.stride(e);
  }
  GridPlace place_of(Index v) const {
    GridPlace out{};
    for (int e = 0; e < d_; ++e) out[e] = coordinate(v, e);
    return out;
  }
  double line_from(const Source& source, const GridPlace& at) const {
    double square = 0;
    for (int e = 0; e < d_; ++e) {
      const double along = (at[e] - source.place[e]) * lattice_.spacing(e);
      square += along * along;
    }
    return source.offset + source.slowness * std::sqrt(square);
  }

  /// The next sample that passes; kNoIndex: there is none.
  Index neighbor(Index v, int e, int step) const {
    if (step > 0) return lattice_.has_edge(v, e) ? v + lattice_.stride(e) : kNoIndex;
    const Index before = v - lattice_.stride(e);
    return before >= 0 && lattice_.has_edge(before, e) ? before : kNoIndex;
  }

  void start_at(Index v, double distance) {
    if (distance >= distance_[v]) return;
    set(v, distance, static_cast<Index>(sources_.size()) - 1);
    state_[v] |= kSees;
  }

  /// Starts at the samples of the cells beside that of the source that was added last, which has
  /// this lowest corner: see() would ask some of them for corners that are farther off.
  void start_around(Index lowest) {
    const Source& source = sources_.back();
    for (int k = 0; k < 1 << (2 * d_); ++k) {
      Index v = lowest;
      bool there = true;
      for (int e = 0; e < d_; ++e) {
        const int step = (k >> (2 * e) & 3) - 1;  // from one before the cell to one behind it
        const Index i = coordinate(lowest, e) + step;
        there = there && i >= 0 && i < lattice_.length(e);
        v += step * lattice_.stride(e);
      }
      if (!there || !(grid_.speed(v) > 0)) continue;
      const GridPlace at = place_of(v);
      if (lattice_.is_in_sight(at, source.place, source.slowness)) {
        start_at(v, line_from(source, at));
      }
    }
  }

  void set(Index v, double distance, Index source) {
    distance_[v] = distance;
    nearest_[v] = source;
    state_[v] &= static_cast<std::uint8_t>(~kSees);
    queue_.push({distance, v});
  }

  /// The lowest corner of the cell at v towards the steps; kNoIndex: there is none.
  Index cell_towards(Index v, const std::array<int, 3>& steps) const {
    Index lowest = v;
    for (int e = 0; e < d_; ++e) {
      if (steps[e] < 0) lowest -= lattice_.stride(e);
      if (steps[e] < 0 && coordinate(v, e) == 0) return kNoIndex;
    }
    return lattice_.has_cell(lowest) ? lowest : kNoIndex;
  }

  /// A neighbour of v became final: `from`, `step` along `axis`.
  void update(Index v, Index from, int axis, int step) {
    if (see(v, nearest_[from])) return;
    const double along = lattice_.spacing(axis) * (1 / grid_.speed(v) + 1 / grid_.speed(from)) / 2;
    double best = distance_[from] + along;
    for (int k = 0; k < 1 << d_; ++k) {  // the cells at this edge
      if ((k >> axis & 1) != 0) continue;
      std::array<int, 3> steps{};
      for (int e = 0; e < d_; ++e) steps[e] = e == axis ? step : (k >> e & 1) != 0 ? 1 : -1;
      if (cell_towards(v, steps) != kNoIndex) best = std::min(best, slope_in(v, steps, best));
    }
    if (best < distance_[v]) set(v, best, nearest_[from]);
  }

  /// The distance that has the slope 1 / speed from the final neighbours of v in a cell, at most
  /// `most`.
  double slope_in(Index v, const std::array<int, 3>& steps, double most) const {
    struct Side {
      double known, weight, value;  ///< weight (d - value)^2 is the square of the slope along it
    };
    std::array<Side, 3> sides;
    int count = 0;
    for (int e = 0; e < d_; ++e) {
      const Index a = v + steps[e] * lattice_.stride(e);
      if (!is(a, kFinal)) continue;
      const double h = lattice_.spacing(e), first = distance_[a];
      Side& side = sides[count++];
      side = {first, 1 / (h * h), first};
      const Index b = neighbor(a, e, steps[e]);
      if (b == kNoIndex || !is(b, kFinal) || distance_[b] > first) continue;
      side.weight *= 2.25;
      side.value = (4 * first - distance_[b]) / 3;
    }
    const double slowness = 1 / grid_.speed(v);
    // The farthest neighbour is left out until the rest is upwind of the answer.
    std::sort(sides.begin(), sides.begin() + count,
              [](const Side& a, const Side& b) { return a.known < b.known; });
    for (; count > 1; --count) {
      double a = 0, b = 0, c = -slowness * slowness;
      for (int i = 0; i < count; ++i) {
        a += sides[i].weight;
        b += sides[i].weight * sides[i].value;
        c += sides[i].weight * sides[i].value * sides[i].value;
      }
      const double root = b * b - a * c;
      if (!(root >= 0)) continue;
      const double distance = (b + std::sqrt(root)) / a;
      if (distance >= sides[count - 1].known) return std::min(distance, most);
    }
    return most;
  }

  /// Whether v sees a source, so that the straight line is its distance: the line leaves the cell
  /// towards it between corners that see it.
  bool see(Index v, Index source) {
    if (is(v, kSees) && nearest_[v] == source) return true;
    const Source& s = sources_[source];
    const GridPlace at = place_of(v);
    GridPlace way{};  // to the source, in samples
    int main = 0;
    for (int e = 0; e < d_; ++e) {
      way[e] = s.place[e] - at[e];
      if (std::abs(way[e]) > std::abs(way[main])) main = e;
    }
    if (std::abs(way[main]) < 1) return false;
    const double line = line_from(s, at);
    if (line > distance_[v] && nearest_[v] != source) return false;
    std::array<int, 3> steps{};
    std::array<Index, 3> cell{};  // that the line runs through at v
    bool straight = true;         // along an edge
    for (int e = 0; e < d_; ++e) {
      steps[e] = way[e] < 0 ? -1 : 1;
      cell[e] = static_cast<Index>(at[e]) - (way[e] < 0 ? 1 : 0);
      straight = straight && (e == main || way[e] == 0);
    }
    const Index next = neighbor(v, main, steps[main]);
    if (straight) {
      if (next == kNoIndex || !is_same_slowness(1 / grid_.speed(v), s.slowness)) return false;
    } else if (!lattice_.passes(cell, way, s.slowness)) {
      return false;
    }
    for (int k = 0; k < 1 << d_; ++k) {  // the corners of the side that the line crosses
      if ((k >> main & 1) != 0) continue;
      Index corner = v + steps[main] * lattice_.stride(main);
      double weight = 1;
      for (int e = 0; e < d_; ++e) {
        if (e == main) continue;
        const double share = std::abs(way[e]) / std::abs(way[main]);
        weight *= (k >> e & 1) != 0 ? share : 1 - share;
        if ((k >> e & 1) != 0) corner += steps[e] * lattice_.stride(e);
      }
      if (!(weight > 0)) continue;
      if (!is(corner, kSees) || !is(corner, kFinal) || nearest_[corner] != source) return false;
    }
    set(v, line, source);  // also upwards: a slope may be too flat
    state_[v] |= kSees;
    return true;
  }

  const GridLattice& lattice_;
  const Grid& grid_;
  const int d_;
  const double reach_;  ///< farther samples are not asked for
  std::vector<NearSample> near_;
  std::vector<Source> sources_;
  std::vector<double> distance_;
  std::vector<Index> nearest_;
  std::vector<std::uint8_t> state_;
  std::priority_queue<News> queue_;
};

class GridMarchingMethod final : public MarchingMethod {
 public:
  GridMarchingMethod(GridLattice lattice, double setup_ms, int threads)
      : MarchingMethod(lattice.grid().sample_count(),
                       lattice.grid().sample_count() / double(1 << 20), setup_ms, threads,
                       kNanosecondsOfSample),
        lattice_(std::move(lattice)) {}

 private:
  static constexpr double kNanosecondsOfSample = 500;

  Result<Marched> march(const SourceSet& sources, const Progress& progress) const override {
    if (auto valid = check_space_sources(sources, "samples or points of cells"); !valid) {
      return valid.error();
    }
    GridMarch march(lattice_);
    for (std::size_t i = 0; i < sources.points.size(); ++i) {
      const double offset = sources.offsets.empty() ? 0 : sources.offsets[i];
      if (auto added = march.add_sample(sources.points[i].vertex, offset); !added) {
        return added.error();
      }
    }
    for (const CellPoint& point : sources.cell_points) {
      if (auto added = march.add_point(point); !added) return added.error();
    }
    if (auto done = march.march(progress); !done) return done.error();
    return Marched{march.take_distances(), march.take_nearest()};
  }

  double eikonal_error(std::span<const double> distances) const override {
    double error = 0, measure = 0;
    lattice_.for_each_cell(0, lattice_.layer_count(), [&](const GridCell& cell) {
      double square = 0;
      for (int e = 0; e < lattice_.dimension(); ++e) {
        if (cell.axis >= 0 && cell.axis != e) continue;
        double rise = 0;
        for (int k = 0; k < cell.count; ++k) {
          const bool far = cell.count == 2 ? k == 1 : (k >> e & 1) != 0;
          rise += far ? distances[cell.corners[k]] : -distances[cell.corners[k]];
        }
        const double slope = rise * 2 / cell.count / (lattice_.spacing(e) * cell.slowness);
        square += slope * slope;
      }
      if (!std::isfinite(square)) return;
      double size = 1;
      for (int e = 0; e < lattice_.dimension(); ++e) size *= cell.slowness;
      error += size * std::abs(std::sqrt(square) - 1);
      measure += size;
    });
    return measure > 0 ? error / measure : 0.0;
  }

  GridLattice lattice_;
};

}  // namespace

Result<void> check_cell_point(const GridLattice& lattice, const CellPoint& point) {
  if (point.cell < 0 || point.cell >= lattice.grid().sample_count() ||
      !lattice.has_cell(point.cell)) {
    return Error{ErrorCode::kBadInput,
                 "at sample " + std::to_string(point.cell) + " begins no cell"};
  }
  return check_weights(point.weights, std::size_t{1} << lattice.dimension(),
                       "cell " + std::to_string(point.cell));
}

Result<std::shared_ptr<const DistanceMethod>> build_grid_marching(std::shared_ptr<const Grid> grid,
                                                                  int threads,
                                                                  const Progress& progress) {
  if (auto valid = check_grid(*grid); !valid) return valid.error();
  if (!report(progress, "operators", 0.0)) return cancelled_error();
  const Stopwatch watch;
  GridLattice lattice(std::move(grid));
  return std::shared_ptr<const DistanceMethod>(std::make_shared<const GridMarchingMethod>(
      std::move(lattice), watch.milliseconds(), threads));
}

std::vector<NearSample> march_near(const GridLattice& lattice, std::span<const Index> samples,
                                   std::span<const CellPoint> points, double reach) {
  GridMarch march(lattice, reach);
  for (const Index sample : samples) static_cast<void>(march.add_sample(sample, 0));
  for (const CellPoint& point : points) static_cast<void>(march.add_point(point));
  static_cast<void>(march.march({}));
  return march.take_near();
}

}  // namespace geotherm
