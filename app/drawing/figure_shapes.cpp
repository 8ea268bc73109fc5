// SPDX-License-Identifier: MIT
#include "app/drawing/figure_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "app/picture/picture_scale.h"
#include "engine/scene/line_set.h"
#include "geotherm/path.h"

namespace geotherm::app {
namespace {

using Eigen::Vector2d;

/// Between places where it is asked whether a line is seen, scene units.
constexpr double kStep = 0.01;
/// A point of a line is left out where that moves the line by less than this, in pixels.
constexpr float kShapeTolerance = 0.05F;

Vec3 to_vec3(const PictureData::Vector& v) { return {v[0], v[1], v[2]}; }

Figure::Colour to_colour(const glm::vec3& c, float alpha = 1) { return {c.r, c.g, c.b, alpha}; }
Figure::Colour to_colour(const glm::vec4& c) { return {c.r, c.g, c.b, c.a}; }

/// Those that the renderer draws: on a colour map none lies beyond its ends.
std::vector<double> isoline_levels(const engine::SurfaceStyle& style, double largest) {
  std::vector<double> levels(style.levels.begin(), style.levels.end());
  constexpr double kMaxLines = 1e5;
  if (levels.empty() && style.line_spacing > 0 && largest / style.line_spacing <= kMaxLines) {
    for (double i = 1; i * style.line_spacing <= largest; ++i) {
      levels.push_back(i * style.line_spacing);
    }
  }
  if (style.paint != engine::Paint::kMap) return levels;
  const double low = std::min(style.range_min, style.range_max);
  const double high = std::max(style.range_min, style.range_max);
  std::erase_if(levels, [low, high](double level) { return level < low || level > high; });
  return levels;
}

/// With points in between, so that none of its pieces is longer than kStep.
std::vector<Vec3> refined_line(std::span<const Vec3> points) {
  std::vector<Vec3> out;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i > 0) {
      const Vec3 way = points[i] - points[i - 1];
      const auto pieces = static_cast<int>(std::ceil(std::min(way.norm() / kStep, 1000.0)));
      for (int k = 1; k < pieces; ++k) out.push_back(points[i - 1] + way * k / pieces);
    }
    out.push_back(points[i]);
  }
  return out;
}

/// Without points that pixels do not resolve.
std::vector<Outline> thinned(const std::vector<Outline>& parts) {
  std::vector<Outline> out;
  for (const Outline& part : parts) {
    std::vector<glm::vec3> points;
    for (const Vector2d& p : part) points.emplace_back(p.x(), p.y(), 0);
    out.emplace_back();
    for (const glm::vec3& p : engine::simplified(points, kShapeTolerance)) {
      out.back().emplace_back(p.x, p.y);
    }
  }
  return out;
}

LineSight::View view_of(const engine::Camera& camera) {
  const auto to_scene = [](const Vec3& p) {
    return glm::vec3(static_cast<float>(p.x()), static_cast<float>(p.y()),
                     static_cast<float>(p.z()));
  };
  const auto project = [camera, to_scene](const Vec3& p) {
    const glm::vec3 at = camera.project(to_scene(p));
    return Vector2d(at.x, at.y);
  };
  const auto ray_to = [camera, to_scene](const Vec3& p) {
    constexpr double kOutside = 4;
    const glm::vec3 back = camera.to_eye(to_scene(p));
    double far = kOutside;
    if (!camera.orthographic) far = glm::length(glm::vec3(camera.view * glm::vec4(to_scene(p), 1)));
    const Vec3 way = far * Vec3(back.x, back.y, back.z);
    return LineView::Ray{p + way, -way};
  };
  return {ray_to, project, 1};
}

/// Strokes of a picture, in the order in which they are drawn.
class Strokes {
 public:
  Strokes(const LineSight& sight, const engine::Scene& scene) : sight_(sight), scene_(scene) {}

  void add_isoline(std::span<const Vec3> points) {
    add(sight_.parts(points, true), to_colour(scene_.surface.line_colour),
        scene_.surface.line_width * scene_.pixel_scale);
  }

  void add_line(const PictureData::Line& line) {
    std::vector<glm::vec3> points;
    for (const auto& [x, y, z] : line.points) points.emplace_back(x, y, z);
    const glm::vec3 colour(line.colour[0], line.colour[1], line.colour[2]);
    for (const auto& run : engine::finite_runs(points)) {
      std::vector<Vec3> own;
      for (const glm::vec3& p : run) own.emplace_back(p.x, p.y, p.z);
      const std::vector<Vec3> fine = refined_line(own);
      add_with_rim(sight_.parts(fine, false), colour, true);
      add_with_rim(sight_.parts(fine, true), colour, false);
    }
  }

