// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "app/picture/picture_settings.h"
#include "geotherm/mesh.h"
#include "solver/mesh/ray_tree.h"

namespace geotherm::app {

/// Where the model lies in a picture: the view of an eye at a fixed distance, fitted tightly into
/// the middle and then moved and enlarged as the camera says. Model units.
class LineView {
 public:
  struct Ray {
    Vec3 origin, direction;
  };

  /// `margin`: pixels kept free on all sides.
  LineView(const TriangleMesh& mesh, const CameraSettings& camera, int width, int height,
           double margin);

  /// Pixels from the top left corner.
  Eigen::Vector2d project(const Vec3& point) const;

  /// From the eye through a pixel.
  Ray ray_through(const Eigen::Vector2d& pixel) const;

  /// From the eye to a point, which lies at distance 1 along it.
  Ray ray_to(const Vec3& point) const;

  const Vec3& right() const { return right_; }
  const Vec3& up() const { return up_; }
  const Vec3& back() const { return back_; }
  double radius() const { return radius_; }  ///< of the model

 private:
  Eigen::Vector2d on_screen(const Vec3& point) const;

  Vec3 centre_ = Vec3::Zero(), right_, up_, back_;
  double radius_ = 1;
  bool orthographic_;
  double scale_ = 1;  ///< pixels a unit of on_screen()
  Eigen::Vector2d middle_ = Eigen::Vector2d::Zero(), shift_ = Eigen::Vector2d::Zero();
};

/// A line or the outline of a region in a picture, pixels.
using Outline = std::vector<Eigen::Vector2d>;

/// Computes which parts of lines on a surface are not hidden by it.
class LineSight {
 public:
  /// Any view: the eye's ray to a point (LineView::ray_to()), where a point lies in the picture,
  /// and the model's radius.
  struct View {
    std::function<LineView::Ray(const Vec3&)> ray_to;
    std::function<Eigen::Vector2d(const Vec3&)> project;
    double radius = 1;
  };

  LineSight(const RayTree& tree, View view) : tree_(tree), view_(std::move(view)) {}
  LineSight(const RayTree& tree, const LineView& view)
      : LineSight(tree, View{[&view](const Vec3& p) { return view.ray_to(p); },
                             [&view](const Vec3& p) { return view.project(p); }, view.radius()}) {}

  /// Whether the surface leaves a point on it in sight.
  bool sees(const Vec3& point) const;
  /// The same where what hides the point by no more than `reach`, in radii, does not count.
  bool sees(const Vec3& point, double reach) const;
  Eigen::Vector2d place(const Vec3& point) const { return view_.project(point); }

  /// The parts of a polyline that are visible, or those that are hidden, pixels; where they end is
  /// found to a small part of a piece.
  std::vector<Outline> parts(std::span<const Vec3> points, bool visible) const;

 private:
  Vec3 last_such(Vec3 such, Vec3 other, bool visible) const;

  const RayTree& tree_;
  View view_;
};

/// Borders, and the edges where the surface turns away from the eye: visible parts, pixels.
std::vector<Outline> visible_contours(const TriangleMesh& mesh, const LineSight& sight,
                                      const LineView& view);

}  // namespace geotherm::app
