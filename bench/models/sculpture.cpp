// SPDX-License-Identifier: MIT
#include "bench/models/sculpture.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

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

constexpr double kFar = 1e9;
// In units of the spacing: the smallest radius of a part that the grid shows in one piece.
constexpr double kThinnest = 0.8;
// In units of the spacing: the smallest reach of parts that are not small themselves, so that
// gaps that the grid cannot show are filled.
constexpr double kSmoothest = 1.5;
// In units of the spacing: the smallest size of a part that is worth thickening.
constexpr double kTiniest = 0.35;
// A tube of more pieces is cut, so that each place needs to look at a few of them only.
constexpr std::size_t kLongest = 3;

/// The radius that decides how much a shape shows: of a tube the widest, of a ball the middle one.
double size_of(const Shape& shape) {
  if (const auto* ellipsoid = std::get_if<Ellipsoid>(&shape)) {
    const Vec3& r = ellipsoid->radii;
    return r.sum() - r.minCoeff() - r.maxCoeff();
  }
  if (const auto* swept = std::get_if<Tube>(&shape)) {
    return *std::max_element(swept->radii.begin(), swept->radii.end());
  }
  if (const auto* box = std::get_if<RoundBox>(&shape)) return box->half.minCoeff();
  return std::get<Sheet>(shape).half;
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

double Sculpture::thick(double radius) const { return std::max(radius, kThinnest * spacing_); }

void Sculpture::add(Shape shape, double reach) {
  const bool is_sheet = std::holds_alternative<Sheet>(shape);
  if (!is_sheet && size_of(shape) < kTiniest * spacing_) return;
  if (auto* ellipsoid = std::get_if<Ellipsoid>(&shape)) {
    ellipsoid->radii = ellipsoid->radii.cwiseMax(kThinnest * spacing_);
  } else if (auto* swept = std::get_if<Tube>(&shape)) {
    for (double& radius : swept->radii) radius = thick(radius);
  } else if (auto* sheet = std::get_if<Sheet>(&shape)) {
    sheet->half = thick(sheet->half);
  }
  append(std::move(shape), reach, false);
}

void Sculpture::carve(Shape shape, double reach) { append(std::move(shape), reach, true); }

void Sculpture::append(Shape shape, double asked, bool carved) {
  const double reach = std::max(asked, std::min(kSmoothest * spacing_, 0.5 * size_of(shape)));
  const int group = groups_++;
  const auto* swept = std::get_if<Tube>(&shape);
  if (!swept) {
    parts_.push_back({std::move(shape), reach, carved, group});
    return;
  }
  const std::size_t last = swept->points.size() - 1;
  for (std::size_t from = 0; from < last; from += kLongest) {
    const auto cut = [&](const auto& all) {
      return std::decay_t<decltype(all)>(
          all.begin() + static_cast<std::ptrdiff_t>(from),
          all.begin() + static_cast<std::ptrdiff_t>(std::min(from + kLongest, last) + 1));
    };
    parts_.push_back({Tube{cut(swept->points), cut(swept->radii)}, reach, carved, group});
  }
}

void Sculpture::add_pair(const Shape& shape, double reach) {
  add(shape, reach);
  add(mirrored(shape), reach);
}

void Sculpture::carve_pair(const Shape& shape, double reach) {
  carve(shape, reach);
  carve(mirrored(shape), reach);
}

void Sculpture::set_detail(Detail detail, double height) {
  detail_ = std::move(detail);
  detail_height_ = height;
}

std::vector<int> Sculpture::all_parts() const {
  std::vector<int> parts(parts_.size());
  std::iota(parts.begin(), parts.end(), 0);
  return parts;
}

double Sculpture::blend(double d, double own, const Part& part) {
  return part.carved ? -smooth_min(-d, own, part.reach) : smooth_min(d, own, part.reach);
}

double Sculpture::distance(const Vec3& p, Parts parts) const {
  double d = kFar;
  const Part* part = nullptr;
  double own = kFar;
  for (const int i : parts) {
    const Part& next = parts_[static_cast<std::size_t>(i)];
    if (part && part->group != next.group) {
      d = blend(d, own, *part);
      own = kFar;
    }
    part = &next;
    own = std::min(own, distance_to(next.shape, p));
  }
  if (part) d = blend(d, own, *part);
  if (detail_ && std::abs(d) < 1.5 * spacing_ + detail_height_) d -= detail_(p);
  return d;
}

std::vector<int> Sculpture::cull(const Vec3& center, double radius, Parts parts,
                                 double& distance_there) const {
  const double r = kSteepest * radius;
  struct Candidate {
    int part;
    double added;
  };
  std::vector<Candidate> near;
  double d = kFar;
  for (std::size_t k = 0; k < parts.size();) {
    const Part& part = parts_[static_cast<std::size_t>(parts[k])];
    const std::size_t earlier = near.size();
    double own = kFar;
    for (; k < parts.size(); ++k) {
      const Part& piece = parts_[static_cast<std::size_t>(parts[k])];
      if (piece.group != part.group) break;
      const double piece_own = distance_to(piece.shape, center);
      own = std::min(own, piece_own);
      const bool idle =
          part.carved ? -piece_own + r < d - r - part.reach : piece_own - r > d + r + part.reach;
      if (!idle) near.push_back({parts[k], part.carved ? -kFar : piece_own});
    }
    if (!part.carved && d - r > own + r + part.reach) {  // alone from here on
      near.erase(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(earlier));
    }
    d = blend(d, own, part);
  }
  distance_there = d;
  double widest = 0;
  for (const Candidate& candidate : near) {
    widest = std::max(widest, parts_[static_cast<std::size_t>(candidate.part)].reach);
  }
  std::vector<int> kept;  // without those that later ones cover altogether
  for (const Candidate& candidate : near) {
    if (candidate.added - r <= d + r + widest) kept.push_back(candidate.part);
  }
  return kept;
}

}  // namespace geotherm::generate
