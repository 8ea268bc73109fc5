// SPDX-License-Identifier: MIT
#include "app/picture/chart.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>

#include "app/text/text.h"

namespace geotherm::app::chart {
namespace {

// Colours that people with any kind of colour blindness tell apart (Okabe, Ito 2002), darker on
// white and lighter on black than there, so that thin lines stand out.
constexpr std::string_view kStyle = R"(
svg text { font: 13px system-ui, -apple-system, "Segoe UI", "Helvetica Neue", Arial, sans-serif;
  fill: #1c2733 }
.page { fill: #ffffff } svg .soft { fill: #5d6b7c; font-size: 12px }
svg .head { font-size: 20px; font-weight: 600 } svg .title { font-size: 15px; font-weight: 600 }
.grid { stroke: #e4e9ee } .axis { stroke: #8e9aa8 }
.marked { stroke: #8e9aa8; stroke-dasharray: 3 3 }
.curve { fill: none; stroke: currentColor; stroke-width: 2; stroke-linejoin: round }
.dot, .bar { fill: currentColor }
.hollow { fill: none; stroke: currentColor; stroke-width: 1.4; opacity: 0.7 }
svg .end { fill: currentColor; font-weight: 600; stroke: #ffffff; stroke-width: 4;
  paint-order: stroke; stroke-linejoin: round }
.d1 .curve { stroke-dasharray: 7 4 } .d2 .curve { stroke-dasharray: 2 3 }
.d3 .curve { stroke-dasharray: 9 3 2 3 } .d4 .curve { stroke-dasharray: 1 5 }
.base { color: #6b7684 } .base .curve { stroke-dasharray: 6 4 } .any { color: #1c2733 }
.k0 { color: #0068a8 } .k1 { color: #c94f00 } .k2 { color: #008561 } .k3 { color: #a8447f }
.k4 { color: #9a6a00 } .k5 { color: #2a93c9 }
@media (prefers-color-scheme: dark) {
  svg text { fill: #e3e8ee } .page { fill: #14191f } svg .soft { fill: #9aa7b5 }
  .grid { stroke: #28313b } .axis, .marked { stroke: #6b7684 }
  svg .end { fill: currentColor; stroke: #14191f }
  .base { color: #9aa7b5 } .any { color: #e3e8ee }
  .k0 { color: #5cb4ee } .k1 { color: #f58a45 } .k2 { color: #2fc79c } .k3 { color: #e592c3 }
  .k4 { color: #e8b53c } .k5 { color: #a3d9f7 }
}
)";

/// Rounding of powers must not lose a tick at an end.
constexpr double kSlack = 1e-9;

constexpr double kLineHeight = 15;  // of labels
constexpr double kGap = 9;          // between a curve's end and its label
constexpr double kLetterWidth = 7;  // about

using Places = std::vector<std::pair<double, double>>;

std::string pixels(double value) {
  assert(std::isfinite(value));
  return fixed(value, 1);
}

std::string attribute(const char* name, const std::string& value) {
  return std::string(" ") + name + "=\"" + value + "\"";
}

std::string places(const Places& points) {
  std::string out;
  for (const auto& [x, y] : points) {
    if (!out.empty()) out += ' ';
    out += pixels(x) + "," + pixels(y);
  }
  return out;
}

std::string line(double x1, double y1, double x2, double y2, const char* kind) {
  return "<line" + attribute("class", kind) + attribute("x1", pixels(x1)) +
         attribute("y1", pixels(y1)) + attribute("x2", pixels(x2)) + attribute("y2", pixels(y2)) +
         "/>\n";
}

std::string polyline(const Places& points, const char* kind) {
  return "<polyline" + attribute("class", kind) + attribute("points", places(points)) + "/>\n";
}

std::string circle(double x, double y, double radius, const char* kind) {
  return "<circle" + attribute("class", kind) + attribute("cx", pixels(x)) +
         attribute("cy", pixels(y)) + attribute("r", pixels(radius)) + "/>\n";
}

std::string rectangle(double x, double y, double width, double height, const char* kind) {
  return "<rect" + attribute("class", kind) + attribute("x", pixels(x)) +
         attribute("y", pixels(y)) + attribute("width", pixels(width)) +
         attribute("height", pixels(height)) + "/>\n";
}

/// The next of 1, 2 and 5 times the powers of ten, downwards or upwards.
double round_number(double value, bool up) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  double best = up ? 10 * power : power;
  for (const double step : {1.0, 2.0, 5.0}) {
    const double candidate = step * power;
    if (up && candidate >= value * (1 - kSlack)) return candidate;
    if (!up && candidate <= value * (1 + kSlack)) best = candidate;
  }
  return best;
}

std::vector<double> multiples(std::vector<double> steps, double low, double high) {
  std::vector<double> out;
  const int last = static_cast<int>(std::ceil(std::log10(high)));
  for (int d = static_cast<int>(std::floor(std::log10(low))); d <= last; ++d) {
    for (const double step : steps) {
      const double tick = step * std::pow(10.0, d);
      if (tick >= low * (1 - kSlack) && tick <= high * (1 + kSlack)) out.push_back(tick);
    }
  }
  return out;
}

bool has_place(const Point& p) {
  return p.x > 0 && std::isfinite(p.x) && p.y > 0 && std::isfinite(p.y);
}

struct Axes {
  LogAxis x, y;
};

Axes axes_of(const Panel& panel, const Box& box) {
  Axes axes{{box.x, box.x + box.width}, {box.y + box.height, box.y}};
  for (const Series& series : panel.series) {
    for (const auto* points : {&series.joined, &series.beside}) {
      for (const Point& p : *points) {
        if (!has_place(p)) continue;
        axes.x.include(p.x);
        axes.y.include(p.y);
      }
    }
  }
  if (!axes.x.empty()) {
    for (const double y : panel.y_values) axes.y.include(y);
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
    out += line(box.x, y, right, y, "grid") +
           text(box.x - 8, y + 4, "end", "soft", panel.y_text(tick));
  }
  for (const double tick : axes.x.ticks()) {
    const double x = axes.x.at(tick);
    out += line(x, box.y, x, bottom, tick == panel.marked_x ? "marked" : "grid") +
           text(x, bottom + 18, "middle", "soft", panel.x_text(tick));
  }
  return out + line(box.x, bottom, right, bottom, "axis") +
         text(box.x + box.width / 2, bottom + 38, "middle", "soft", panel.x_label);
}

std::string curve(const Series& series, const Axes& axes) {
  Places joined;
  std::string marks;
  for (const Point& p : series.beside) {
    if (has_place(p)) marks += mark_svg(p.mark, axes.x.at(p.x), axes.y.at(p.y));
  }
  for (const Point& p : series.joined) {
    if (!has_place(p)) continue;
    joined.emplace_back(axes.x.at(p.x), axes.y.at(p.y));
    marks += mark_svg(p.mark, joined.back().first, joined.back().second);
  }
  return (joined.size() > 1 ? polyline(joined, "curve") : std::string()) + marks;
}

struct Label {
  const Series* series;
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

/// Curves that end at the right have their labels in one column; others beside their end, in a
/// column with those that end there, too, or with those at the right where they reach as far.
std::string end_labels(const Panel& panel, const Axes& axes, const Box& box) {
  std::map<double, std::vector<Label>> columns;
  const double right = box.x + box.width;
  for (const Series& series : panel.series) {
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
      out += group(label.series->kind,
                   text(label.x, label.y + 4, "start", "end", label.series->end_label));
    }
  }
  return out;
}

/// The names of the curves, below the panel.
std::string names(const Panel& panel, double x, double y) {
  constexpr double kRow = 18, kSample = 24;
  std::string out;
  for (const Series& series : panel.series) {
    if (series.name.empty()) continue;
    out += group(series.kind, sample(x, y - 4, kSample)) +
           text(x + kSample + 6, y, "start", "name", series.name);
    y += kRow;
  }
  return out;
}

}  // namespace

std::string_view style() { return kStyle; }

std::string page(double width, double height, const std::string& content) {
  const std::string w = fixed(width, 0), h = fixed(height, 0);
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + w + "\" height=\"" + h +
         "\" viewBox=\"0 0 " + w + " " + h + "\">\n<style>" + std::string(kStyle) +
         "</style>\n<rect class=\"page\" width=\"100%\" height=\"100%\"/>\n" + content + "</svg>\n";
}

std::string text(double x, double y, const char* anchor, const char* kind, std::string_view what) {
  return "<text" + attribute("class", kind) + attribute("text-anchor", anchor) +
         attribute("x", pixels(x)) + attribute("y", pixels(y)) + ">" + escaped(what) + "</text>\n";
}

std::string group(const std::string& kind, const std::string& content) {
  return "<g" + attribute("class", kind) + ">\n" + content + "</g>\n";
}

std::string sample(double x, double y, double length) { return line(x, y, x + length, y, "curve"); }

void LogAxis::include(double value) {
  if (!(value > 0) || !std::isfinite(value)) return;
  low_ = std::min(low_, value);
  high_ = std::max(high_, value);
}

void LogAxis::round_outwards() {
  if (empty()) return;
  low_ = round_number(low_, false);
  high_ = round_number(high_, true);
  while (high_ < 10 * low_ * (1 - kSlack)) {
    low_ = round_number(low_ * 0.99, false);
    high_ = round_number(high_ * 1.01, true);
  }
}

void LogAxis::pad(double share) {
  if (empty()) return;
  const double factor = high_ > low_ ? std::pow(high_ / low_, share) : 2;
  low_ /= factor;
  high_ *= factor;
}

double LogAxis::at(double value) const {
  return from_ + (to_ - from_) * std::log(value / low_) / std::log(high_ / low_);
}

std::vector<double> LogAxis::ticks() const {
  if (empty()) return {};
  const double decades = std::log10(high_ / low_);
  if (decades < 1.6) return multiples({1, 2, 5}, low_, high_);
  return multiples(decades < 3.2 ? std::vector{1.0, 3.0} : std::vector{1.0}, low_, high_);
}

std::string mark_svg(Mark mark, double x, double y) {
  constexpr double kSize = 3.4, kSmall = 2.2;
  switch (mark) {
    case Mark::kRing:
      return circle(x, y, kSize, "hollow");
    case Mark::kTriangle: {
      const Places corners = {{x, y - 1.2 * kSize}, {x - kSize, y + kSize}, {x + kSize, y + kSize}};
      return "<polygon" + attribute("class", "hollow") + attribute("points", places(corners)) +
             "/>\n";
    }
    case Mark::kSquare:
      return rectangle(x - kSize + 0.4, y - kSize + 0.4, 2 * kSize - 0.8, 2 * kSize - 0.8,
                       "hollow");
    default:
      return circle(x, y, mark == Mark::kSmallDot ? kSmall : kSize, "dot");
  }
}

std::string panel_svg(const Panel& panel, const Box& box) {
  const Axes axes = axes_of(panel, box);
  std::string out = text(box.x, box.y - 16, "start", "title", panel.title);
  if (axes.x.empty()) {
    return out +
           text(box.x + box.width / 2, box.y + box.height / 2, "middle", "soft", "not measured");
  }
  out += grid(panel, axes, box);
  for (const Series& series : panel.series) out += group(series.kind, curve(series, axes));
  return out + end_labels(panel, axes, box) + names(panel, box.x, box.y + box.height + 64);
}

std::string bars_svg(const std::vector<Bars>& rows, const std::string& unit) {
  constexpr double kLeft = 190, kRight = 840, kTop = 26, kRow = 30, kBar = 9;
  double low = 1, high = 10;
  for (const Bars& row : rows) {
    for (const Bars::Bar& bar : row.bars) {
      if (!(bar.value > 0) || !std::isfinite(bar.value)) continue;
      low = std::min(low, bar.value);
      high = std::max(high, bar.value);
    }
  }
  LogAxis axis(kLeft, kRight);
  axis.include(std::pow(10.0, std::floor(std::log10(low))));
  axis.include(std::pow(10.0, std::ceil(std::log10(high))));
  const double height = kTop + kRow * static_cast<double>(rows.size()) + 6;
  std::string out = "<svg viewBox=\"0 0 900 " + fixed(height, 0) + "\" role=\"img\">\n";
  for (const double tick : axis.ticks()) {
    const std::string label = tick < 1 ? significant(tick) : grouped(std::llround(tick));
    out += line(axis.at(tick), 18, axis.at(tick), height, "grid") +
           text(axis.at(tick), 12, "middle", "soft", label + unit);
  }
  double y = kTop;
  for (const Bars& row : rows) {
    out += "<text text-anchor=\"end\"" + attribute("x", pixels(kLeft - 10)) +
           attribute("y", pixels(y + 14)) + ">" + escaped(row.label) + " <tspan class=\"soft\">" +
           escaped(row.detail) + "</tspan></text>\n";
    double top = y;
    for (const Bars::Bar& bar : row.bars) {
      if (bar.value > 0 && std::isfinite(bar.value)) {
        const double end = std::max(axis.at(bar.value), kLeft + 1);
        out += group(bar.kind, rectangle(kLeft, top, end - kLeft, kBar, "bar")) +
               text(end + 5, top + kBar, "start", "soft", bar.text);
      }
      top += kBar + 2;
    }
    y += kRow;
  }
  return out + "</svg>\n";
}

}  // namespace geotherm::app::chart
