// SPDX-License-Identifier: MIT
// What C++ and GLSL have in common: structs as they lie in memory (std140), and numbers of bindings
// and variants. Included by both.
#ifndef GEOTHERM_SHADERS_SHARED_H
#define GEOTHERM_SHADERS_SHARED_H

#ifdef __cplusplus
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>

namespace geotherm::engine::shared {
using mat4 = glm::mat4;
using vec2 = glm::vec2;
using vec4 = glm::vec4;
using uint = std::uint32_t;
#define SHARED_CONSTANT constexpr uint
#else
#define SHARED_CONSTANT const uint
#endif

// Bindings of descriptor set 0.
SHARED_CONSTANT kFrameBinding = 0;    // Frame
SHARED_CONSTANT kColoursBinding = 1;  // the colour map
SHARED_CONSTANT kAtlasBinding = 2;    // coverage of letters

// Constant 0 of the surface's fragment shader: what is switched on.
SHARED_CONSTANT kFlat = 1;      // shaded by the face's own normal
SHARED_CONSTANT kMapped = 2;    // painted by the colour map
SHARED_CONSTANT kIsolines = 4;  // lines at multiples of a value
SHARED_CONSTANT kWire = 8;      // edges of the triangles
SHARED_CONSTANT kThreeLights = 16;
SHARED_CONSTANT kNoLight = 32;
SHARED_CONSTANT kRegions = 64;  // painted by the nearest region
SHARED_CONSTANT kForm = 128;    // darker where little light comes, and towards outlines

SHARED_CONSTANT kLogarithmic = 1024;  // places on the colour map go with the logarithm
SHARED_CONSTANT kLevels = 2048;       // lines at chosen values

// Chosen values of isolines, four a vector.
SHARED_CONSTANT kLevelVectors = 16;

// RGBA8, evenly over the colour map.
SHARED_CONSTANT kColourSteps = 1024;

// Everything that is the same for all of one frame. Lengths on screen in pixels.
struct Frame {
  mat4 clip_from_scene;
  mat4 eye_from_scene;
  vec2 extent;         // of the whole picture
  float near_shift;    // of markers and lines towards the eye, in their radii
  float orthographic;  // 1 or 0
  vec4 tile;           // of the picture: scale and shift of its clip coordinates
  vec4 range;        // x, y: place on the colour map = scaled value * x + y; z: scaled value of 1;
                     // where kLogarithmic: place = log2(scaled value + w) * x + y
  vec4 plain;        // colour of the surface
  vec4 line;         // colour, width
  vec4 wire;         // colour, width
  vec4 marker;       // colour, radius
  vec4 marker_rim;   // colour, the radius within it as a share
  vec4 polyline;     // half the width, the same with the rim; the tile's first pixel
  vec4 sight;        // x and y at depth 1 before the eye = pixel * xy + zw; orthographic: 0
  vec4 level_count;  // x: of the levels below; y: of bands of one colour, 0: none
  vec4 levels[kLevelVectors];
};

// Pushed with each draw of arrows.
struct ArrowPush {
  vec4 colour;
  float lift;  // towards the eye, in lengths of a full arrow
};

// Pushed with each draw of markers.
struct MarkerPush {
  float opacity;  // below 1: of those that the surface hides
  float inside;   // 1: the inside of markers, 0: their rims
};

// Pushed with each draw of a polyline.
struct LinePush {
  vec4 colour;  // multiplied by its opacity
  float half_width;
  float dash;  // scene units from dash to dash; 0: none
};

// Pushed once for all panels.
struct PanelPush {
  vec2 clip_of_pixel;  // 2 / the target's extent
};

#ifdef __cplusplus
static_assert(sizeof(Frame) == 2 * 64 + 16 + (10 + kLevelVectors) * 16);
static_assert(offsetof(Frame, extent) == 128);
static_assert(offsetof(Frame, near_shift) == 136);
static_assert(offsetof(Frame, orthographic) == 140);
static_assert(offsetof(Frame, tile) == 144);
static_assert(offsetof(Frame, range) == 160);
static_assert(offsetof(Frame, plain) == 176);
static_assert(offsetof(Frame, line) == 192);
static_assert(offsetof(Frame, wire) == 208);
static_assert(offsetof(Frame, marker) == 224);
static_assert(offsetof(Frame, marker_rim) == 240);
static_assert(offsetof(Frame, polyline) == 256);
static_assert(offsetof(Frame, sight) == 272);
static_assert(offsetof(Frame, levels) == 304);
static_assert(sizeof(ArrowPush) == 20);
static_assert(sizeof(LinePush) == 24);
static_assert(sizeof(MarkerPush) == 8);
static_assert(sizeof(PanelPush) == 8);
}  // namespace geotherm::engine::shared
#endif
#undef SHARED_CONSTANT
#endif
