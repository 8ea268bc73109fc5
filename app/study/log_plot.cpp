// SPDX-License-Identifier: MIT
#include "app/study/log_plot.h"

#include <algorithm>
#include <cmath>

#include "app/markup.h"
#include "app/text.h"

namespace geotherm::app {
namespace {

std::string number(double value) { return significant(value, 5); }

/// Of an axis: no powers of ten in letters where digits are as short.
std::string tick_text(double value) {
  return value >= 1 && value < 1e5 ? grouped(std::llround(value)) : significant(value, 2);
}

struct Axis {
  double low, high;  ///< values at the ends
  double from, to;   ///< pixels
  double at(double value) const {
    return from + (to - from) * std::log(value / low) / std::log(high / low);
  }
};

/// 1, 2 and 5 times the powers of ten in a range, or the powers alone where those would be many.
std::vector<double> ticks(double low, double high) {
  const bool few = high / low < 300;
  std::vector<double> out;
  for (int d = static_cast<int>(std::floor(std::log10(low))); std::pow(10.0, d) <= high; ++d) {
    for (const double step : {1.0, 2.0, 5.0}) {
      if (step > 1 && !few) continue;
      const double tick = step * std::pow(10.0, d);
      if (tick >= low * 0.999 && tick <= high * 1.001) out.push_back(tick);
    }
  }
  return out;
}

Axis x_axis(const LogPlot& plot, double from, double to) {
  double low = 0, high = 0;
  for (const Curve& curve : plot.curves) {
    for (const auto& [x, unused] : curve.points) {
      low = low > 0 ? std::min(low, x) : x;
      high = std::max(high, x);
    }
  }
  if (!(low > 0)) low = high = 1;
  if (low == high) return {low / 2, high * 2, from, to};
  return {low, high, from, to};
}

std::string line(double x1, double y1, double x2, double y2, const char* kind) {
  return std::string("<line class=\"") + kind + "\" x1=\"" + number(x1) + "\" y1=\"" + number(y1) +
         "\" x2=\"" + number(x2) + "\" y2=\"" + number(y2) + "\"/>\n";
}

std::string label(double x, double y, const char* anchor, const std::string& text,
                  const char* kind = "soft") {
  return std::string("<text class=\"") + kind + "\" text-anchor=\"" + anchor + "\" x=\"" +
         number(x) + "\" y=\"" + number(y) + "\">" + escaped(text) + "</text>\n";
}

std::string stroke(const Curve& curve) {
  return "stroke=\"" + curve.colour + "\"" +
         (curve.dashes.empty() ? "" : " stroke-dasharray=\"" + curve.dashes + "\"");
}

std::string polyline(const Curve& curve, const Axis& x, const Axis& y) {
  std::string points, dots;
  for (const auto& [a, b] : curve.points) {
    const double height = std::clamp(y.at(b), y.to, y.from);
    points += number(x.at(a)) + "," + number(height) + " ";
    dots += "<circle r=\"2\" fill=\"" + curve.colour + "\" cx=\"" + number(x.at(a)) + "\" cy=\"" +
            number(height) + "\"/>";
  }
  return "<polyline class=\"curve\" " + stroke(curve) + " points=\"" + points + "\"/>\n" + dots +
         "\n";
}

/// A sample of the line before each name.
std::string names(const LogPlot& plot, double x, double y) {
  constexpr double kRow = 17, kSample = 24;
  std::string out;
  for (std::size_t i = 0; i < plot.curves.size(); ++i) {
    const double left = x;
    const double height = y + kRow * static_cast<double>(i);
    out += "<line class=\"curve\" " + stroke(plot.curves[i]) + " x1=\"" + number(left) +
           "\" x2=\"" + number(left + kSample) + "\" y1=\"" + number(height - 4) + "\" y2=\"" +
           number(height - 4) + "\"/>" +
           label(left + kSample + 6, height, "start", plot.curves[i].name, "ink");
  }
  return out;
}

}  // namespace

std::string plot_svg(const LogPlot& plot, double x, double y, double width, double height) {
  const Axis across = x_axis(plot, x, x + width);
  const Axis up{plot.y_low, plot.y_high, y + height, y};
  std::string out = "<g>\n" + label(x, y - 14, "start", plot.title, "title");
  for (const double tick : ticks(up.low, up.high)) {
    out += line(x, up.at(tick), x + width, up.at(tick), "grid") +
           label(x - 7, up.at(tick) + 4, "end", tick_text(100 * tick) + " %");
  }
  for (const double tick : ticks(across.low, across.high)) {
    out += line(across.at(tick), y, across.at(tick), y + height, tick == 1 ? "one" : "grid") +
           label(across.at(tick), y + height + 17, "middle", tick_text(tick));
  }
  out += label(x + width / 2, y + height + 36, "middle", plot.x_label, "ink");
  for (const Curve& curve : plot.curves) out += polyline(curve, across, up);
  return out + names(plot, x, y + height + 60) + "</g>\n";
}

}  // namespace geotherm::app
