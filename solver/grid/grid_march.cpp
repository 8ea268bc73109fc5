// SPDX-License-Identifier: MIT
#include "solver/grid/grid_march.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace geotherm {

GridPlace place_in(const GridLattice& lattice, Index sample) {
  GridPlace out{};
  const int last = lattice.dimension() - 1;
  for (int e = 0; e < last; ++e) {
    out[e] = sample % lattice.stride(e + 1) / lattice.stride(e);
  }
  out[last] = sample / lattice.stride(last);
  return out;
}

GridMarch::GridMarch(const GridLattice& lattice, double reach)
    : lattice_(lattice), grid_(lattice.grid()), d_(lattice.dimension()), reach_(reach) {
  const auto count = static_cast<std::size_t>(grid_.sample_count());
  distance_.assign(count, kUnreached);
  nearest_.assign(count, kNoIndex);
  state_.assign(count, 0);
  if (lattice.has_one_speed()) return;
  for (const double speed : grid_.speeds) {
    if (!(speed > 0)) continue;
    fastest_ = std::min(fastest_, 1 / speed);
    slowest_ = std::max(slowest_, 1 / speed);
  }
}

void GridMarch::merge(Found& found) {
  for (const Index v : touched_) {
    const Index number = sources_[nearest_[v]].number;
    const bool is_less = distance_[v] < found.distances[v] ||
                         (distance_[v] == found.distances[v] && number < found.nearest[v]);
    if (is(v, kFinal) && is_less) {
      if (found.nearest[v] == kNoIndex) found.reached.push_back(v);
      found.distances[v] = distance_[v];
      found.nearest[v] = number;
    }
    distance_[v] = kUnreached;
    nearest_[v] = kNoIndex;
    state_[v] = 0;
  }
  touched_.clear();
  queue_ = {};
}

GridMarch::Found GridMarch::take() {
  return {std::move(distance_), std::move(nearest_), std::move(touched_)};
}

double GridMarch::length_of(const GridPlace& way) const {
  double square = 0;
  for (int e = 0; e < d_; ++e) {
    const double along = way[e] * lattice_.spacing(e);
    square += along * along;
  }
  return std::sqrt(square);
}

double GridMarch::line_from(const GridSource& source, const GridPlace& at) const {
  GridPlace way{};
  for (int e = 0; e < d_; ++e) way[e] = at[e] - source.place[e];
  return source.offset + source.slowness * length_of(way);
}

std::pair<GridPlace, int> GridMarch::way_to(const GridSource& source, const GridPlace& at) const {
  GridPlace way{};
  int main = 0;
  for (int e = 0; e < d_; ++e) {
    way[e] = source.place[e] - at[e];
    if (std::abs(way[e]) > std::abs(way[main])) main = e;
  }
  return {way, main};
}

bool GridMarch::is_faster(Index v, Index source) const {
  constexpr double kRoundOff = 1e-12;
  return 1 / grid_.speed(v) < sources_[source].slowness * (1 - kRoundOff);
}

/// The next sample that passes; kNoIndex: there is none.
Index GridMarch::neighbor(Index v, int e, int step) const {
  if (step > 0) return lattice_.has_edge(v, e) ? v + lattice_.stride(e) : kNoIndex;
  const Index before = v - lattice_.stride(e);
  return before >= 0 && lattice_.has_edge(before, e) ? before : kNoIndex;
}

/// The lowest corner of the cell at v towards the steps; kNoIndex: there is none.
Index GridMarch::cell_towards(Index v, const std::array<int, 3>& steps) const {
  Index lowest = v;
  for (int e = 0; e < d_; ++e) {
    if (steps[e] < 0) lowest -= lattice_.stride(e);
    if (steps[e] < 0 && coordinate(v, e) == 0) return kNoIndex;
  }
  return lattice_.has_cell(lowest) ? lowest : kNoIndex;
}

