// SPDX-License-Identifier: MIT
#include "app/lines/line_view.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace geotherm::app {
namespace {

using Eigen::Vector2d;

/// Of the eye from the middle of the model, in its radii: a view of 30 degrees holds the model.
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
  right_ = Vec3(std::cos(azimuth), 0, -std::sin(azimuth));
  back_ = std::cos(elevation) * Vec3(std::sin(azimuth), 0, std::cos(azimuth)) +
          std::sin(elevation) * Vec3(0, 1, 0);
  up_ = back_.cross(right_);

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

}  // namespace geotherm::app
