// SPDX-License-Identifier: MIT
#include "app/picture/line_sight.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "solver/geometry/clean_faces.h"

namespace geotherm::app {
namespace {

using Eigen::Vector2d;

/// How far the eye is from the middle of the model, in its radii: 30 degrees then hold the model.
constexpr double kEye = 3.9;

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

struct Box2 {
  Vector2d low = Vector2d::Constant(std::numeric_limits<double>::max());
  Vector2d high = -low;
};

}  // namespace

LineView::LineView(const TriangleMesh& mesh, const CameraSettings& camera, int width, int height,
                   double margin)
    : orthographic_(camera.orthographic) {
  const double azimuth = radians(camera.azimuth);
  const double elevation = radians(std::clamp(camera.elevation, -90.0, 90.0));
  const auto axes = axes_of(camera.up);
  const Vec3 x(axes[0].data()), y(axes[1].data()), z(axes[2].data());
  const Vec3 level = std::cos(azimuth) * x - std::sin(azimuth) * z;
  back_ = std::cos(elevation) * (std::sin(azimuth) * x + std::cos(azimuth) * z) +
          std::sin(elevation) * y;
  const Vec3 upright = back_.cross(level);
  const double roll = radians(camera.roll);
  right_ = std::cos(roll) * level - std::sin(roll) * upright;
  up_ = std::sin(roll) * level + std::cos(roll) * upright;

  Vec3 low = Vec3::Constant(std::numeric_limits<double>::max()), high = -low;
  for (const Face& face : mesh.faces()) {
    for (const Index v : face) {
      low = low.cwiseMin(mesh.positions()[v]);
      high = high.cwiseMax(mesh.positions()[v]);
    }
  }
  centre_ = low / 2 + high / 2;
  const double half = (high / 2 - low / 2).stableNorm();
  if (half > 0) radius_ = half;

  Box2 box;
  for (const Face& face : mesh.faces()) {
    for (const Index v : face) {
      const Vector2d at = on_screen(mesh.positions()[v]);
      box.low = box.low.cwiseMin(at);
      box.high = box.high.cwiseMax(at);
    }
  }
  middle_ = (box.low + box.high) / 2;
  constexpr double kFlat = 1e-6;  // what has no width is fitted by its height
  const Vector2d size = (box.high - box.low).cwiseMax(kFlat);
  const Vector2d room = Vector2d(width - 2 * margin, height - 2 * margin).cwiseMax(1.0);
  scale_ = (room.array() / size.array()).minCoeff() * camera.zoom;
  shift_ = Vector2d(0.5 * width + camera.pan_right * height, 0.5 * height - camera.pan_up * height);
}

/// Right and up, in radii of the model at its middle.
Vector2d LineView::on_screen(const Vec3& point) const {
  const Vec3 p = (point - centre_) / radius_;
  const Vector2d flat(right_.dot(p), up_.dot(p));
  if (orthographic_) return flat;
  return flat * (kEye / (kEye - back_.dot(p)));
}

Vector2d LineView::project(const Vec3& point) const {
  const Vector2d at = scale_ * (on_screen(point) - middle_);
  return {shift_.x() + at.x(), shift_.y() - at.y()};
}

LineView::Ray LineView::ray_through(const Vector2d& pixel) const {
  const Vector2d at = Vector2d(pixel.x() - shift_.x(), shift_.y() - pixel.y()) / scale_ + middle_;
  const Vec3 on_plane = centre_ + radius_ * (at.x() * right_ + at.y() * up_);
  if (orthographic_) return {on_plane + kEye * radius_ * back_, -back_};
  const Vec3 eye = centre_ + kEye * radius_ * back_;
  return {eye, (on_plane - eye) / radius_};
}

LineView::Ray LineView::ray_to(const Vec3& point) const {
  const Vec3 eye =
      orthographic_ ? Vec3(point + kEye * radius_ * back_) : Vec3(centre_ + kEye * radius_ * back_);
  return {eye, point - eye};
}

namespace {

/// What lies before a point by less than this, in radii of the model, is the surface it lies on: a
/// hundred roundings of single precision.
constexpr double kOnSurface = 1e-5;
/// The same of contours, which zigzag over the edges of a curved surface, partly behind others.
constexpr double kAtContour = 4e-3;

}  // namespace

bool LineSight::sees(const Vec3& point) const { return sees(point, kOnSurface); }

bool LineSight::sees(const Vec3& point, double reach) const {
  const LineView::Ray ray = view_.ray_to(point);
  const auto hit = tree_.first_hit(ray.origin, ray.direction);
  return !hit || (1 - hit->distance) * ray.direction.stableNorm() < reach * view_.radius;
}

Vec3 LineSight::last_such(Vec3 such, Vec3 other, bool visible) const {
  constexpr int kHalvings = 5;
  for (int i = 0; i < kHalvings; ++i) {
    const Vec3 middle = such / 2 + other / 2;
    (sees(middle) == visible ? such : other) = middle;
  }
  return such;
}

std::vector<Outline> LineSight::parts(std::span<const Vec3> points, bool visible) const {
  std::vector<Outline> out;
  bool before = false;
  const auto add = [&](const Vec3& point) { out.back().push_back(view_.project(point)); };
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool now = sees(points[i]) == visible;
    if (now && !before) {
      out.emplace_back();
      if (i > 0) add(last_such(points[i], points[i - 1], visible));
    }
    if (now) add(points[i]);
    if (!now && before) add(last_such(points[i - 1], points[i], visible));
    before = now;
  }
  return out;
}

std::vector<Outline> visible_contours(const TriangleMesh& mesh, const LineSight& sight,
                                      const LineView& view) {
  const CleanFaces clean = clean_faces(mesh);
  const auto at = [&mesh](Index v) -> const Vec3& { return mesh.positions()[v]; };
  std::vector<char> faces_eye;
  for (const auto& [a, b, c] : clean.faces) {
    const Vec3 normal = ((at(b) - at(a)) / view.radius()).cross((at(c) - at(a)) / view.radius());
    faces_eye.push_back(static_cast<char>(normal.dot(view.ray_to(at(a)).direction) < 0));
  }
  std::vector<Outline> out;
  for (Index e = 0; e < clean.edges.edge_count(); ++e) {
    const auto sides = clean.edges.sides(e);
    const bool inner = sides.size() == 2;
    if (inner) {
      const Index f = face_of(sides[0]), g = face_of(sides[1]);
      const bool same_way = clean.faces[f][corner_of(sides[0])] !=
                            clean.faces[g][corner_of(sides[1])];  // or on a Moebius strip
      if (!same_way || faces_eye[f] == faces_eye[g]) continue;
    }
    const Vec3 ends[] = {at(clean.edges.low(e)), at(clean.edges.high(e))};
    if (!sight.sees(ends[0] / 2 + ends[1] / 2, kAtContour)) continue;
    out.push_back({view.project(ends[0]), view.project(ends[1])});
  }
  return out;
}

}  // namespace geotherm::app