void GridMarch::start(const GridSource& source) {
  const auto number = static_cast<Index>(&source - sources_.data());
  if (!source.in_cell) return start_at(source.lowest, source.offset, number);
  const GridCell cell = lattice_.cell(source.lowest);
  for (int k = 0; k < cell.count; ++k) {
    start_at(cell.corners[k], line_from(source, place_in(lattice_, cell.corners[k])), number);
  }
  // The samples of the cells beside it: see() would ask some for corners that are farther off.
  for_samples_around(lattice_, source.lowest, 2, [&](Index v) {
    if (!(grid_.speed(v) > 0)) return;
    const GridPlace at = place_in(lattice_, v);
    const auto [way, main] = way_to(source, at);
    if (is_in_sight(at, way, main, number, kUnreached)) {
      start_at(v, line_from(source, at), number);
    }
  });
}

void GridMarch::start_at(Index v, double distance, Index source) {
  if (distance >= distance_[v]) return;
  set(v, distance, source);
  state_[v] |= kSees;
}

void GridMarch::set(Index v, double distance, Index source) {
  if (nearest_[v] == kNoIndex) touched_.push_back(v);
  distance_[v] = distance;
  nearest_[v] = source;
  state_[v] = 0;
  queue_.push({distance, v});
}

/// Sample v has become final.
void GridMarch::settle(Index v) {
  for (int e = 0; e < d_; ++e) {
    for (const int step : {-1, 1}) {
      const Index w = neighbor(v, e, step);
      if (w != kNoIndex && !is(w, kFinal)) update(w, v, e, -step);
    }
  }
}

/// A neighbour of v became final: `from`, `step` along `axis`.
void GridMarch::update(Index v, Index from, int axis, int step) {
  const Index source = nearest_[from];
  const bool sees = see(v, source, false);
  if (sees && !may_be_faster(v, source)) return;
  const double along = lattice_.spacing(axis) * (1 / grid_.speed(v) + 1 / grid_.speed(from)) / 2;
  Offer best{distance_[from] + along, is(from, kFaster)};
  Round round;
  const bool is_round = round_at(v, source, round);
  for (int k = 0; k < 1 << d_; ++k) {  // the cells at this edge
    if ((k >> axis & 1) != 0) continue;
    std::array<int, 3> steps{};
    for (int e = 0; e < d_; ++e) steps[e] = e == axis ? step : (k >> e & 1) != 0 ? 1 : -1;
    if (cell_towards(v, steps) == kNoIndex) continue;
    best = slope_in(v, steps, source, is_round ? &round : nullptr, best);
  }
  if (lattice_.has_one_speed()) {  // nothing is nearer than the straight line
    best.distance = std::max(best.distance, line_from(sources_[source], place_in(lattice_, v)));
  }
  if (!(best.distance < distance_[v])) return;
  const bool faster = best.faster || is_faster(v, source);
  if (sees && !faster) return;
  set(v, best.distance, source);
  if (faster) state_[v] |= kFaster;
}

/// Whether v, which sees the source, may be reached sooner than along the straight line: nothing is
/// before that but what came through faster samples.
bool GridMarch::may_be_faster(Index v, Index source) const {
  if (lattice_.has_one_speed() || fastest_ >= sources_[source].slowness) return false;
  for (int e = 0; e < d_; ++e) {
    for (const int step : {-1, 1}) {
      const Index w = neighbor(v, e, step);
      if (w != kNoIndex && is(w, kFinal) && is(w, kFaster)) return true;
    }
  }
  return is_faster(v, source);
}

/// False: the front has several sources, or v is too far off for it to matter. Where there is one
/// speed, lines are right as far as they go.
bool GridMarch::round_at(Index v, Index source, Round& round) const {
  constexpr double kFar = 48;
  if (sources_.size() > 1 || lattice_.has_one_speed()) return false;
  for (int e = 0; e < d_; ++e) {
    round.way[e] = coordinate(v, e) - sources_[source].place[e];
    if (std::abs(round.way[e]) > kFar) return false;
  }
  const double length = length_of(round.way);
  round.slowness = 1 / grid_.speed(v);
  round.distance = round.slowness * length;
  for (int e = 0; e < d_ && length > 0; ++e) {
    round.slope[e] = round.slowness * round.way[e] * lattice_.spacing(e) / length;
  }
  return true;
}

