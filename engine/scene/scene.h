// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <span>
#include <vector>

#include "engine/scene/camera.h"

namespace geotherm::engine {

/// Value of a vertex that has none; its faces are drawn in neutral grey.
inline constexpr float kNoValue = -std::numeric_limits<float>::max();
inline constexpr glm::vec3 kNoValueColour{0.62F};  ///< as in surface.frag

/// How much light comes to a vertex, 0 to 1 on either side.
struct Openness {
  glm::vec3 normal;  ///< tells the sides apart
  float front = 1, back = 1;
};
inline constexpr std::size_t kMaxLevels = 64;  ///< of isolines at chosen values

/// A triangle mesh in scene space: within radius 1 of the origin, finite.
struct SurfaceGeometry {
  std::span<const glm::vec3> positions;                 ///< V
  std::span<const std::array<std::uint32_t, 3>> faces;  ///< F, every corner in [0, V)
  bool solid = false;  ///< closed, all faces counter-clockwise from outside: no back is ever seen
  std::span<const Openness> openness = {};  ///< V; empty: all is open
};

/// A source: a point (both ends the same) or a straight piece of a curve.
struct Marker {
  glm::vec3 from, to;  ///< scene space
  /// Which way the faces about it look, and the sine of the angle that they are at most away from
  /// that: where all look away from the eye the marker is hidden as they are. Above 1: not known.
  glm::vec4 outward{0, 0, 0, 2};
};

/// A line on the surface.
struct Polyline {
  std::span<const glm::vec3> points;  ///< scene space
  glm::vec3 colour{0};                ///< sRGB
};

enum class Light {
  kHeadlight,   ///< one lamp at the eye
  kThreePoint,  ///< key, fill and rim light, fixed to the eye
  kNone,        ///< colours as they are
};

enum class Paint {
  kPlain,  ///< one colour
  kMap,    ///< the colour map at each vertex' value
  kFaces,  ///< the colour map at each face's own value, flat within it
  /// The colour of the region that is nearest, with lines between regions: each vertex has one, and
  /// between vertices of several their margins decide (region_margins()).
  kRegions,
};

/// How the surface is drawn; what is off costs nothing.
struct SurfaceStyle {
  bool visible = true;
  bool smooth = true;  ///< shaded with vertex normals, split where faces meet sharply
  Paint paint = Paint::kPlain;
  glm::vec3 colour{0.80F, 0.80F, 0.78F};  ///< kPlain, sRGB
  float range_min = 0, range_max = 1;     ///< values at the ends of the colour map
  bool log = false;                       ///< equal ratios of values are equally far apart
  float log_offset = 0;                   ///< of what has the logarithm, less the value
  int bands = 0;                          ///< of one colour, evenly over the map; 0: none
  float line_spacing = 0;                 ///< isolines at its multiples; 0: none
  std::vector<float> levels;              ///< isolines there instead, up to kMaxLevels
  float line_width = 1.4F;                ///< pixels
  glm::vec3 line_colour{0.05F};
  /// Hollows and what turns away from the eye are darker (SurfaceGeometry::openness).
  bool form = false;
  bool wire = false;        ///< edges of all triangles
  float wire_width = 1.0F;  ///< pixels
  glm::vec3 wire_colour{0.08F, 0.09F, 0.11F};
};

struct ArrowStyle {
  bool primary = false;    ///< the first field, in black
  bool secondary = false;  ///< the second one, in blue
  float spacing = 26;      ///< pixels between arrows, about
  glm::vec3 primary_colour{0.04F}, secondary_colour{0.05F, 0.25F, 0.85F};
};

struct MarkerStyle {
  bool visible = true;
  float radius = 5;      ///< pixels
  float inside = 0.68F;  ///< of the radius; the rest is rim
  glm::vec3 colour{1, 1, 1}, rim{0.05F};
  float hidden_opacity = 0.33F;  ///< of the rim; what lies on it adds as much
};

/// What the surface hides of a line is drawn in dashes.
struct LineStyle {
  bool visible = true;
  float width = 3;                                   ///< pixels, without the rim
  float dash = 11;                                   ///< pixels from dash to dash
  float hidden_width = 0.6F, hidden_opacity = 0.6F;  ///< of dashes, in those of the line
  float rim = 1.2F;                                  ///< pixels on either side
  glm::vec3 dark_rim{0.05F}, light_rim{1, 1, 1};     ///< about light lines, about dark ones

  /// The one that stands out from a line of this colour.
  glm::vec3 rim_about(const glm::vec3& colour) const {
    const float grey = glm::dot(colour, glm::vec3(0.299F, 0.587F, 0.114F));
    return grey > 0.5F ? dark_rim : light_rim;
  }
};

/// Everything about a picture but the data that was uploaded.
struct Scene {
  Camera camera;
  Light light = Light::kThreePoint;
  glm::vec4 background{1, 1, 1, 1};  ///< sRGB and alpha; what has alpha 0 stays transparent
  SurfaceStyle surface;
  ArrowStyle arrows;
  LineStyle lines;
  MarkerStyle markers;
  float pixel_scale = 1;  ///< multiplies every width, radius and spacing in pixels
};

}  // namespace geotherm::engine
