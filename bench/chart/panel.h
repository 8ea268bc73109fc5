// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace geotherm::bench {

/// How a point of a chart is marked.
enum class Mark { kDot, kRing, kTriangle, kSquare };

struct PanelPoint {
  double x, y;  ///< left out unless both are positive and finite
  Mark mark = Mark::kDot;
};

/// One colour of a panel: points of the meshes that are joined, and others beside them.
struct PanelSeries {
  std::string kind;                     ///< class of the style sheet that gives the colour
  std::vector<PanelPoint> joined = {};  ///< ascending x
  std::vector<PanelPoint> beside = {};
  std::string end_label = {};  ///< at the last of the joined points
};

/// One logarithmic plot.
struct Panel {
  std::string title, x_label;
  std::string (*x_text)(double);  ///< of a tick
  std::string (*y_text)(double);
  std::vector<PanelSeries> series;
};

struct Box {
  double x, y, width, height;  ///< pixels, of the axes
};

/// The panel as SVG. Labels at the ends of lines stand to the right of the box, apart from each
/// other. A panel without a point says that nothing was measured.
std::string panel_svg(const Panel& panel, const Box& box);

/// A mark alone, for a legend.
std::string mark_svg(Mark mark, double x, double y);

}  // namespace geotherm::bench