/// The distance that has the slope 1 / speed from the final neighbours of v in a cell, at most
/// `most`.
GridMarch::Offer GridMarch::slope_in(Index v, const std::array<int, 3>& steps, Index source,
                                     const Round* round, const Offer& most) const {
  struct Side {
    double known, weight, value;  ///< weight (d - value)^2 is the square of the slope along it
    bool faster;
  };
  std::array<Side, 3> sides;
  int count = 0;
  for (int e = 0; e < d_; ++e) {
    const Index a = v + steps[e] * lattice_.stride(e);
    // Where speeds differ, the front of sources side by side bends as one.
    if (!is(a, kFinal) || (nearest_[a] != source && lattice_.has_one_speed())) continue;
    const double h = lattice_.spacing(e), first = distance_[a];
    const Index b = neighbor(a, e, steps[e]);
    const bool has_second = b != kNoIndex && is(b, kFinal) && distance_[b] <= first &&
                            (nearest_[b] == source || !lattice_.has_one_speed());
    Side& side = sides[count++];
    side = {first, 1 / (h * h), first, is(a, kFaster)};
    if (has_second) {
      side.weight *= 2.25;
      side.value = (4 * first - distance_[b]) / 3;
    }
    if (round == nullptr) continue;
    // What the round front would have here, but for the error of its difference.
    GridPlace way = round->way;
    way[e] += steps[e];
    double value = round->slowness * length_of(way);
    if (has_second) {
      way[e] += steps[e];
      value = (4 * value - round->slowness * length_of(way)) / 3;
    }
    const double rise = -steps[e] * round->slope[e] * (has_second ? h / 1.5 : h);
    side.value += round->distance - value - rise;
  }
  const double slowness = 1 / grid_.speed(v);
  // The farthest neighbour is left out until the rest is upwind of the answer.
  std::sort(sides.begin(), sides.begin() + count,
            [](const Side& a, const Side& b) { return a.known < b.known; });
  for (; count > 1; --count) {
    double a = 0, b = 0, c = -slowness * slowness;
    bool faster = false;
    for (int i = 0; i < count; ++i) {
      a += sides[i].weight;
      b += sides[i].weight * sides[i].value;
      c += sides[i].weight * sides[i].value * sides[i].value;
      faster = faster || sides[i].faster;
    }
    const double root = b * b - a * c;
    if (!(root >= 0)) continue;
    const double distance = (b + std::sqrt(root)) / a;
    if (!(distance >= sides[count - 1].known)) continue;
    return distance < most.distance ? Offer{distance, faster} : most;
  }
  return most;
}

/// Of sources side by side, the next one may be nearer than that which a distance came from.
void GridMarch::see_those_of_neighbors(Index v) {
  for_samples_around(lattice_, v, 1, [&](Index w) {
    if (is(w, kFinal) && is(w, kSees) && nearest_[w] != nearest_[v]) see(v, nearest_[w], true);
  });
}

/// Whether v sees a source, so that the straight line is its distance, if it is not less by way of
/// faster samples: the line leaves the cell towards it between corners that see it. Where not all
/// of these do, it is followed if asked for; where none does, v is in a shadow, but for gaps
/// narrower than a cell, and the line is followed a few samples only.
bool GridMarch::see(Index v, Index source, bool follows) {
  constexpr double kSamplesOfGap = 8;
  constexpr double kMostInGap = 1.1;  // of the line, as marched there: at most 1.06 was measured
  if (is(v, kSees) && nearest_[v] == source) return true;
  const GridSource& s = sources_[source];
  const GridPlace at = place_in(lattice_, v);
  const auto [way, main] = way_to(s, at);
  if (std::abs(way[main]) < 1) return false;
  const double line = line_from(s, at);
  if (line > distance_[v] && (nearest_[v] != source || is(v, kFaster))) return false;
  std::array<Index, 3> cell{};  // that the line runs through at v
  GridPlace ahead = at;         // where it leaves that
  bool straight = true;         // along an edge
  for (int e = 0; e < d_; ++e) {
    cell[e] = static_cast<Index>(at[e]) - (way[e] < 0 ? 1 : 0);
    ahead[e] += e == main ? (way[e] < 0 ? -1 : 1) : way[e] / std::abs(way[main]);
    straight = straight && (e == main || way[e] == 0);
  }
  if (straight) {
    const bool is_same = is_same_slowness(1 / grid_.speed(v), s.slowness);
    if (!is_same || neighbor(v, main, way[main] < 0 ? -1 : 1) == kNoIndex) return false;
  } else if (!lattice_.passes(cell, way, s.slowness)) {
    return false;
  }
  const Corners corners = corners_at(ahead, main, source, follows);
  if (corners != Corners::kAllSee && !follows) return false;
  const bool none = corners == Corners::kNoneSees;
  if (none && distance_[v] > kMostInGap * line) return false;
  const double samples = none ? kSamplesOfGap : kUnreached;
  if (corners != Corners::kAllSee && !is_in_sight(at, way, main, source, samples)) return false;
  set(v, line, source);  // also upwards: a slope may be too flat
  state_[v] |= kSees;
  return true;
}

