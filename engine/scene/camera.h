// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <span>

namespace geotherm::engine {

/// What of the picture is kept free of the model, in pixels from its four sides.
struct Insets {
  float left = 0, top = 0, right = 0, bottom = 0;
};

enum class Fit {
  kTight,   ///< as large as the insets allow, seen from this direction
  kSphere,  ///< the sphere of radius 1 about the orbit's centre: the same size from everywhere
};

/// Where the eye is, seen from the model. The model lies within radius 1 of the origin, Y is up.
struct Orbit {
  float azimuth = 30;    ///< degrees about +Y; 0: the eye is on the +Z side, 90: on the +X side
  float elevation = 20;  ///< degrees above the XZ plane, -90 to 90
  float zoom = 1;        ///< > 0; 2: twice as large as it fits
  glm::vec2 pan{0, 0};   ///< shift of the model in picture heights: right, up
  bool orthographic = false;
  float field_of_view = 30;  ///< degrees, vertical; perspective only
  Fit fit = Fit::kTight;
  glm::vec3 centre{0};  ///< kSphere alone: what the eye goes round, and what lies in the middle
  /// Orthonormal, right-handed: what takes the places of X, Y (up) and Z above.
  glm::mat3 axes{1};
  float roll = 0;  ///< degrees by which the picture is turned counter-clockwise
};

/// Matrices of a view. Clip space is Vulkan's: x right, y down, depth 1 at the near plane and 0 at
/// the far one (reversed, for precision).
struct Camera {
  glm::mat4 view{1};        ///< scene to eye space (the eye looks along -z), rigid
  glm::mat4 projection{1};  ///< eye to clip space
  glm::vec2 extent{1, 1};   ///< the whole picture, pixels
  bool orthographic = false;
  /// Pixels that a length of 1 at depth 1 before the eye covers (orthographic: at any depth).
  float pixels_per_unit = 1;

  /// Pixels from the top left corner, and depth (see above). Precondition: before the eye.
  glm::vec3 project(const glm::vec3& point) const;
  /// Unit vector from `point` to the eye, scene space.
  glm::vec3 to_eye(const glm::vec3& point) const;
};

/// A camera that shows `points` (scene space) fitted as the orbit says into what the insets leave.
/// Tight fits solve for the frustum planes that touch the points, exactly and in O(points). Zoom
/// and pan are those of a lens: the eye stays where the fit put it, zoom scales about the centre of
/// what the insets leave. Never fails: a single point, no point, points that are not finite (left
/// out) and an extent smaller than its insets give a sane camera.
Camera make_camera(const Orbit& orbit, std::span<const glm::vec3> points, glm::vec2 extent,
                   const Insets& insets = {});

}  // namespace geotherm::engine
