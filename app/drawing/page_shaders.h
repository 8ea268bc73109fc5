// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace geotherm::app {

/// A shader of the renderer for a browser.
struct PageShader {
  std::string name;  ///< its file in shaders/, such as "surface.vert"
  std::string text;  ///< GLSL ES 3.00
};

/// The renderer's own shaders of surface, lines, markers and arrows, put into the words of WebGL 2:
/// a page is shaded by the same text as a picture. The surface's fragment shader and vertex shader
/// take what is switched on (shaders/shared.h) as the macro FEATURES.
std::vector<PageShader> page_shaders();

}  // namespace geotherm::app
