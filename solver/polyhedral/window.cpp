// SPDX-License-Identifier: MIT
#include "solver/polyhedral/window.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace geotherm {
namespace {

/// Windows narrower than this, relative to the side, are round-off and covered by their neighbours.
constexpr double kNarrowWindow = 1e-14;

/// Where on the side the window's distance is that from the origin. The difference of the two
/// falls, so that there is one root.
double tie_with_origin(const Window& w, double at_origin) {
  if (w.is_plane()) return (w.sigma - at_origin) / (1 - w.x);
  const double c = at_origin - w.sigma, h = std::sqrt(w.x * w.x + w.y * w.y);
  return (h - c) * (h + c) / (2 * (w.x + c));
}

/// Whether a point below the side lies between the lines of the window.
bool lies_inside(const Window& w, double x, double y) {
  const auto turn = [&](double at) { return w.ray_x(at) * y - w.ray_y() * (x - at); };
  return turn(w.begin) < 0 && turn(w.end) > 0;
}

/// Windows at edges with many faces get narrower without end where they run round a vertex; the
/// tolerance is therefore also a share of their own width.
constexpr double kShareOfWindow = 1e-3;

/// Places where the order of two windows may change; superfluous ones do no harm.
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

bool have_same_source(const Window& a, const Window& b) {
  const double tie = kTie * (std::abs(a.x) + std::abs(a.y));
  return a.is_plane() == b.is_plane() && std::abs(a.x - b.x) <= tie && std::abs(a.y - b.y) <= tie &&
         std::abs(a.sigma - b.sigma) <= kTie * std::abs(a.sigma);
}

bool trim_by_ends(Window& w, double length, double at_origin, double at_length) {
  const double begin = w.distance_at(w.begin) * (1 - kTie);
  const double end = w.distance_at(w.end) * (1 - kTie);
  if (at_origin + w.end < end || at_length + (length - w.begin) < begin) return false;
  const double margin = kOrder * length;
  if (at_origin + w.begin < begin) {
    const double root = tie_with_origin(w, at_origin) - margin;
    if (root > w.begin) w.begin = std::min(root, w.end);
  }
  if (at_length + (length - w.end) < end) {
    Window mirrored = w;
    mirrored.reverse(length);
    const double root = length - tie_with_origin(mirrored, at_length) + margin;
    if (root < w.end) w.end = std::max(root, w.begin);
  }
  return w.end - w.begin > kNarrowWindow * length;
}

bool yield_to_leader(Window& w, double length, double apex_x, double apex_y, Leader& leader,
                     Passage& passage) {
  const double straight = w.distance_to(apex_x, apex_y);
  const double margin = kOrder * length;
  if (!passage.left || !passage.right) {
    // No way through the window to the corner is shorter than `straight`: where its lines cross the
    // leader's, they are late.
    if (straight < leader.distance) return true;
    if (passage.left) w.end = std::min(w.end, leader.crossing + margin);
    if (passage.right) w.begin = std::max(w.begin, leader.crossing - margin);
    return w.end > w.begin;
  }
  const double crossing =
      w.is_plane() ? apex_x - apex_y * w.x / w.y : w.x + (apex_x - w.x) * w.y / (w.y - apex_y);
  if (straight < leader.distance) {
    leader = {straight, crossing, w};
    return true;
  }
  const Window& first = leader.window;
  if (have_same_source(first, w) && w.begin >= first.begin - margin &&
      w.end <= first.end + margin) {
    return false;
  }
  // The strips of two windows part at a vertex, so that of two lines which meet at the corner the
  // one further left at the side was so ever since: all lines on the leader's other side have
  // crossed its line. Not so where the strips part at an edge with three faces, or about a source
  // that has lines of the window on either side.
  if (first.is(Window::kBranched) && w.is(Window::kBranched)) return true;
  if ((first.is(Window::kFromFace) || w.is(Window::kMerged)) && lies_inside(w, first.x, first.y)) {
    return true;
  }
  if (crossing < leader.crossing - margin) passage.right = false;
  if (crossing > leader.crossing + margin) passage.left = false;
  return true;
}

bool trim_dominated_ends(Window& w, const Window& other, double length) {
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
