// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/lines/line_picture.h"
#include "app/lines/visible_lines.h"
#include "app/markup.h"
#include "app/picture/ticks.h"
#include "app/text.h"

namespace geotherm::app {
namespace {

using Colour = std::array<double, 3>;

/// Red near, blue far, and no colour between that a light or a dark surface swallows.
constexpr Colour kNearToFar[] = {{200, 6, 24},  {196, 22, 96}, {158, 40, 150},
                                 {98, 62, 190}, {36, 70, 190}, {16, 36, 130}};

struct Style {
  Colour background, dark_tone, light_tone, contour, text;
  double towards_white;  ///< of the lines
};

Style style_of(PictureBackground background) {
  if (background == PictureBackground::kDark) {
    return {{24, 27, 32}, {44, 50, 58}, {96, 104, 114}, {150, 158, 168}, {226, 230, 235}, 0.45};
  }
  return {{255, 255, 255}, {196, 202, 209}, {246, 247, 249}, {118, 128, 140}, {40, 48, 58}, 0};
}

Colour between(const Colour& a, const Colour& b, double share) {
  Colour out{};
  for (std::size_t k = 0; k < 3; ++k) out[k] = a[k] + share * (b[k] - a[k]);
  return out;
}

std::string text_of(const Colour& c) {
  char text[8];
  const auto byte = [](double x) { return static_cast<unsigned>(std::lround(x)) & 0xFFU; };
  std::snprintf(text, sizeof text, "#%02x%02x%02x", byte(c[0]), byte(c[1]), byte(c[2]));
  return text;
}

Colour colour_at(double share, const Style& style) {
  constexpr double kLast = std::size(kNearToFar) - 1;
  const double at = std::clamp(share, 0.0, 1.0) * kLast;
  const auto i = static_cast<std::size_t>(std::min(at, kLast - 1));
  return between(between(kNearToFar[i], kNearToFar[i + 1], at - static_cast<double>(i)),
                 {255, 255, 255}, style.towards_white);
}

/// The commands of a path; two decimals are a fiftieth of what the eye sees.
std::string commands(const std::vector<Outline>& outlines, bool closed) {
  std::string out;
  for (const Outline& outline : outlines) {
    for (std::size_t i = 0; i < outline.size(); ++i) {
      out += (i == 0 ? 'M' : 'L') + fixed(outline[i].x(), 2) + ' ' + fixed(outline[i].y(), 2);
    }
    if (closed) out += 'Z';
  }
  return out;
}

class SvgDrawing {
 public:
  SvgDrawing(const LinePicture& picture, const PictureSettings& settings, const RayTree& tree)
      : picture_(picture),
        settings_(settings),
        style_(style_of(settings.background)),
        tree_(tree),
        unit_(std::min(settings.width, settings.height) / 720.0),
        view_(*picture.mesh, settings.camera, settings.width, settings.height, 48 * unit_),
        sight_(tree, view_) {}

  Result<LinePictureSvg> draw(const Progress& progress) {
    open();
    auto tones =
        surface_tones(*picture_.mesh, tree_, view_, settings_.width, settings_.height, progress);
    if (!tones) return tones.error();
    draw_surface(*tones);
    draw_lines();
    draw_markers();
    if (picture_.largest_value > 0) draw_bar();
    draw_title();
    return LinePictureSvg{svg_ + "</svg>\n", shows_lines_};
  }

 private:
  void open() {
    const std::string width = std::to_string(settings_.width);
    const std::string height = std::to_string(settings_.height);
    svg_ = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + width + "\" height=\"" + height +
           "\" viewBox=\"0 0 " + width + ' ' + height + "\" stroke-linejoin=\"round\" " +
           "stroke-linecap=\"round\" font-family=\"system-ui, Helvetica, Arial, sans-serif\">\n";
    if (settings_.background == PictureBackground::kTransparent) return;
    svg_ += "<rect width=\"100%\" height=\"100%\" fill=\"" + text_of(style_.background) + "\"/>\n";
  }

  void draw_surface(const std::vector<Tone>& tones) {
    for (const Tone& tone : tones) {
      if (tone.outlines.empty()) continue;
      const Colour fill = between(style_.dark_tone, style_.light_tone, tone.brightness);
      svg_ += "<path fill-rule=\"evenodd\" fill=\"" + text_of(fill) + "\" d=\"" +
              commands(tone.outlines, true) + "\"/>\n";
    }
    const auto contours = visible_contours(*picture_.mesh, sight_, view_);
    if (contours.empty()) return;
    svg_ += "<path fill=\"none\" stroke=\"" + text_of(style_.contour) + "\" stroke-width=\"" +
            fixed(0.9 * unit_, 2) + "\" d=\"" + commands(contours, false) + "\"/>\n";
  }

