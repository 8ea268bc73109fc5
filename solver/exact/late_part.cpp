// SPDX-License-Identifier: MIT
#include "solver/exact/late_part.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "solver/exact/trim_window.h"

namespace geotherm {
namespace {

/// Windows at edges with many faces grow narrower without end where they run round a vertex; what
/// is in no order on them is a share of their own width then.
constexpr double kShareOfWindow = 1e-3;

/// Places where two windows may change order; more than there are do no harm.
struct Places {
  std::array<double, 2> at{};
  int count = 0;
  void add(double place) {
    if (std::isfinite(place)) at[static_cast<std::size_t>(count++)] = place;
  }
  /// The roots of a u^2 + 2 b u + c, moved.
  void add_roots(double a, double b, double c, double moved) {
    const double q = -(b + std::copysign(std::sqrt(std::max(b * b - a * c, 0.0)), b));
    add(moved + q / a);
    add(moved + c / q);
  }
};

Places ties(const Window& p, const Window& q) {
  Places places;
  if (p.is_plane() && q.is_plane()) {
    places.add((q.sigma - p.sigma) / (p.x - q.x));
  } else if (p.is_plane() || q.is_plane()) {
    const Window& plane = p.is_plane() ? p : q;
    const Window& point = p.is_plane() ? q : p;
    // sqrt(u^2 + y^2) = a + n u
    const double a = plane.sigma + plane.x * point.x - point.sigma, n = plane.x;
    places.add_roots(1 - n * n, -a * n, point.y * point.y - a * a, point.x);
  } else {
    // sqrt((u - d)^2 + q.y^2) = sqrt(u^2 + p.y^2) + c
    const double d = q.x - p.x, c = p.sigma - q.sigma;
    const double e = d * d + (q.y - p.y) * (q.y + p.y) - c * c;
    places.add_roots(4 * (d - c) * (d + c), -2 * e * d, e * e - 4 * c * c * p.y * p.y, p.x);
  }
  return places;
}

}  // namespace

bool cut_late_ends(Window& w, const Window& other, double length) {
  const double begin = std::max(w.begin, other.begin), end = std::min(w.end, other.end);
  const double margin = std::min(kOrder * length, kShareOfWindow * (w.end - w.begin));
  if (end - begin <= margin) return true;
  // Between these the order does not change.
  std::array<double, 4> stop = {begin};
  std::size_t last = 0;
  Places places = ties(w, other);
  if (places.count == 2 && places.at[0] > places.at[1]) std::swap(places.at[0], places.at[1]);
  for (int i = 0; i < places.count; ++i) {
    const double place = places.at[static_cast<std::size_t>(i)];
    if (place > stop[last] && place < end) stop[++last] = place;
  }
  stop[++last] = end;
  const auto late = [&](std::size_t piece) {
    const double middle = (stop[piece] + stop[piece + 1]) / 2;
    return w.distance_at(middle) >= other.distance_at(middle) * (1 - kTie);
  };
  std::size_t first = 0;
  while (first < last && late(first)) ++first;
  if (w.begin >= begin - margin) {
    if (first == last && w.end <= end + margin) return false;
    if (first > 0) w.begin = std::max(w.begin, first == last ? end : stop[first] - margin);
  }
  std::size_t rest = last;
  while (rest > first && late(rest - 1)) --rest;
  if (w.end <= end + margin && rest < last) w.end = std::min(w.end, stop[rest] + margin);
  if (first == last && w.end <= end + margin) w.end = std::min(w.end, begin);
  return w.end - w.begin > margin;
}

}  // namespace geotherm