/// Which corners see the source, of the side across `main` that a line crosses here.
GridMarch::Corners GridMarch::corners_at(const GridPlace& at, int main, Index source,
                                         bool wants_some) const {
  constexpr double kRoundOff = 1e-9;
  std::array<Index, 4> corners{};
  std::size_t count = 1;
  for (int e = 0; e < d_; ++e) {
    const auto low = static_cast<Index>(at[e] + (e == main ? 0.5 : kRoundOff));
    for (std::size_t k = 0; k < count; ++k) corners[k] += low * lattice_.stride(e);
    if (e == main || !(at[e] - low > kRoundOff)) continue;
    for (std::size_t k = 0; k < count; ++k) corners[count + k] = corners[k] + lattice_.stride(e);
    count *= 2;
  }
  std::size_t seeing = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const Index c = corners[k];
    if (is(c, kSees) && is(c, kFinal) && nearest_[c] == source) {
      ++seeing;
    } else if (!wants_some) {
      break;
    }
  }
  if (seeing == count) return Corners::kAllSee;
  return seeing > 0 ? Corners::kSomeSee : Corners::kNoneSees;
}

/// Whether the line to the source runs through cells of its speed alone, as far as to where it
/// leaves one between corners that see it. False, too, where this is not known after so many
/// samples.
bool GridMarch::is_in_sight(const GridPlace& at, const GridPlace& way, int main, Index source,
                            double samples) const {
  constexpr double kRoundOff = 1e-9;
  const double length = std::abs(way[main]);
  GridPlace before = at;
  for (double i = 1;; ++i) {
    const double share = std::min(1.0, i / length);
    GridPlace behind = at;
    std::array<double, 4> cuts{};  // of the way from `before` to `behind`: where it enters cells
    std::size_t count = 1;
    for (int e = 0; e < d_; ++e) {
      behind[e] += share * way[e];
      if (e == main) continue;
      const double line = std::ceil(std::min(before[e], behind[e]) + kRoundOff);
      if (line < std::max(before[e], behind[e]) - kRoundOff) {
        cuts[count++] = (line - before[e]) / (behind[e] - before[e]);
      }
    }
    cuts[count++] = 1;
    std::sort(cuts.begin(), cuts.begin() + static_cast<std::ptrdiff_t>(count));
    for (std::size_t k = 0; k + 1 < count; ++k) {
      if (!(cuts[k + 1] - cuts[k] > kRoundOff)) continue;
      std::array<Index, 3> cell{};
      for (int e = 0; e < d_; ++e) {
        const double middle = before[e] + (cuts[k] + cuts[k + 1]) / 2 * (behind[e] - before[e]);
        cell[e] = static_cast<Index>(std::floor(middle));
      }
      if (!lattice_.passes(cell, way, sources_[source].slowness)) return false;
    }
    if (i >= length) return true;
    if (corners_at(behind, main, source, false) == Corners::kAllSee) return true;
    if (i >= samples) return false;
    before = behind;
  }
}

}  // namespace geotherm
