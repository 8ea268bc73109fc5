// SPDX-License-Identifier: MIT
#include "engine/scene/camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace geotherm::engine {
namespace {

using glm::dvec2;
using glm::dvec3;

constexpr double kModelRadius = 1;
/// Planes keep this share of the model's radius more, for what is drawn around its points.
constexpr double kDepthMargin = 0.02;
/// Models smaller than this are shown as points: floats near 1 have no shape below.
constexpr double kSmallestRadius = 1e-5;
/// The eye keeps off the nearest point by this share of the model's radius: a line that points to
/// the eye has no width to be fitted.
constexpr double kClosestEye = 0.02;
/// Any distance shows the same; this one is outside the model.
constexpr double kOrthographicEye = 2 * kModelRadius;

double finite_or(float value, double other) { return std::isfinite(value) ? value : other; }

/// Directions of eye space, seen from the scene; the eye looks along -back.
struct Axes {
  dvec3 right, up, back;
};

Axes axes_of(const Orbit& orbit) {
  const double azimuth = glm::radians(finite_or(orbit.azimuth, 0));
  const double elevation = glm::radians(std::clamp(finite_or(orbit.elevation, 0), -90.0, 90.0));
  const dvec3 right(std::cos(azimuth), 0, -std::sin(azimuth));
  const dvec3 ahead(std::sin(azimuth), 0, std::cos(azimuth));
  const dvec3 back = std::cos(elevation) * ahead + std::sin(elevation) * dvec3(0, 1, 0);
  const dvec3 up = glm::cross(back, right);
  const glm::dmat3 axes(orbit.axes);
  const double roll = glm::radians(finite_or(orbit.roll, 0));
  return {axes * (std::cos(roll) * right - std::sin(roll) * up),
          axes * (std::sin(roll) * right + std::cos(roll) * up), axes * back};
}

/// The centre of the sphere that is fitted into the picture, along the axes.
dvec3 centre_of(const Orbit& orbit, const Axes& axes) {
  const glm::vec3& c = orbit.centre;
  if (!std::isfinite(c.x + c.y + c.z)) return dvec3(0);
  const dvec3 centre(c);
  return {glm::dot(axes.right, centre), glm::dot(axes.up, centre), glm::dot(axes.back, centre)};
}

/// What the insets leave of the picture, pixels.
struct Region {
  dvec2 centre, half;
};

void fit_insets(double extent, float before, float after, double& centre, double& half) {
  double low = std::max(0.0, finite_or(before, 0));
  double high = std::max(0.0, finite_or(after, 0));
  // A tenth of the picture is left to the model at least.
  const double shrink = std::min(1.0, 0.9 * extent / std::max(low + high, 1e-9));
  low *= shrink;
  high *= shrink;
  centre = (low + extent - high) / 2;
  half = (extent - low - high) / 2;
}

Region region_of(const dvec2& extent, const Insets& insets) {
  Region region{};
  fit_insets(extent.x, insets.left, insets.right, region.centre.x, region.half.x);
  fit_insets(extent.y, insets.top, insets.bottom, region.centre.y, region.half.y);
  return region;
}

/// The point that reaches farthest in a direction; `reach` is -infinity when there is none.
struct Support {
  double reach = -std::numeric_limits<double>::infinity();
  dvec3 point{0};
};

template <std::size_t N>
std::array<Support, N> supports(std::span<const glm::vec3> points,
                                const std::array<dvec3, N>& directions) {
  std::array<Support, N> best;
  for (const glm::vec3& p : points) {
    if (!std::isfinite(p.x + p.y + p.z)) continue;
    const dvec3 point(p);
    for (std::size_t i = 0; i < N; ++i) {
      const double reach = glm::dot(directions[i], point);
      if (reach > best[i].reach) best[i] = {reach, point};
    }
  }
  return best;
}

/// Bounds of the points along the axes of eye space.
struct Box {
  dvec3 min, max;
  double radius() const { return glm::length(max - min) / 2; }
};

std::optional<Box> box_of(std::span<const glm::vec3> points, const Axes& axes) {
  const auto [x1, x0, y1, y0, z1, z0] =
      supports<6>(points, {axes.right, -axes.right, axes.up, -axes.up, axes.back, -axes.back});
  if (!std::isfinite(x1.reach)) return std::nullopt;
  return Box{{-x0.reach, -y0.reach, -z0.reach}, {x1.reach, y1.reach, z1.reach}};
}

/// Where the eye is (along the axes) and how large a length of 1 appears; see Camera.
struct Placement {
  dvec3 eye{0};
  double pixels_per_unit = 1;
};

/// Fits the sphere of radius 1 about `centre`; the eye stays before `nearest`, the point that is
/// farthest along `back`, under a longer lens where the sphere alone would put it behind.
Placement place_sphere(const dvec3& centre, double nearest, const Region& region,
                       double pixels_per_tangent, bool orthographic) {
  const double half = std::min(region.half.x, region.half.y);
  if (orthographic) {
    return {{centre.x, centre.y, kOrthographicEye + std::max(0.0, centre.z)}, half / kModelRadius};
  }
  const double tangent = half / pixels_per_tangent;
  const double distance = kModelRadius * std::sqrt(1 + tangent * tangent) / tangent;
  const double least = nearest - centre.z + kClosestEye * kModelRadius;
  if (distance >= least) return {centre + dvec3(0, 0, distance), pixels_per_tangent};
  const double longer = half * std::sqrt(least * least - kModelRadius * kModelRadius);
  return {centre + dvec3(0, 0, least), longer};
}

Placement place_orthographic(const Box& box, const Region& region) {
  const dvec3 half = glm::max((box.max - box.min) / 2.0, dvec3(kClosestEye * box.radius()));
  const double scale = std::min(region.half.x / half.x, region.half.y / half.y);
  dvec3 eye = (box.min + box.max) / 2.0;
  eye.z = kOrthographicEye + std::max(0.0, box.max.z);
  return {eye, scale};
}

/// Two planes through the eye with slopes +-tangent against the view's axis touch the points on
/// both sides when
///   eye + tangent * distance = max(a + tangent * c),  -eye + tangent * distance = max(-a + ...)
/// with a, c the points' coordinates along `side` and `back`. For given slopes these two linear
/// equations yield the least distance.
double least_distance(const Support& right, const Support& left, double tangent) {
  return (right.reach + left.reach) / (2 * tangent);
}

/// The eye's place along `side` that centres what is seen from a given distance: the narrowest pair
/// of planes that holds the points. Its slope is the root of a convex, piecewise linear function,
/// which Newton's method meets exactly after a few pieces when it starts on the left.
double centred(std::span<const glm::vec3> points, const dvec3& side, const dvec3& back,
               double distance) {
  double tangent = 0;
  for (int step = 0;; ++step) {
    const auto [right, left] = supports<2>(points, {side + tangent * back, -side + tangent * back});
    const double depths = 2 * distance - glm::dot(back, right.point) - glm::dot(back, left.point);
    const double next = glm::dot(side, right.point - left.point) / depths;
    if (step == 8 || !(next > tangent * (1 + 1e-9))) return (right.reach - left.reach) / 2;
    tangent = next;
  }
}

Placement place_perspective(std::span<const glm::vec3> points, const Box& box, const Axes& axes,
                            const Region& region, double pixels_per_tangent) {
  const dvec2 tangents = region.half / pixels_per_tangent;
  const dvec3 x = tangents.x * axes.back;
  const dvec3 y = tangents.y * axes.back;
  const auto [right, left, top, bottom] =
      supports<4>(points, {axes.right + x, x - axes.right, axes.up + y, y - axes.up});
  dvec3 eye(0);
  eye.z =
      std::max({least_distance(right, left, tangents.x), least_distance(top, bottom, tangents.y),
                box.max.z + kClosestEye * box.radius()});
  eye.x = centred(points, axes.right, axes.back, eye.z);
  eye.y = centred(points, axes.up, axes.back, eye.z);
  return {eye, pixels_per_tangent};
}

struct DepthRange {
  double near, far;
};

/// Depths that hold the sphere of the model and its points; what the sphere has behind the eye or
/// at it is given up, the points are not.
DepthRange depth_range(const Box& box, double eye, bool orthographic) {
  const double reach = kModelRadius * (1 + kDepthMargin);
  const double nearest = eye - std::max(reach, box.max.z + kDepthMargin);
  const double farthest = eye - std::min(-reach, box.min.z - kDepthMargin);
  if (orthographic) return {nearest, farthest};
  const double free = eye - box.max.z;
  return {std::max(nearest, 0.01 * (free > 0 ? free : kModelRadius)), farthest};
}

glm::mat4 view_matrix(const Axes& axes, const dvec3& eye) {
  glm::dmat4 view(1);
  for (int i = 0; i < 3; ++i) {
    view[i] = {axes.right[i], axes.up[i], axes.back[i], 0};
  }
  view[3] = {-eye, 1};
  return glm::mat4(view);
}

/// `scale`: clip space a unit (perspective: at depth 1); `shift`: of the view's axis from the
/// picture's centre, clip space.
glm::mat4 projection_matrix(const dvec2& scale, const dvec2& shift, const DepthRange& depth,
                            bool orthographic) {
  const double length = depth.far - depth.near;
  glm::dmat4 matrix(0);
  matrix[0][0] = scale.x;
  matrix[1][1] = -scale.y;
  if (orthographic) {
    matrix[2][2] = 1 / length;
    matrix[3] = {shift, depth.far / length, 1};
  } else {
    matrix[2] = {-shift, depth.near / length, -1};
    matrix[3][2] = depth.near * depth.far / length;
  }
  return glm::mat4(matrix);
}

}  // namespace

