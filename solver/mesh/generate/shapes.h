// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <variant>
#include <vector>

#include "solver/core/types.h"

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

}  // namespace geotherm::generate
