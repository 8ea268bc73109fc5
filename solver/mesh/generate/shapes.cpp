// SPDX-License-Identifier: MIT
#include "solver/mesh/generate/shapes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace geotherm::generate {
namespace {

using Vec2 = Eigen::Vector2d;

/// Distance to a closed polygon in its plane, negative inside (even-odd rule).
double distance_to_outline(const std::vector<Vec2>& outline, const Vec2& p) {
  double nearest = std::numeric_limits<double>::infinity();
  bool inside = false;
  for (std::size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++) {
    const Vec2 edge = outline[j] - outline[i];
    const Vec2 to = p - outline[i];
    const double t = std::clamp(to.dot(edge) / edge.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (to - t * edge).squaredNorm());
    const bool above = outline[i].y() > p.y();
    if (above != (outline[j].y() > p.y()) &&
        (edge.y() > 0) == (edge.x() * to.y() < edge.y() * to.x())) {
      inside = !inside;
    }
  }
  return inside ? -std::sqrt(nearest) : std::sqrt(nearest);
}

double smooth_min(double a, double b, double reach) {
  const double h = std::max(reach - std::abs(a - b), 0.0);
  return std::min(a, b) - h * h / (4 * reach);
}

}  // namespace

double distance_to(const Ellipsoid& shape, const Vec3& p) {
  const Vec3 q = shape.axes * (p - shape.center);
  const Vec3 scaled = q.cwiseQuotient(shape.radii);
  const double k0 = scaled.norm();
  const double k1 = scaled.cwiseQuotient(shape.radii).norm();
  if (k1 < 1e-12) return -shape.radii.minCoeff();
  return k0 * (k0 - 1) / k1;
}

double distance_to(const Tube& shape, const Vec3& p) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < shape.points.size(); ++i) {
    const Vec3 along = shape.points[i + 1] - shape.points[i];
    const Vec3 to = p - shape.points[i];
    const double t = std::clamp(to.dot(along) / along.squaredNorm(), 0.0, 1.0);
    const double radius = shape.radii[i] + t * (shape.radii[i + 1] - shape.radii[i]);
    const double squared = (to - t * along).squaredNorm();
    const double limit = nearest + radius;  // negative deep inside another piece
    if (limit > 0 && squared < limit * limit) nearest = std::sqrt(squared) - radius;
  }
  return nearest;
}

double distance_to(const RoundBox& shape, const Vec3& p) {
  const Vec3 q = (p - shape.center).cwiseAbs() - (shape.half.array() - shape.radius).matrix();
  return q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0) - shape.radius;
}

double distance_to(const Sheet& shape, const Vec3& p) {
  const Vec3 q = shape.axes * (p - shape.origin);
  const Vec2 uv(q.x(), q.y());
  const double bent = q.z() - shape.bow * uv.x() * uv.x() - shape.lean * uv.y() * uv.y();
  double rods = std::numeric_limits<double>::infinity();
  double gap = rods;  // in the plane, to the nearest rod's axis
  for (const Sheet::Rod& rod : shape.rods) {
    const Vec2 along = rod.to - rod.from;
    const double t = std::clamp((uv - rod.from).dot(along) / along.squaredNorm(), 0.0, 1.0);
    const double flat = (uv - rod.from - t * along).norm();
    const double radius = rod.from_radius + t * (rod.to_radius - rod.from_radius);
    rods = std::min(rods, std::sqrt(flat * flat + bent * bent) - radius);
    gap = std::min(gap, flat);
  }
  const double rise = std::min(gap / 0.25, 1.0);
  const double off = std::abs(bent - shape.billow * rise * rise * (3 - 2 * rise));
  const double rim = std::max(distance_to_outline(shape.outline, uv) + shape.half, 0.0);
  const double membrane = (rim > 0 ? std::sqrt(rim * rim + off * off) : off) - shape.half;
  return 0.85 * smooth_min(membrane, rods, 0.05);
}

double distance_to(const Shape& shape, const Vec3& p) {
  return std::visit([&](const auto& solid) { return distance_to(solid, p); }, shape);
}

Shape mirrored(const Shape& shape) {
  const auto flip = [](const Vec3& p) { return Vec3(-p.x(), p.y(), p.z()); };
  Shape copy = shape;
  if (auto* ellipsoid = std::get_if<Ellipsoid>(&copy)) {
    ellipsoid->center = flip(ellipsoid->center);
    ellipsoid->axes.col(0) *= -1;
  } else if (auto* swept = std::get_if<Tube>(&copy)) {
    for (Vec3& p : swept->points) p = flip(p);
  } else if (auto* box = std::get_if<RoundBox>(&copy)) {
    box->center = flip(box->center);
  } else if (auto* sheet = std::get_if<Sheet>(&copy)) {
    sheet->origin = flip(sheet->origin);
    sheet->axes.col(0) *= -1;
  }
  return copy;
}

Tube tube(const std::vector<Knot>& knots, int steps) {
  Tube swept;
  const auto at = [&](std::ptrdiff_t i) -> const Knot& {
    return knots[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(i, 0, std::ssize(knots) - 1))];
  };
  const auto blend = [](const auto& a, const auto& b, const auto& c, const auto& d, double t) {
    using T = std::decay_t<decltype(a)>;
    return T(0.5 * (2 * b + t * ((c - a) +
                                 t * ((2 * a - 5 * b + 4 * c - d) + t * (3 * b - a - 3 * c + d)))));
  };
  for (std::ptrdiff_t i = 0; i + 1 < std::ssize(knots); ++i) {
    for (int s = 0; s < steps; ++s) {
      const double t = static_cast<double>(s) / steps;
      swept.points.push_back(
          blend(at(i - 1).point, at(i).point, at(i + 1).point, at(i + 2).point, t));
      swept.radii.push_back(
          blend(at(i - 1).radius, at(i).radius, at(i + 1).radius, at(i + 2).radius, t));
    }
  }
  swept.points.push_back(knots.back().point);
  swept.radii.push_back(knots.back().radius);
  return swept;
}

Eigen::Matrix3d frame(const Vec3& main, const Vec3& second) {
  Eigen::Matrix3d axes;
  axes.row(0) = main.normalized();
  axes.row(2) = main.cross(second).normalized();
  axes.row(1) = axes.row(2).cross(axes.row(0));
  return axes;
}

}  // namespace geotherm::generate