glm::vec3 Camera::project(const glm::vec3& point) const {
  const glm::vec4 clip = projection * (view * glm::vec4(point, 1));
  const glm::vec3 device = glm::vec3(clip) / clip.w;
  return {(device.x + 1) / 2 * extent.x, (device.y + 1) / 2 * extent.y, device.z};
}

glm::vec3 Camera::to_eye(const glm::vec3& point) const {
  const glm::mat3 rotation(view);
  const glm::vec3 back = glm::transpose(rotation)[2];
  if (orthographic) return back;
  const glm::vec3 way = -glm::transpose(rotation) * glm::vec3(view[3]) - point;
  const float length = glm::length(way);
  return length > 0 ? way / length : back;
}

Camera make_camera(const Orbit& orbit, std::span<const glm::vec3> points, glm::vec2 extent,
                   const Insets& insets) {
  const dvec2 size(std::max(1.0, finite_or(extent.x, 1)), std::max(1.0, finite_or(extent.y, 1)));
  const Region region = region_of(size, insets);
  const Axes axes = axes_of(orbit);
  const double angle = std::clamp(finite_or(orbit.field_of_view, 30), 1.0, 150.0);
  const double pixels_per_tangent = size.y / 2 / std::tan(glm::radians(angle / 2));

  // A lens, not a walk: the picture scales as a whole and the eye never enters the model.
  const double zoom = orbit.zoom > 0 ? std::clamp<double>(orbit.zoom, 1e-4, 1e6) : 1.0;

  const std::optional<Box> found = box_of(points, axes);
  const Box box = found.value_or(Box{dvec3(-kModelRadius), dvec3(kModelRadius)});
  Placement place;
  if (orbit.fit == Fit::kSphere) {
    place = place_sphere(centre_of(orbit, axes), box.max.z, region, pixels_per_tangent,
                         orbit.orthographic);
  } else if (!found) {
    place = place_sphere(dvec3(0), box.max.z, region, pixels_per_tangent, orbit.orthographic);
  } else if (box.radius() < kSmallestRadius) {
    place = place_sphere(box.min, box.max.z, region, pixels_per_tangent, orbit.orthographic);
  } else if (orbit.orthographic) {
    place = place_orthographic(box, region);
  } else {
    place = place_perspective(points, box, axes, region, pixels_per_tangent);
  }
  const double pixels_per_unit = place.pixels_per_unit * zoom;

  const dvec2 pan(finite_or(orbit.pan.x, 0), -finite_or(orbit.pan.y, 0));
  const dvec2 axis = region.centre + pan * size.y;
  Camera camera;
  camera.extent = glm::vec2(size);
  camera.orthographic = orbit.orthographic;
  camera.pixels_per_unit = static_cast<float>(pixels_per_unit);
  camera.view = view_matrix(axes, place.eye);
  camera.projection =
      projection_matrix(2 * pixels_per_unit / size, 2.0 * axis / size - 1.0,
                        depth_range(box, place.eye.z, orbit.orthographic), orbit.orthographic);
  return camera;
}

}  // namespace geotherm::engine