  void draw_lines() {
    const bool valued = picture_.largest_value > 0;
    const double width = (valued ? 1.6 : 3.2) * unit_;
    for (const Polyline& line : picture_.lines) {
      const auto points = positions_of(*picture_.mesh, *line.path);
      const auto parts = sight_.visible_parts(points);
      if (parts.empty()) continue;
      shows_lines_ = true;
      const double share = valued ? line.value.value_or(0) / picture_.largest_value : 0;
      const std::string d = commands(parts, false);
      if (!valued) stroke(d, style_.background, 2 * width);  // a rim sets it off
      stroke(d, colour_at(share, style_), width);
    }
  }

  void stroke(const std::string& d, const Colour& colour, double width) {
    svg_ += "<path fill=\"none\" stroke=\"" + text_of(colour) + "\" stroke-width=\"" +
            fixed(width, 2) + "\" d=\"" + d + "\"/>\n";
  }

  void draw_markers() {
    for (const Vec3& marker : picture_.markers) {
      if (!sight_.sees(marker)) continue;
      const auto at = view_.project(marker);
      svg_ += "<circle cx=\"" + fixed(at.x(), 2) + "\" cy=\"" + fixed(at.y(), 2) + "\" r=\"" +
              fixed(5 * unit_, 2) + "\" fill=\"" + text_of(style_.text) + "\" stroke=\"" +
              text_of(style_.background) + "\" stroke-width=\"" + fixed(1.5 * unit_, 2) + "\"/>\n";
    }
  }

  void write(double x, double y, const std::string& text, const char* anchor) {
    svg_ += "<text x=\"" + fixed(x, 1) + "\" y=\"" + fixed(y, 1) + "\" font-size=\"" +
            fixed(13 * unit_, 1) + "\" text-anchor=\"" + anchor + "\" fill=\"" +
            text_of(style_.text) + "\">" + escaped(one_line(text)) + "</text>\n";
  }

  /// The colours of the distances, 0 at the bottom.
  void draw_bar() {
    const double right = settings_.width - 24 * unit_, wide = 12 * unit_;
    const double bottom = 0.85 * settings_.height, top = 0.15 * settings_.height;
    svg_ += "<linearGradient id=\"distance\" x1=\"0\" y1=\"1\" x2=\"0\" y2=\"0\">";
    constexpr int kStops = 10;
    for (int i = 0; i <= kStops; ++i) {
      const double share = i / static_cast<double>(kStops);
      svg_ += "<stop offset=\"" + fixed(share, 2) + "\" stop-color=\"" +
              text_of(colour_at(share, style_)) + "\"/>";
    }
    svg_ += "</linearGradient>\n<rect x=\"" + fixed(right - wide, 1) + "\" y=\"" + fixed(top, 1) +
            "\" width=\"" + fixed(wide, 1) + "\" height=\"" + fixed(bottom - top, 1) +
            "\" fill=\"url(#distance)\"/>\n";
    const Ticks ticks = make_ticks(0, picture_.largest_value, 8);
    for (std::size_t i = 0; i < ticks.values.size(); ++i) {
      const double y = bottom - (bottom - top) * ticks.values[i] / picture_.largest_value;
      write(right - wide - 6 * unit_, y + 4.5 * unit_, ticks.labels[i], "end");
    }
    write(right, top - 10 * unit_, "distance", "end");
  }

  void draw_title() { write(16 * unit_, settings_.height - 14 * unit_, picture_.title, "start"); }

  const LinePicture& picture_;
  const PictureSettings& settings_;
  Style style_;
  const RayTree& tree_;
  double unit_;  // of what has a size on paper
  LineView view_;
  LineSight sight_;
  std::string svg_;
  bool shows_lines_ = false;
};

}  // namespace

Result<LinePictureSvg> line_picture_svg(const LinePicture& picture, const PictureSettings& settings,
                                        const Progress& progress) {
  const auto tree = RayTree::build(picture.mesh, progress);
  if (!tree) return tree.error();
  return SvgDrawing(picture, settings, *tree).draw(progress);
}

}  // namespace geotherm::app