  /// Each is hidden or seen as a whole; what overlaps is drawn at once. Pieces of curves are half
  /// as wide as points.
  void add_markers(std::span<const PictureData::Segment> markers) {
    const engine::MarkerStyle& style = scene_.markers;
    std::array<std::vector<Outline>, 4> parts;  // pieces of curves, points: hidden; the same: seen
    for (const PictureData::Segment& marker : markers) {
      const Vec3 ends[] = {to_vec3(marker.from), to_vec3(marker.to)};
      const std::size_t seen = sight_.sees(ends[0] / 2 + ends[1] / 2) ? 2 : 0;
      parts[seen + (marker.from == marker.to ? 1 : 0)].push_back(
          {sight_.place(ends[0]), sight_.place(ends[1])});
    }
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const float alpha = i >= 2 ? 1 : style.hidden_opacity;
      const float width = (i % 2 == 1 ? 2 : 1) * style.radius * scene_.pixel_scale;
      add(parts[i], to_colour(style.rim, alpha), width);
      add(parts[i], to_colour(style.colour, alpha), style.inside * width);
    }
  }

  std::vector<Figure::Stroke> strokes;

 private:
  void add(const std::vector<Outline>& parts, const Figure::Colour& colour, double width,
           double dash = 0) {
    if (!parts.empty()) strokes.push_back({thinned(parts), colour, width, dash});
  }

  void add_with_rim(const std::vector<Outline>& parts, const glm::vec3& colour, bool hidden) {
    const engine::LineStyle& style = scene_.lines;
    const float scale = scene_.pixel_scale * (hidden ? style.hidden_width : 1);
    const float alpha = hidden ? style.hidden_opacity : 1;
    const double dash = hidden ? style.dash * scene_.pixel_scale : 0;
    const float rimmed = (style.width + 2 * style.rim) * scale;
    if (style.rim > 0) add(parts, to_colour(style.rim_about(colour), alpha), rimmed, dash);
    add(parts, to_colour(colour, alpha), style.width * scale, dash);
  }

  const LineSight& sight_;
  const engine::Scene& scene_;
};

/// Boxes that continue each other, such as the colours of a bar, become one.
std::vector<Figure::Box> boxes_of(const engine::Overlay& overlay) {
  std::vector<Figure::Box> out;
  for (const auto& [min, max, top, bottom] : overlay.boxes) {
    const Vector2d low(min.x, min.y), high(max.x, max.y);
    constexpr double kTouch = 1e-3;
    if (top != bottom && !out.empty() && out.back().min.x() == low.x() &&
        out.back().max.x() == high.x() && out.back().colours.size() > 1 &&
        std::abs(out.back().min.y() - high.y()) < kTouch) {
      out.back().min = low;
      out.back().colours.push_back(to_colour(top));  // upwards; turned round below
      continue;
    }
    out.push_back({low, high, {to_colour(bottom)}});
    if (top != bottom) out.back().colours.push_back(to_colour(top));
  }
  for (Figure::Box& box : out) {
    std::ranges::reverse(box.colours);
    constexpr std::size_t kMaxStops = 129;  // what lies between is linear, or nearly
    if (box.colours.size() <= kMaxStops) continue;
    std::vector<Figure::Colour> fewer;
    for (std::size_t i = 0; i < kMaxStops; ++i) {
      fewer.push_back(box.colours[i * (box.colours.size() - 1) / (kMaxStops - 1)]);
    }
    box.colours = std::move(fewer);
  }
  return out;
}

}  // namespace

Result<FigureShapes> FigureShapes::build(const PictureData& data,
                                         const engine::SurfaceStyle& style) {
  FigureShapes shapes;
  std::vector<Vec3> positions;
  for (const PictureData::Vector& p : data.positions) positions.push_back(to_vec3(p));
  std::vector<Face> faces;
  for (const auto& [a, b, c] : data.faces) {
    faces.push_back({static_cast<Index>(a), static_cast<Index>(b), static_cast<Index>(c)});
  }
  auto made = TriangleMesh::build(std::move(positions), std::move(faces));
  if (!made) return shapes;  // nothing is left of it
  const auto mesh = std::make_shared<const TriangleMesh>(*std::move(made));
  auto tree = RayTree::build(mesh);
  if (!tree) return tree.error();
  shapes.tree_ = *std::move(tree);
  if (data.values.empty()) return shapes;
  std::vector<double> values;
  double largest = 0;
  for (const float value : data.values) {
    const bool known = value != kNoPictureValue;
    values.push_back(known ? double{value} : std::numeric_limits<double>::infinity());
    if (known) largest = std::max(largest, double{value});
  }
  const auto lines = find_isolines(*mesh, values, isoline_levels(style, largest));
  if (!lines) return lines.error();
  for (const Isoline& line : *lines) {
    shapes.isolines_.push_back(refined_line(positions_of(*mesh, line.path)));
  }
  return shapes;
}

Figure FigureShapes::of(const PictureData& data, const PictureDataSettings& settings,
                        const engine::Scene& scene, const engine::Overlay& overlay) const {
  Figure figure;
  if (tree_) {
    const LineSight sight(*tree_, view_of(scene.camera));
    Strokes strokes(sight, scene);
    for (const auto& isoline : isolines_) strokes.add_isoline(isoline);
    for (const PictureData::Line& line : data.lines) {
      if (shows_line(settings, line.name)) strokes.add_line(line);
    }
    if (scene.markers.visible) strokes.add_markers(data.sources);
    figure.strokes = std::move(strokes.strokes);
  }
  figure.boxes = boxes_of(overlay);
  for (const auto& [base, width, text, colour] : overlay.texts) {
    figure.letters.push_back({{base.x, base.y}, width, text, to_colour(colour)});
  }
  figure.font = engine::font_file();
  return figure;
}

engine::Scene FigureShapes::rest_of(engine::Scene scene) {
  scene.surface.line_spacing = 0;
  scene.surface.levels.clear();
  scene.lines.visible = false;
  scene.markers.visible = false;
  return scene;
}

}  // namespace geotherm::app
