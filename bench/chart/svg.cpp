// SPDX-License-Identifier: MIT
#include "bench/chart/svg.h"

#include <cassert>
#include <cmath>

#include "bench/number_text.h"

namespace geotherm::bench::svg {
namespace {

std::string pixels(double value) {
  assert(std::isfinite(value));
  return format("%.1f", value);
}

std::string attribute(const char* name, const std::string& value) {
  return std::string(" ") + name + "=\"" + value + "\"";
}

std::string place(const Points& points) {
  std::string out;
  for (const auto& [x, y] : points) {
    if (!out.empty()) out += ' ';
    out += pixels(x) + "," + pixels(y);
  }
  return out;
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else if (c == '"') {
      out += "&quot;";
    } else {
      out += c;
    }
  }
  return out;
}

std::string line(double x1, double y1, double x2, double y2, const char* kind) {
  return "<line" + attribute("class", kind) + attribute("x1", pixels(x1)) +
         attribute("y1", pixels(y1)) + attribute("x2", pixels(x2)) + attribute("y2", pixels(y2)) +
         "/>\n";
}

std::string polyline(const Points& points, const char* kind) {
  return "<polyline" + attribute("class", kind) + attribute("points", place(points)) + "/>\n";
}

std::string circle(double x, double y, double radius, const char* kind) {
  return "<circle" + attribute("class", kind) + attribute("cx", pixels(x)) +
         attribute("cy", pixels(y)) + attribute("r", pixels(radius)) + "/>\n";
}

std::string triangle(double x, double y, double radius, const char* kind) {
  const Points corners = {
      {x, y - 1.2 * radius}, {x - radius, y + radius}, {x + radius, y + radius}};
  return "<polygon" + attribute("class", kind) + attribute("points", place(corners)) + "/>\n";
}

std::string square(double x, double y, double radius, const char* kind) {
  return "<rect" + attribute("class", kind) + attribute("x", pixels(x - radius)) +
         attribute("y", pixels(y - radius)) + attribute("width", pixels(2 * radius)) +
         attribute("height", pixels(2 * radius)) + "/>\n";
}

std::string text(double x, double y, const char* anchor, const char* kind, std::string_view what) {
  return "<text" + attribute("class", kind) + attribute("text-anchor", anchor) +
         attribute("x", pixels(x)) + attribute("y", pixels(y)) + ">" + escaped(what) + "</text>\n";
}

std::string group(const std::string& kind, const std::string& content) {
  return "<g" + attribute("class", kind) + ">\n" + content + "</g>\n";
}

}  // namespace geotherm::bench::svg
