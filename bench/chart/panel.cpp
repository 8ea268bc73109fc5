// SPDX-License-Identifier: MIT
#include "bench/chart/panel.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "bench/chart/log_axis.h"
#include "bench/chart/svg.h"

namespace geotherm::bench {
namespace {

constexpr double kLineHeight = 15;  // of labels
constexpr double kGap = 9;          // between a line's end and its label
constexpr double kLetterWidth = 7;  // about

bool has_place(const PanelPoint& p) {
  return p.x > 0 && std::isfinite(p.x) && p.y > 0 && std::isfinite(p.y);
}

struct Axes {
  LogAxis x, y;
};

Axes axes_of(const Panel& panel, const Box& box) {
  Axes axes{{box.x, box.x + box.width}, {box.y + box.height, box.y}};
  for (const PanelSeries& series : panel.series) {
    for (const auto* points : {&series.joined, &series.beside}) {
      for (const PanelPoint& p : *points) {
        if (!has_place(p)) continue;
        axes.x.include(p.x);
        axes.y.include(p.y);
      }
    }
  }
  axes.x.pad(0.04);
  axes.y.round_outwards();
  return axes;
}

std::string grid(const Panel& panel, const Axes& axes, const Box& box) {
  std::string out;
  const double right = box.x + box.width, bottom = box.y + box.height;
  for (const double tick : axes.y.ticks()) {
    const double y = axes.y.at(tick);
    out += svg::line(box.x, y, right, y, "grid") +
           svg::text(box.x - 8, y + 4, "end", "soft", panel.y_text(tick));
  }
  for (const double tick : axes.x.ticks()) {
    const double x = axes.x.at(tick);
    out += svg::line(x, box.y, x, bottom, "grid") +
           svg::text(x, bottom + 18, "middle", "soft", panel.x_text(tick));
  }
  return out + svg::line(box.x, bottom, right, bottom, "axis") +
         svg::text(box.x + box.width / 2, bottom + 38, "middle", "soft", panel.x_label);
}

std::string curve(const PanelSeries& series, const Axes& axes) {
  svg::Points line;
  std::string marks;
  for (const PanelPoint& p : series.beside) {
    if (has_place(p)) marks += mark_svg(p.mark, axes.x.at(p.x), axes.y.at(p.y));
  }
  for (const PanelPoint& p : series.joined) {
    if (!has_place(p)) continue;
    line.emplace_back(axes.x.at(p.x), axes.y.at(p.y));
    marks += mark_svg(p.mark, line.back().first, line.back().second);
  }
  return (line.size() > 1 ? svg::polyline(line, "curve") : std::string()) + marks;
}

struct Label {
  const PanelSeries* series;
  double x, y, wanted_y;
};

/// Pushes labels that stand above each other apart, and back into the box.
void spread(std::vector<Label>& labels, const Box& box) {
  std::ranges::sort(labels, {}, &Label::wanted_y);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    labels[i].y = labels[i].wanted_y;
    if (i > 0) labels[i].y = std::max(labels[i].y, labels[i - 1].y + kLineHeight);
  }
  double lowest = box.y + box.height + kLineHeight / 2;
  for (std::size_t i = labels.size(); i-- > 0; lowest -= kLineHeight) {
    labels[i].y = std::min(labels[i].y, lowest);
    lowest = std::min(lowest, labels[i].y);
  }
}

/// Lines that end at the right have their labels in one column; others beside their end, in a
/// column with those that end there, too, or with those at the right where they reach as far.
std::string end_labels(const Panel& panel, const Axes& axes, const Box& box) {
  std::map<double, std::vector<Label>> columns;
  const double right = box.x + box.width;
  for (const PanelSeries& series : panel.series) {
    const auto last = std::find_if(series.joined.rbegin(), series.joined.rend(), has_place);
    if (last == series.joined.rend() || series.end_label.empty()) continue;
    const double x = axes.x.at(last->x), y = axes.y.at(last->y);
    const double at = (x > right - 0.1 * box.width ? right : x) + kGap;
    const double end = at + kLetterWidth * static_cast<double>(series.end_label.size());
    columns[end > right ? right + kGap : at].push_back({&series, at, y, y});
  }
  std::string out;
  for (auto& [x, column] : columns) {
    spread(column, box);
    for (const Label& label : column) {
      out += svg::group(label.series->kind,
                        svg::text(label.x, label.y + 4, "start", "end", label.series->end_label));
    }
  }
  return out;
}

}  // namespace

std::string mark_svg(Mark mark, double x, double y) {
  constexpr double kSize = 3.4;
  switch (mark) {
    case Mark::kRing:
      return svg::circle(x, y, kSize, "hollow");
    case Mark::kTriangle:
      return svg::triangle(x, y, kSize, "hollow");
    case Mark::kSquare:
      return svg::square(x, y, kSize - 0.4, "hollow");
    default:
      return svg::circle(x, y, kSize, "dot");
  }
}

std::string panel_svg(const Panel& panel, const Box& box) {
  const Axes axes = axes_of(panel, box);
  std::string out = svg::text(box.x, box.y - 16, "start", "title", panel.title);
  if (axes.x.empty()) {
    return out + svg::text(box.x + box.width / 2, box.y + box.height / 2, "middle", "soft",
                           "not measured");
  }
  out += grid(panel, axes, box);
  for (const PanelSeries& series : panel.series) {
    out += svg::group(series.kind, curve(series, axes));
  }
  return out + end_labels(panel, axes, box);
}

}  // namespace geotherm::bench
