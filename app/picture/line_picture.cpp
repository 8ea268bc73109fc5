// SPDX-License-Identifier: MIT
#include "app/picture/line_picture.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <span>
#include <vector>

#include "app/picture/line_sight.h"
#include "app/picture/picture_scale.h"
#include "app/picture/picture_text.h"
#include "app/picture/surface_tones.h"
#include "app/text/text.h"
#include "geotherm/error.h"
#include "geotherm/path.h"
#include "geotherm/progress.h"
#include "solver/mesh/ray_tree.h"

namespace geotherm::app {
namespace {

using Colour = std::array<double, 3>;

/// Red near, blue far, and no colour between that a light or a dark surface swallows.
constexpr Colour kNearToFar[] = {{200, 6, 24},  {196, 22, 96}, {158, 40, 150},
                                 {98, 62, 190}, {36, 70, 190}, {16, 36, 130}};

/// On the two sides of 0, from it on: blue below, red above.
constexpr Colour kBelowZero[] = {{88, 140, 220}, {36, 84, 190}, {14, 32, 110}};
constexpr Colour kAboveZero[] = {{236, 130, 70}, {206, 48, 36}, {120, 6, 24}};

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

Colour colour_at(double share, std::span<const Colour> colours, const Style& style) {
  const auto last = static_cast<double>(colours.size() - 1);
  const double at = std::clamp(share, 0.0, 1.0) * last;
  const auto i = static_cast<std::size_t>(std::min(at, last - 1));
  return between(between(colours[i], colours[i + 1], at - static_cast<double>(i)), {255, 255, 255},
                 style.towards_white);
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

CameraSettings camera_for(const LinePicture& picture, CameraSettings camera) {
  if (camera.up == UpAxis::kAuto) camera.up = picture.up;
  return camera;
}

class SvgDrawing {
 public:
  SvgDrawing(const LinePicture& picture, const PictureSettings& settings, const RayTree& tree)
      : picture_(picture),
        settings_(settings),
        style_(style_of(settings.background)),
        tree_(tree),
        unit_(std::min(settings.width, settings.height) / 720.0),
        view_(*picture.mesh, camera_for(picture, settings.camera), settings.width, settings.height,
              48 * unit_),
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
    // Units of CSS, in which an inch has 96 pixels, whatever the lines are drawn with.
    const std::string size = size_text(settings_);
    const std::size_t between = size.find('x');
    svg_ = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + size.substr(0, between) +
           "\" height=\"" + size.substr(between + 1) + "\" viewBox=\"0 0 " + width + ' ' + height +
           "\" stroke-linejoin=\"round\" " +
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
    const double width = (valued ? 1 : 2) * line_width();
    for (const Polyline& line : picture_.lines) {
      const auto points = positions_of(*picture_.mesh, *line.path);
      const Colour colour = valued && !line.value ? style_.text : colour_of(line.value.value_or(0));
      if (!valued && picture_.shows_hidden) {
        draw_hidden(sight_.parts(points, false), colour, width);
      }
      const auto parts = sight_.parts(points, true);
      if (parts.empty()) continue;
      shows_lines_ = true;
      const std::string d = commands(parts, false);
      if (!valued) stroke(d, style_.background, 2 * width);  // a rim sets it off
      stroke(d, colour, (valued && !line.value ? 2 : 1) * width);
    }
  }

  Colour colour_of(double value) const {
    const double least = picture_.least_value, largest = picture_.largest_value;
    if (!(least < 0)) {
      return colour_at(largest > 0 ? value / largest : 0, kNearToFar, style_);
    }
    return colour_at(std::abs(value) / std::max(-least, largest),
                     value < 0 ? kBelowZero : kAboveZero, style_);
  }

  /// What the surface hides of a path: dashes, thinner and fainter.
  void draw_hidden(const std::vector<Outline>& parts, const Colour& colour, double width) {
    if (parts.empty()) return;
    svg_ += "<g stroke-dasharray=\"" + fixed(6 * unit_, 2) + ' ' + fixed(5 * unit_, 2) +
            "\" stroke-linecap=\"butt\" stroke-opacity=\"0.6\">\n";
    stroke(commands(parts, false), colour, 0.6 * width);
    svg_ += "</g>\n";
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
            fixed(text_size(), 1) + "\" text-anchor=\"" + anchor + "\" fill=\"" +
            text_of(style_.text) + "\">" + escaped(one_line(text)) + "</text>\n";
  }

  /// The colours of the distances, the least at the bottom.
  void draw_bar() {
    const double least = picture_.least_value, range = picture_.largest_value - least;
    const double right = settings_.width - 24 * unit_, wide = 12 * unit_;
    const double bottom = 0.85 * settings_.height, top = 0.15 * settings_.height;
    svg_ += "<linearGradient id=\"distance\" x1=\"0\" y1=\"1\" x2=\"0\" y2=\"0\">";
    const auto stop = [&](double value, const Colour& colour) {
      svg_ += "<stop offset=\"" + fixed((value - least) / range, 3) + "\" stop-color=\"" +
              text_of(colour) + "\"/>";
    };
    constexpr int kStops = 10;
    const double most = std::max(-least, picture_.largest_value);
    if (least < 0) {
      stop(least, colour_of(least));
      for (int i = kStops - 1; i > 0; --i) {
        if (-i * most / kStops > least) stop(-i * most / kStops, colour_of(-i * most / kStops));
      }
      stop(0, colour_at(0, kBelowZero, style_));
    }
    for (int i = 0; i <= kStops; ++i) {
      const double value = picture_.largest_value * i / kStops;
      stop(value, colour_of(value));
    }
    svg_ += "</linearGradient>\n<rect x=\"" + fixed(right - wide, 1) + "\" y=\"" + fixed(top, 1) +
            "\" width=\"" + fixed(wide, 1) + "\" height=\"" + fixed(bottom - top, 1) +
            "\" fill=\"url(#distance)\"/>\n";
    Ticks ticks = make_ticks(least, picture_.largest_value, 8);
    format_labels(ticks, settings_.number_format);
    for (std::size_t i = 0; i < ticks.values.size(); ++i) {
      const double y = bottom - (bottom - top) * (ticks.values[i] - least) / range;
      write(right - wide - 6 * unit_, y + 0.35 * text_size(), ticks.labels[i], "end");
    }
    PictureData named;
    named.value_title = "distance";
    write(right, top - 10 * unit_, bar_title(named, settings_), "end");
  }

  void draw_title() {
    write(16 * unit_, settings_.height - 14 * unit_, picture_.title, "start");
    if (settings_.title.empty()) return;
    write(0.5 * settings_.width, 14 * unit_ + text_size(), settings_.title, "middle");
  }

  /// The width of isolines; paths are twice as wide.
  double line_width() const {
    if (!settings_.line_width && !settings_.paper) return 1.6 * unit_;
    return pixels_of(settings_.line_width.value_or(kLinesOnPaper), settings_);
  }

  double text_size() const {
    if (!settings_.text_size && !settings_.paper) return 13 * unit_;
    return pixels_of(settings_.text_size.value_or(kTextOnPaper), settings_);
  }

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
