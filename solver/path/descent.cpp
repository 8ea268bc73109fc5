// SPDX-License-Identifier: MIT
#include "solver/path/descent.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace geotherm {
namespace {

/// Least height of a face, as a share of its longest side, that has a gradient.
constexpr double kFlat = 1e-14;

/// The steepest way down around one point.
class Choice {
 public:
  Choice(const PathSurface& surface, const DescentField& field, std::span<const Index> faces)
      : surface_(surface), field_(field) {
    if (!field.log_heat) return;
    log_largest_ = -std::numeric_limits<double>::infinity();
    for (const Index f : faces) {
      for (const Index v : surface.face(f)) log_largest_ = std::max(log_largest_, field.values[v]);
    }
    if (!std::isfinite(log_largest_)) log_largest_ = 0;
  }

  /// Down across the face, if its fall leads into it: no weight that is 0 may become less.
  void offer_face(Index f, const std::array<double, 3>& weights) {
    const Descent fall = fall_of(f);
    if (!(fall.slope > 0 && fall.slope >= best.slope)) return;
    for (std::size_t k = 0; k < 3; ++k) {
      if (weights[k] == 0 && fall.rates[k] < 0) return;
    }
    best = fall;
  }

  /// Down the edge, which `face` has, to a vertex that is lower than the other.
  void offer_edge(Index from, Index to, Index face) {
    if (!is_lower(to, from)) return;
    const double length = (surface_.position(to) - surface_.position(from)).norm();
    const double slope =
        length > 0 ? (height(from) - height(to)) / length : std::numeric_limits<double>::max();
    // A difference that underflows still leads down.
    offer_vertex(to, face, std::max(slope, std::numeric_limits<double>::min()));
  }

  /// Where a face has no fall, any way to a lower corner is as good.
  void offer_lowest_corner(Index f) {
    const Face& face = surface_.face(f);
    Index lowest = face[0], highest = face[0];
    for (const Index v : face) {
      if (is_lower(v, lowest)) lowest = v;
      if (is_lower(highest, v)) highest = v;
    }
    if (is_lower(lowest, highest)) offer_vertex(lowest, f, std::numeric_limits<double>::min());
  }

  Descent best;

 private:
  void offer_vertex(Index vertex, Index face, double slope) {
    if (slope > best.slope) best = {slope, face, vertex, {}};
  }

  /// Of -u, over the largest u about, or as given, in units of the surface.
  double height(Index v) const {
    return field_.log_heat ? -std::exp(field_.values[v] - log_largest_)
                           : field_.values[v] / surface_.unit();
  }
  bool is_lower(Index a, Index b) const {
    return field_.log_heat ? field_.values[a] > field_.values[b]
                           : field_.values[a] < field_.values[b];
  }

  Descent fall_of(Index f) const {
    const Face& face = surface_.face(f);
    const std::array<Vec3, 3> side = {surface_.position(face[2]) - surface_.position(face[1]),
                                      surface_.position(face[0]) - surface_.position(face[2]),
                                      surface_.position(face[1]) - surface_.position(face[0])};
    const double area2 = side[0].cross(side[1]).norm();
    const double longest = std::max({side[0].norm(), side[1].norm(), side[2].norm()});
    if (!(area2 > kFlat * longest * longest)) return {};
    // The gradient, turned by a right angle, times twice the area. Sides add up to 0, so that any
    // height may be taken for 0.
    const Vec3 turned = (height(face[1]) - height(face[0])) * side[1] +
                        (height(face[2]) - height(face[0])) * side[2];
    const double steepness = turned.norm();
    if (!(steepness > 0) || !std::isfinite(steepness / area2)) return {};
    Descent fall{steepness / area2, f, kNoIndex, {}};
    for (std::size_t k = 0; k < 3; ++k) fall.rates[k] = -side[k].dot(turned / steepness);
    return fall;
  }

  const PathSurface& surface_;
  const DescentField& field_;
  double log_largest_ = 0;
};

std::array<double, 3> one_at(int corner) {
  std::array<double, 3> weights{};
  weights[static_cast<std::size_t>(corner)] = 1;
  return weights;
}

}  // namespace

Descent steepest_descent(const PathSurface& surface, const DescentField& field,
                         const SurfacePoint& point) {
  const std::vector<Index> faces = surface.faces_at(point);
  Choice choice(surface, field, faces);
  if (point.is_vertex()) {
    for (const Index f : faces) {
      const int k = surface.corner_of_vertex(f, point.vertex);
      choice.offer_face(f, one_at(k));
      choice.offer_edge(point.vertex, surface.face(f)[next_corner(k)], f);
      choice.offer_edge(point.vertex, surface.face(f)[previous_corner(k)], f);
    }
    return choice.best;
  }
  for (const Index f : faces) choice.offer_face(f, surface.express(point, f)->weights);
  for (int k = 0; k < 3; ++k) {
    if (point.weights[static_cast<std::size_t>(k)] != 0) continue;
    const Index a = surface.face(point.face)[next_corner(k)];
    const Index b = surface.face(point.face)[previous_corner(k)];
    choice.offer_edge(a, b, point.face);
    choice.offer_edge(b, a, point.face);
  }
  if (!(choice.best.slope > 0)) choice.offer_lowest_corner(point.face);
  return choice.best;
}

}  // namespace geotherm
