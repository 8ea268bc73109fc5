// SPDX-License-Identifier: MIT
#include "solver/path/shorten_loop.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace geotherm {
namespace {

/// A loop shorter than this, in units of the surface (about half its size), is a point.
constexpr double kPoint = 1e-12;

/// Leaves out detours where the row of faces closes.
void cancel_round(const PathSurface& surface, std::vector<Index>& faces) {
  cancel_detours(surface, faces);
  while (faces.size() > 1) {
    const std::size_t n = faces.size();
    if (faces.front() == faces.back()) {
      faces.pop_back();
    } else if (n > 2 && surface.shared_edge(faces[n - 1], faces[0]) ==
                            surface.shared_edge(faces[0], faces[1])) {
      faces.erase(faces.begin());
    } else if (n > 2 && surface.shared_edge(faces[n - 2], faces[n - 1]) ==
                            surface.shared_edge(faces[n - 1], faces[0])) {
      faces.pop_back();
    } else {
      return;
    }
  }
}

/// The shortest loops in a closed row of faces that pass one of its gates at a given place.
class CutLoop {
 public:
  /// The gate is the edge between the last face and the first.
  CutLoop(const PathSurface& surface, std::vector<Index> faces)
      : surface_(surface), faces_(std::move(faces)) {
    const Index edge = surface.shared_edge(faces_.back(), faces_.front());
    low_ = surface.edges().low(edge);
    high_ = surface.edges().high(edge);
  }

  std::vector<Leg> legs_at(double share) const {
    return pull_tight(surface_, place(share, faces_.front()), place(share, faces_.back()), faces_);
  }

  /// How the length changes with the place, which never falls: the length is convex.
  double slope(double share) const {
    const std::vector<Leg> legs = legs_at(share);
    if (legs.empty()) return 0;
    const Vec3 along = surface_.position(high_) - surface_.position(low_);
    return (arrival(legs.back()) - departure(legs.front())).dot(along);
  }

  /// The shortest of these loops, cut where it passes the gate.
  std::vector<Leg> shortest() const {
    double low = 0, high = 1;
    constexpr int kHalvings = 60;
    for (int i = 0; i < kHalvings && low < high; ++i) {
      const double middle = low + (high - low) / 2;
      if (middle == low || middle == high) break;
      (slope(middle) > 0 ? high : low) = middle;
    }
    std::vector<Leg> best = legs_at(low);
    for (const double end : {0.0, 1.0}) {  // at a vertex, it can go on with other gates
      constexpr double kNear = 1e-9;
      if (std::abs(low - end) > kNear) continue;
      std::vector<Leg> legs = legs_at(end);
      if (length_of(legs) <= length_of(best) * (1 + kNear * kNear)) best = std::move(legs);
    }
    return best;
  }

 private:
  SurfacePoint place(double share, Index face) const {
    if (share <= 0) return SurfacePoint::at_vertex(low_);
    if (share >= 1) return SurfacePoint::at_vertex(high_);
    SurfacePoint point = SurfacePoint::in_face(face, {});
    point.weights[static_cast<std::size_t>(surface_.corner_of_vertex(face, low_))] = 1 - share;
    point.weights[static_cast<std::size_t>(surface_.corner_of_vertex(face, high_))] = share;
    return point;
  }

  Vec3 departure(const Leg& leg) const {
    const std::vector<SurfacePoint> points = points_of(leg);
    return (surface_.position(points[1]) - surface_.position(points[0])).normalized();
  }
  Vec3 arrival(const Leg& leg) const {
    const std::vector<SurfacePoint> points = points_of(leg);
    const std::size_t n = points.size();
    return (surface_.position(points[n - 1]) - surface_.position(points[n - 2])).normalized();
  }
  std::vector<SurfacePoint> points_of(const Leg& leg) const {
    std::vector<SurfacePoint> points = {leg.from};
    std::vector<Index> faces;
    append_points(surface_, leg, points, faces);
    return points;
  }

  const PathSurface& surface_;
  std::vector<Index> faces_;
  Index low_ = kNoIndex, high_ = kNoIndex;
};

std::vector<Index> strip_of(const std::vector<Leg>& legs) {
  std::vector<Index> faces;
  for (const Leg& leg : legs) faces.insert(faces.end(), leg.faces.begin(), leg.faces.end());
  return faces;
}

/// The shortest loop in a closed row of faces; none where it can shrink to a point.
std::vector<Leg> shortest_in(const PathSurface& surface, std::vector<Index> faces) {
  cancel_round(surface, faces);
  if (faces.size() < 3) return {};
  std::vector<Leg> legs = CutLoop(surface, std::move(faces)).shortest();
  if (!(length_of(legs) > kPoint)) legs.clear();
  return legs;
}

/// Cuts the loop open at another of its vertices. Where it was cut inside an edge or a face, the
/// two legs that met there become one strip.
void cut_at_first_vertex(const PathSurface& surface, std::vector<Leg>& legs) {
  const bool at_vertex = legs.front().from.is_vertex();
  std::rotate(legs.begin(), legs.begin() + 1, legs.end());
  if (at_vertex) return;
  Leg first = std::move(legs[legs.size() - 2]), second = std::move(legs.back());
  legs.resize(legs.size() - 2);
  std::vector<Index> strip = std::move(first.faces);
  strip.insert(strip.end(), second.faces.begin(), second.faces.end());
  for (Leg& leg : pull_tight(surface, first.from, second.to, std::move(strip))) {
    legs.push_back(std::move(leg));
  }
}

bool is_bend_at_cut(const std::vector<Leg>& legs) { return legs.front().from.is_vertex(); }

}  // namespace

Result<void> shorten_loop(const PathSurface& surface, std::vector<Leg>& legs,
                          ShortenBudget& budget) {
  while (!legs.empty()) {
    if (auto spent = budget.spend(); !spent) return spent;
    const double before = length_of(legs);
    if (!(before > kPoint)) {
      legs.clear();
      return {};
    }
    std::vector<Leg> next = legs;
    if (legs.size() > 1) {
      cut_at_first_vertex(surface, next);
    } else if (is_bend_at_cut(legs)) {
      auto strip = strip_past(surface, legs.front(), legs.front());
      if (!strip) return {};
      // The loop's own strip, closed by the way past the vertex.
      strip->resize(strip->size() - legs.front().faces.size());
      next = shortest_in(surface, *std::move(strip));
    } else {
      next = shortest_in(surface, strip_of(legs));
    }
    if (auto released = release_bends(surface, next, budget); !released) return released;
    const bool shorter = is_shorter(length_of(next), before);
    if (!shorter && !(legs.size() > 1)) return {};
    legs = std::move(next);
    if (!shorter) return {};
  }
  return {};
}

}  // namespace geotherm
