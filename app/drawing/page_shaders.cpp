// SPDX-License-Identifier: MIT
#include "app/drawing/page_shaders.h"

#include <algorithm>
#include <map>
#include <regex>
#include <span>
#include <sstream>
#include <string_view>

#include "embedded/arrow_frag_text.h"
#include "embedded/arrow_vert_text.h"
#include "embedded/frame_glsl_text.h"
#include "embedded/line_frag_text.h"
#include "embedded/line_vert_text.h"
#include "embedded/marker_frag_text.h"
#include "embedded/marker_vert_text.h"
#include "embedded/regions_glsl_text.h"
#include "embedded/shared_h_text.h"
#include "embedded/surface_frag_text.h"
#include "embedded/surface_vert_text.h"

namespace geotherm::app {
namespace {

std::string text_of(std::span<const unsigned char> bytes) { return {bytes.begin(), bytes.end()}; }

const std::map<std::string, std::string>& shader_sources() {
  static const std::map<std::string, std::string> sources = {
      {"arrow.frag", text_of(embedded::arrow_frag_text())},
      {"arrow.vert", text_of(embedded::arrow_vert_text())},
      {"frame.glsl", text_of(embedded::frame_glsl_text())},
      {"line.frag", text_of(embedded::line_frag_text())},
      {"line.vert", text_of(embedded::line_vert_text())},
      {"marker.frag", text_of(embedded::marker_frag_text())},
      {"marker.vert", text_of(embedded::marker_vert_text())},
      {"regions.glsl", text_of(embedded::regions_glsl_text())},
      {"shared.h", text_of(embedded::shared_h_text())},
      {"surface.frag", text_of(embedded::surface_frag_text())},
      {"surface.vert", text_of(embedded::surface_vert_text())}};
  return sources;
}

/// With the files that it includes in place, without versions, extensions and comments.
std::string inlined(const std::string& name) {
  constexpr std::string_view kInclude = "#include \"";
  std::string out;
  std::istringstream lines(shader_sources().at(name));
  for (std::string line; std::getline(lines, line);) {
    line.resize(std::min(line.find("//"), line.size()));
    if (line.starts_with("#version") || line.starts_with("#extension")) continue;
    const std::size_t at = line.find(kInclude);
    if (at != std::string::npos) {
      const std::size_t from = at + kInclude.size();
      out += inlined(line.substr(from, line.find('"', from) - from));
    } else if (line.find_first_not_of(' ') != std::string::npos) {
      out += line + '\n';
    }
  }
  return out;
}

struct Word {
  std::string_view holds;  ///< what a line has that is looked at: expressions take their time
  const char *vulkan, *webgl;
};

/// What Vulkan's GLSL and that of WebGL 2 say differently. There, numbers are never converted.
constexpr Word kWords[] = {
    {"constant_id", R"(layout\(constant_id = 0\) const uint features = 0;)",
     "const uint features = FEATURES;"},
    {"push_constant", R"(layout\(push_constant\) uniform \w+ \{ (\w+) push; \};)",
     "uniform $1 push;"},
    {"std140", R"(layout\(std140, [^)]*\))", "layout(std140)"},
    {"samplerBuffer", R"(layout\([^)]*\) uniform samplerBuffer)", "uniform sampler2D"},
    {"texelFetch", R"(texelFetch\((\w+), (\w+)\))", "texelFetch($1, ivec2($2, 0), 0)"},
    {"SHARED_CONSTANT", R"((SHARED_CONSTANT \w+ = \d+);)", "$1u;"},
    {"kColourSteps", R"((kColourSteps - \d+))", "$1u"},
    {"(features & ", R"((\(features & [^;?{]*?\) [!=]= 0)\b)", "$1u"},
    {"precise", R"(\bprecise )", ""},
    {"gl_VertexIndex", R"(gl_VertexIndex)", "gl_VertexID"},
    {"gl_FragCoord", R"(gl_FragCoord\.xy)",
     "vec2(gl_FragCoord.x, frame.extent.y - gl_FragCoord.y)"}};

/// What stages hand each other is found by name.
constexpr Word kHandedOn = {"layout(location", R"(layout\(location = \d+\) ((flat )?out ))", "$1"};
constexpr Word kTaken = {"layout(location", R"(layout\(location = \d+\) ((flat )?in ))", "$1"};

void replace(std::string& line, const Word& word) {
  if (line.find(word.holds) == std::string::npos) return;
  line = std::regex_replace(line, std::regex(word.vulkan), word.webgl);
}

std::string in_webgl(const std::string& text, bool vertex) {
  std::string out =
      "#version 300 es\nprecision highp float;\nprecision highp int;\n"
      "precision highp sampler2D;\n#ifndef FEATURES\n#define FEATURES 0u\n#endif\n";
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    for (const Word& word : kWords) replace(line, word);
    replace(line, vertex ? kHandedOn : kTaken);
    if (vertex && line.starts_with("void main()")) line.replace(5, 4, "place");
    out += line + '\n';
  }
  if (!vertex) return out;
  // There y points up, and depth runs from -1 to 1.
  return out +
         "void main() {\n  place();\n  gl_Position.yz = vec2(-gl_Position.y, "
         "2.0 * gl_Position.z - gl_Position.w);\n}\n";
}

}  // namespace

std::vector<PageShader> page_shaders() {
  std::vector<PageShader> made;
  for (const auto& [name, source] : shader_sources()) {
    const bool vertex = name.ends_with(".vert");
    if (vertex || name.ends_with(".frag")) made.push_back({name, in_webgl(inlined(name), vertex)});
  }
  return made;
}

}  // namespace geotherm::app
