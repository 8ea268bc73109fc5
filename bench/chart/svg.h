// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace geotherm::bench {

/// The few elements of SVG that a chart is made of, as text that ends with a newline. `kind` is a
/// class of the style sheet. Coordinates are rounded to a tenth of a pixel. Preconditions: they are
/// finite.
namespace svg {

using Points = std::vector<std::pair<double, double>>;

/// &, <, > and double quotes as entities.
std::string escaped(std::string_view text);

std::string line(double x1, double y1, double x2, double y2, const char* kind);
std::string polyline(const Points& points, const char* kind);
std::string circle(double x, double y, double radius, const char* kind);
std::string triangle(double x, double y, double radius, const char* kind);
std::string square(double x, double y, double radius, const char* kind);
/// `anchor`: start, middle or end.
std::string text(double x, double y, const char* anchor, const char* kind, std::string_view what);
std::string group(const std::string& kind, const std::string& content);

}  // namespace svg
}  // namespace geotherm::bench
