// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace geotherm::app {

/// One line of a plot.
struct Curve {
  std::string name;
  std::string colour;                             ///< as CSS
  std::string dashes;                             ///< stroke-dasharray; empty: solid
  std::vector<std::pair<double, double>> points;  ///< both above 0; ascending x
};

/// Curves over logarithmic axes. Everything is drawn with text and lines of SVG.
struct LogPlot {
  std::string title, x_label;
  double y_low = 1e-3, y_high = 1;  ///< shares; labelled in per cent
  std::vector<Curve> curves;
};

/// The plot as a group whose axes' box is `width` x `height` at (x, y); title above, x label, ticks
/// and the curves' names below.
std::string plot_svg(const LogPlot& plot, double x, double y, double width, double height);

}  // namespace geotherm::app
