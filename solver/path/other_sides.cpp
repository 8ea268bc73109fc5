// SPDX-License-Identifier: MIT
#include "solver/path/other_sides.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "solver/path/unfolded_strip.h"

namespace geotherm {
namespace {

/// Ways on the other side that are estimated longer by more than this share are not tried: the
/// estimate sees one vertex, and those behind it may make up for so much.
constexpr double kWorthTrying = 0.01;

/// A vertex beside a leg, with the part of the strip on which it is.
struct Passed {
  Index vertex;
  int first_gate, last_gate;
  std::vector<Index> across;  ///< the other ends of the gates that it is a post of
  double estimate;            ///< length of the leg on its other side
};

double total_angle(const PathSurface& surface, Index vertex) {
  double sum = 0;
  for (const Index corner : surface.corners_at(vertex)) {
    sum += surface.corner_angle(corner / 3, corner % 3);
  }
  return sum;
}

double length_across(double a, double b, double angle) {
  return std::sqrt(std::max(0.0, a * a + b * b - 2 * a * b * std::cos(angle)));
}

/// The vertices that are worth passing on the other side, the most promising first.
std::vector<Passed> passed_by(const PathSurface& surface, const Leg& leg) {
  const UnfoldedStrip strip = unfold(surface, leg.from, leg.to, leg.faces);
  const Vec2& a = strip.points[static_cast<std::size_t>(strip.start())];
  const Vec2& b = strip.points[static_cast<std::size_t>(strip.end())];
  std::vector<Passed> out;
  for (std::size_t i = 0; i < strip.corners.size(); ++i) {
    const UnfoldedStrip::Corner& corner = strip.corners[i];
    if (corner.last_gate < corner.first_gate) continue;
    const Vec2 to_a = a - strip.points[i], to_b = b - strip.points[i];
    const double angle =
        std::atan2(std::abs(to_a.x() * to_b.y() - to_a.y() * to_b.x()), to_a.dot(to_b));
    const double other = total_angle(surface, corner.vertex) - angle;
    if (!(other < std::numbers::pi)) continue;
    const double estimate = length_across(to_a.norm(), to_b.norm(), other);
    if (!(estimate < leg.length * (1 + kWorthTrying))) continue;
    Passed passed{corner.vertex, corner.first_gate, corner.last_gate, {}, estimate};
    for (int k = corner.first_gate; k <= corner.last_gate; ++k) {
      const auto [left, right] = strip.gates[static_cast<std::size_t>(k)];
      const int across = left == static_cast<int>(i) ? right : left;
      passed.across.push_back(strip.corners[static_cast<std::size_t>(across)].vertex);
    }
    out.push_back(std::move(passed));
  }
  std::ranges::stable_sort(out, {}, &Passed::estimate);
  return out;
}

/// The legs of the way on the other side of the vertex; none where there is none.
std::vector<Leg> other_way(const PathSurface& surface, const Leg& leg, const Passed& passed) {
  const auto begin = leg.faces.begin();
  const SurfacePoint vertex = SurfacePoint::at_vertex(passed.vertex);
  const std::vector<Leg> in =
      pull_tight(surface, leg.from, vertex, {begin, begin + passed.first_gate + 1});
  const std::vector<Leg> out =
      pull_tight(surface, vertex, leg.to, {begin + passed.last_gate + 1, leg.faces.end()});
  if (in.empty() || out.empty()) return {};
  auto past = strip_past(surface, in.back(), out.front(), passed.across);
  if (!past) return {};
  std::vector<Leg> way(in.begin(), in.end() - 1);
  for (Leg& past_leg : pull_tight(surface, in.back().from, out.front().to, *std::move(past))) {
    way.push_back(std::move(past_leg));
  }
  way.insert(way.end(), out.begin() + 1, out.end());
  return way;
}

/// Replaces leg i by a shorter way on the other side of a vertex; false where none is found.
Result<bool> improve(const PathSurface& surface, std::vector<Leg>& legs, std::size_t i,
                     ShortenBudget& budget) {
  for (const Passed& passed : passed_by(surface, legs[i])) {
    std::vector<Leg> way = other_way(surface, legs[i], passed);
    if (way.empty()) continue;
    if (auto released = release_bends(surface, way, budget); !released) return released.error();
    if (!is_shorter(length_of(way), legs[i].length)) continue;
    const auto at = legs.erase(legs.begin() + static_cast<std::ptrdiff_t>(i));
    legs.insert(at, std::make_move_iterator(way.begin()), std::make_move_iterator(way.end()));
    return true;
  }
  return false;
}

}  // namespace

Result<void> try_other_sides(const PathSurface& surface, std::vector<Leg>& legs,
                             ShortenBudget& budget) {
  std::size_t i = 0;
  while (i < legs.size()) {
    const auto improved = improve(surface, legs, i, budget);
    if (!improved) return improved.error();
    if (!*improved) {
      ++i;
      continue;
    }
    if (auto released = release_bends(surface, legs, budget); !released) return released;
    i = 0;
  }
  return {};
}

}  // namespace geotherm
