// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <functional>
#include <span>
#include <variant>
#include <vector>

#include "geotherm/types.h"

namespace geotherm::generate {

/// The solids that models are sculpted from. Each distance is negative inside, zero on the surface
/// and, near the surface, about the distance to it: exact for the box, a bound for the others.

/// |R (p - center) / radii| = 1; the rows of R are the axes (J. Quilez's bound of the distance).
struct Ellipsoid {
  Vec3 center;
  Vec3 radii;
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
};

/// Balls of changing radius swept along a polyline; see tube() for a smooth one.
struct Tube {
  std::vector<Vec3> points;
  std::vector<double> radii;
};

/// A box with edges rounded by `radius` (the half sizes include the rounding).
struct RoundBox {
  Vec3 center;
  Vec3 half;
  double radius;
};

/// A sheet with ribs: a flat outline of half thickness `half`, thickened by rods, and bent out of
/// its plane by `bow` u^2 + `lean` v^2, with `billow` more between the rods.
struct Sheet {
  struct Rod {
    Eigen::Vector2d from, to;
    double from_radius, to_radius;
  };
  Vec3 origin;
  Eigen::Matrix3d axes;  ///< rows: u, v, normal
  std::vector<Eigen::Vector2d> outline;
  std::vector<Rod> rods;
  double half;
  double bow, lean, billow;
};

using Shape = std::variant<Ellipsoid, Tube, RoundBox, Sheet>;

double distance_to(const Ellipsoid& shape, const Vec3& p);
double distance_to(const Tube& shape, const Vec3& p);
double distance_to(const RoundBox& shape, const Vec3& p);
double distance_to(const Sheet& shape, const Vec3& p);
double distance_to(const Shape& shape, const Vec3& p);

/// The same shape on the other side of the plane x = 0.
Shape mirrored(const Shape& shape);

/// A point of a curve with the radius of the solid around it.
struct Knot {
  Vec3 point;
  double radius;
};

/// A smooth tube through the knots: a Catmull-Rom curve, `steps` pieces between two knots.
Tube tube(const std::vector<Knot>& knots, int steps = 6);

/// Rows: three perpendicular axes, the first along `main`, the second nearest to `second`.
Eigen::Matrix3d frame(const Vec3& main, const Vec3& second);

/// A solid made by adding and carving shapes one after another, each blended into what is there.
///
/// distance(p) is negative inside and about the distance near the surface. Blending is the
/// quadratic smooth minimum with compact support: a shape changes nothing where it is further
/// from the surface than its reach, which is what cull() lives on.
class Sculpture {
 public:
  /// How much faster than distances the bounds that stand for them may grow.
  static constexpr double kSteepest = 1.25;
  using Parts = std::span<const int>;  ///< numbers of shapes, in the order they were made in
  using Detail = std::function<double(const Vec3& p)>;

  /// `spacing`, about, of the grid that will sample it: shapes thinner than the grid can hold are
  /// thickened.
  explicit Sculpture(double spacing) : spacing_(spacing) {}

  void add(Shape shape, double reach);
  void carve(Shape shape, double reach);
  void add_pair(const Shape& shape, double reach);    ///< with its mirror image, x -> -x
  void carve_pair(const Shape& shape, double reach);  ///< with its mirror image, x -> -x

  /// Raises the surface by detail(p), at most `height` in size, where that is near.
  void set_detail(Detail detail, double height);

  double spacing() const { return spacing_; }
  std::vector<int> all_parts() const;
  double distance(const Vec3& p, Parts parts) const;

  /// Those of `parts` that can matter within `radius` of `center`; `distance_there` gets the
  /// distance at the centre. Shapes only: how much the detail may add is detail_height().
  std::vector<int> cull(const Vec3& center, double radius, Parts parts,
                        double& distance_there) const;
  double detail_height() const { return detail_height_; }

 private:
  /// Long tubes are kept as several parts of one group, whose union (not blended) counts as one.
  struct Part {
    Shape shape;
    double reach;
    bool carved;
    int group;
  };
  double thick(double radius) const;
  void append(Shape shape, double asked, bool carved);
  static double blend(double d, double own, const Part& part);

  double spacing_;
  double detail_height_ = 0;
  int groups_ = 0;
  std::vector<Part> parts_;
  Detail detail_;
};

}  // namespace geotherm::generate
