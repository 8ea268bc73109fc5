// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// Charts as SVG: panels of curves over logarithmic axes, and bars. Colours, fonts and dashes come
// from one style sheet, which follows the reader's light or dark page. What is called `kind` is one
// or more of its classes.
namespace geotherm::app::chart {

/// The rules of the style sheet: k0 to k5 are colours of curves, d1 to d4 dash them.
std::string_view style();

/// A picture of this size that needs nothing else, on a page of the reader's colour.
std::string page(double width, double height, const std::string& content);

// Elements, as text that ends with a newline. Coordinates are pixels, rounded to a tenth.
// Precondition: they are finite.
std::string text(double x, double y, const char* anchor, const char* kind, std::string_view what);
std::string group(const std::string& kind, const std::string& content);
/// A piece of a curve for a legend.
std::string sample(double x, double y, double length);

/// A logarithmic axis, from values to pixels.
class LogAxis {
 public:
  /// Room for whatever is included later.
  LogAxis(double from, double to) : from_(from), to_(to) {}

  /// Stretches the range. What is not a positive finite number is left out.
  void include(double value);

  /// Nothing was included: there is no place for anything.
  bool empty() const { return !(low_ <= high_); }

  /// Rounds the range outwards to 1, 2 or 5 times a power of ten, and keeps a factor of ten at
  /// least in it. Call before at() and ticks().
  void round_outwards();

  /// Widens the range by this share of its length at each end.
  void pad(double share);

  /// The pixel of a value. Preconditions: !empty(), value > 0.
  double at(double value) const;

  /// Values to write at the axis, ascending: the powers of ten, and between them 3 or 2 and 5 times
  /// those where they are few.
  std::vector<double> ticks() const;

 private:
  double from_, to_;
  double low_ = std::numeric_limits<double>::infinity(), high_ = 0;
};

/// How a point is marked.
enum class Mark { kDot, kSmallDot, kRing, kTriangle, kSquare };
std::string mark_svg(Mark mark, double x, double y);

struct Point {
  double x, y;  ///< left out unless both are positive and finite
  Mark mark = Mark::kDot;
};

/// One colour of a panel: points that are joined, and others beside them.
struct Series {
  std::string kind;
  std::vector<Point> joined = {};  ///< ascending x
  std::vector<Point> beside = {};
  std::string end_label = {};  ///< at the last of the joined points
  std::string name = {};       ///< below the panel, after a sample; empty: none
};

/// Curves over two logarithmic axes.
struct Panel {
  std::string title, x_label;
  std::string (*x_text)(double);  ///< of a tick
  std::string (*y_text)(double);
  std::vector<Series> series = {};
  std::vector<double> y_values = {};  ///< that the axis holds as well: those of the panels beside
  double marked_x = 0;                ///< a dashed line stands there; 0: none
};

struct Box {
  double x, y, width, height;  ///< pixels, of the axes
};

/// The title stands above the box; labels at the ends of curves stand to its right, apart from each
/// other. A panel without a point says that nothing was measured.
std::string panel_svg(const Panel& panel, const Box& box);

/// A row of a bar chart.
struct Bars {
  std::string label, detail;  ///< at the left; the detail in a softer colour
  struct Bar {
    std::string kind;
    double value;  ///< no bar unless positive and finite
    std::string text;
  };
  std::vector<Bar> bars;
};

/// A picture 900 pixels wide, over a logarithmic axis of whole decades; `unit` follows the ticks.
std::string bars_svg(const std::vector<Bars>& rows, const std::string& unit);

}  // namespace geotherm::app::chart
