// SPDX-License-Identifier: MIT
#include "app/drawing/picture_scene.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "app/picture/picture_scale.h"
#include "app/text/text.h"
#include "engine/scene/colours.h"
#include "engine/scene/region_margins.h"

namespace geotherm::app {
namespace {

/// The picture's smaller side that widths in pixels are meant for.
constexpr float kUsualSide = 720;
/// Lines of a small picture stay visible.
constexpr float kMinScale = 0.75F;
/// More isolines than this tell nothing on a bar.
constexpr double kMaxLinesOnBar = 200;

/// Colours that stand for those of all regions.
constexpr std::size_t kMaxPatches = 6;

constexpr float kPaperOpacity = 0.75F;

constexpr float kMarker = 6.5F, kLargeMarker = 9;  ///< of sources; in the view about them
constexpr glm::vec3 kSourceRed{0.86F, 0.13F, 0.11F};

constexpr glm::vec3 kDarkInk{0.10F, 0.11F, 0.13F};
constexpr glm::vec3 kLightInk{0.90F, 0.91F, 0.93F};
constexpr glm::vec4 kWhite{1, 1, 1, 1};
constexpr glm::vec4 kDark{0.10F, 0.11F, 0.13F, 1};
constexpr glm::vec4 kNothing{1, 1, 1, 0};

/// Model units as the engine's values; kept within what shaders can compute with.
float value_of(const PictureData& data, double distance) {
  constexpr double kLargest = 1e18;
  const double value = (distance - data.value_base) / data.value_unit;
  return static_cast<float>(std::clamp(value, -kLargest, kLargest));
}

engine::Light light_of(PictureLight light) {
  switch (light) {
    case PictureLight::kHeadlight:
      return engine::Light::kHeadlight;
    case PictureLight::kThreePoint:
      return engine::Light::kThreePoint;
    case PictureLight::kNone:
      break;
  }
  return engine::Light::kNone;
}

glm::vec4 background_of(PictureBackground background) {
  switch (background) {
    case PictureBackground::kDark:
      return kDark;
    case PictureBackground::kTransparent:
      return kNothing;
    case PictureBackground::kLight:
      break;
  }
  return kWhite;
}

engine::SurfaceStyle surface_of(const PictureData& data, const PictureSettings& settings,
                                const PictureScale& scale) {
  engine::SurfaceStyle style;
  style.smooth = settings.view != View::kFlat;
  style.wire = settings.view == View::kWireframe;
  style.form = settings.shading == PictureShading::kForm;
  style.bands = settings.bands;
  if (face_field(settings.view) && !data.face_values.empty()) {
    style.paint = engine::Paint::kFaces;
    style.range_max = static_cast<float>(scale.max);
    return style;
  }
  const bool regions = shows_regions(data, settings);
  if (regions) style.paint = engine::Paint::kRegions;
  const bool mapped = maps_values(settings.view);
  if (data.values.empty() || !(regions || mapped)) return style;
  if (mapped) style.paint = engine::Paint::kMap;
  style.range_min = value_of(data, scale.min);
  style.range_max = value_of(data, scale.max);
  style.log = scale.kind == ColourScale::kLog;
  style.log_offset = -value_of(data, 0);
  // Multiples within the values of a field are levels.
  const bool multiples = scale.levels.empty() && !data.is_field;
  style.line_spacing = multiples ? value_of(data, scale.spacing) : 0;
  for (const double level : scale.levels) style.levels.push_back(value_of(data, level));
  return style;
}

/// What the colours of arrows, regions and lines stand for.
std::vector<engine::Key> keys_of(const PictureData& data, const PictureSettings& settings) {
  std::vector<engine::Key> keys;
  if (settings.view == View::kGradientError) {
    const engine::ArrowStyle style;
    keys = {{style.primary_colour, "X = -\u2207u / |\u2207u|"},
            {style.secondary_colour, "\u2207\u03c6, as long as its angle to X (full: 90\u00b0)"}};
  }
  if (shows_regions(data, settings)) {
    std::set<Index> groups(data.nearest.begin(), data.nearest.end());
    groups.erase(kNoIndex);
    engine::Key key{.label = "nearest source (" + std::to_string(groups.size()) + ")"};
    const std::vector<std::int32_t> all = region_places(data);
    const std::set<std::int32_t> places(all.begin(), all.end());
    for (const std::int32_t place : places) {
      if (place < 0 || key.patches.size() == kMaxPatches) continue;
      key.patches.push_back(engine::region_colour(static_cast<std::uint32_t>(place)));
    }
    keys.push_back(std::move(key));
  }
  const bool maps = maps_values(settings.view) && !data.values.empty();
  if ((maps || shows_regions(data, settings)) && data.unreached) {
    keys.push_back({.label = data.is_signed || data.is_field ? "no value" : "not reached",
                    .patches = {engine::kNoValueColour}});
  }
  for (const PictureData::Line& line : data.lines) {
    if (!shows_line(settings, line.name)) continue;
    const glm::vec3 colour(line.colour[0], line.colour[1], line.colour[2]);
    const bool stands = std::any_of(keys.begin(), keys.end(), [&](const engine::Key& key) {
      return key.label == line.name && key.colour == colour;
    });
    if (line.name.empty() || stands) continue;
    keys.push_back({colour, line.name, engine::LineStyle().rim_about(colour)});
  }
  return keys;
}

/// How high a line of letters is, in pixels; 0: it suits the picture. Fonts are named by the size
/// of their em, and a line is a little higher than that.
float line_height_of(const PictureSettings& settings) {
  if (!settings.text_size && !settings.paper) return 0;
  return static_cast<float>(kLineOfEm *
                            pixels_of(settings.text_size.value_or(kTextOnPaper), settings));
}

/// How much wider than usual lines are.
float line_factor(const PictureSettings& settings, float usual) {
  if (!settings.line_width && !settings.paper) return 1;
  return static_cast<float>(pixels_of(settings.line_width.value_or(kLinesOnPaper), settings)) /
         usual;
}

}  // namespace

engine::Legend legend_of(const PictureData& data, const PictureSettings& settings,
                         const PictureScale& scale) {
  engine::Legend legend;
  legend.ink = settings.background == PictureBackground::kDark ? kLightInk : kDarkInk;
  legend.paper = background_of(settings.background);
  legend.paper.a *= kPaperOpacity;
  legend.heading = settings.title;
  legend.line_height = line_height_of(settings);
  if (settings.caption) legend.caption = data.caption;
  if (settings.bar) legend.keys = keys_of(data, settings);
  const engine::ColourMap* map = engine::find_colour_map(colour_map_of(data, settings));
  if (!scale.bar || map == nullptr) return legend;
  legend.bar = true;
  legend.at_side = settings.camera.fit == PictureFit::kSphere;
  legend.title = bar_title(data, settings);
  legend.below = scale.below;
  legend.above = scale.above;
  for (const glm::vec4& colour : colours_of(*map, settings)) {
    legend.colours.emplace_back(colour);
  }
  const double width = scale.max - scale.min;
  const auto position = [&](double distance) {
    return static_cast<float>(std::clamp(scale.place_of(distance), 0.0, 1.0));
  };
  for (std::size_t i = 0; i < scale.ticks.values.size(); ++i) {
    legend.ticks.push_back({position(scale.ticks.values[i]), scale.ticks.labels[i]});
  }
  for (const double level : scale.levels) {
    if (level > scale.min && level < scale.max) legend.lines.push_back(position(level));
  }
  if (!(scale.spacing > 0) || !scale.levels.empty() || width / scale.spacing > kMaxLinesOnBar)
    return legend;
  // Of a spacing the renderer draws the multiples above 0.
  const double first = std::max(std::floor(scale.min / scale.spacing), 0.0) + 1;
  for (double i = first; i * scale.spacing < scale.max; ++i) {
    legend.lines.push_back(position(i * scale.spacing));
  }
  return legend;
}

engine::Insets insets_of(const PictureSettings& settings, const engine::LegendLayout& legend,
                         glm::vec2 extent) {
  if (settings.camera.fit != PictureFit::kSphere) return legend.insets;
  engine::Legend usual{.bar = settings.bar,
                       .at_side = true,
                       .colours = {glm::vec3(0), glm::vec3(1)},
                       .ticks = {{0, "0.05"}, {0.5F, "0.05"}, {1, "0.05"}},
                       .title = "distance (model\u00a0units)",
                       .heading = settings.title};
  if (settings.caption) usual.caption = "M";
  usual.line_height = line_height_of(settings);
  return engine::lay_out(usual, extent).insets;
}

engine::Scene scene_of(const PictureData& data, const PictureSettings& settings,
                       const PictureScale& scale) {
  engine::Scene scene;
  scene.light = light_of(settings.light);
  scene.background = background_of(settings.background);
  scene.surface = surface_of(data, settings, scale);
  scene.arrows.secondary = settings.view == View::kGradientError;
  const bool field = data.is_field && !data.heat_directions.empty();
  scene.arrows.primary = field || shows_arrows(settings.view);
  scene.markers.visible = settings.markers && needs_sources(settings.view);
  scene.markers.radius = settings.view == View::kSources ? kLargeMarker : kMarker;
  if (settings.view == View::kSources) scene.markers.colour = kSourceRed;
  const auto side = static_cast<float>(std::min(settings.width, settings.height));
  scene.pixel_scale = std::max(side / kUsualSide, kMinScale);
  // Beside large letters, which are read from farther away or on finer pixels.
  const glm::vec2 extent(settings.width, settings.height);
  const float letters = line_height_of(settings) / engine::usual_line(extent);
  scene.markers.radius *= std::max(1.0F, letters);
  const float wider = line_factor(settings, scene.surface.line_width * scene.pixel_scale);
  for (float* width : {&scene.surface.line_width, &scene.surface.wire_width, &scene.lines.width,
                       &scene.lines.rim}) {
    *width *= wider;
  }
  return scene;
}

namespace {

/// Triangles that join what is side by side: in a volume also inside, so that regions keep their
/// colours while a slice moves.
std::vector<std::array<std::uint32_t, 3>> joining_triangles(const PictureData& data) {
  if (!data.volume) return data.faces;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (const Tet& tet : data.volume->tets()) {
    const auto v = [&tet](std::size_t k) { return static_cast<std::uint32_t>(tet[k]); };
    triangles.push_back({v(0), v(1), v(2)});
    triangles.push_back({v(0), v(1), v(3)});
    triangles.push_back({v(1), v(2), v(3)});
  }
  return triangles;
}

/// Where values are distances, in scene units.
std::vector<float> scene_distances(const PictureData& data) {
  std::vector<float> out;
  const auto unit = static_cast<float>(data.value_unit / data.model_per_scene);
  if (data.is_signed || data.is_field || !std::isfinite(unit)) return out;
  for (const float value : data.values)
    out.push_back(value == kNoPictureValue ? value : value * unit);
  return out;
}

/// The colours of a view, and what they stand for where that is no value.
Result<void> upload_colours(engine::Renderer& renderer, const PictureData& data,
                            const PictureDataSettings& settings) {
  if (shows_regions(data, settings)) {
    if (auto done = renderer.set_regions(region_places(data), region_margins_of(data)); !done) {
      return done;
    }
    return renderer.set_colours(engine::region_table());
  }
  if (auto done = renderer.set_regions({}, {}); !done) return done;
  const engine::ColourMap* map = engine::find_colour_map(colour_map_of(data, settings));
  return map == nullptr ? Result<void>() : renderer.set_colours(colours_of(*map, settings));
}

Result<void> upload_lines(engine::Renderer& renderer, const PictureData& data,
                          const PictureDataSettings& settings) {
  std::vector<std::vector<glm::vec3>> points;
  points.reserve(data.lines.size());
  std::vector<engine::Polyline> lines;
  for (const PictureData::Line& line : data.lines) {
    if (!shows_line(settings, line.name)) continue;
    points.push_back(scene_vectors(line.points));
    lines.push_back({points.back(), {line.colour[0], line.colour[1], line.colour[2]}});
  }
  return renderer.set_lines(lines);
}

}  // namespace

std::vector<std::int32_t> region_places(const PictureData& data) {
  return engine::region_colour_places(joining_triangles(data), data.nearest);
}

engine::ColourTable colours_of(const engine::ColourMap& map, const PictureDataSettings& settings) {
  engine::ColourTable table = engine::colour_table(map, settings.reverse);
  if (settings.bands == 0) return table;
  const engine::ColourTable all = table;
  const auto last = static_cast<std::size_t>(settings.bands - 1);
  for (std::size_t i = 0; i < table.size(); ++i) {
    const std::size_t band = i * static_cast<std::size_t>(settings.bands) / table.size();
    table[i] = all[band * (table.size() - 1) / last];
  }
  return table;
}

std::vector<float> region_margins_of(const PictureData& data) {
  const std::vector<glm::vec3> positions = scene_vectors(data.positions);
  return engine::region_margins({positions, data.faces}, data.nearest, scene_distances(data));
}

std::vector<engine::Marker> scene_markers(const PictureData& data) {
  std::vector<engine::Marker> out;
  for (const auto& [from, to, way] : data.sources) {
    out.push_back({{from[0], from[1], from[2]}, {to[0], to[1], to[2]}});
    if (data.solid) out.back().outward = {way[0], way[1], way[2], way[3]};
  }
  return out;
}

std::vector<glm::vec3> scene_vectors(const std::vector<PictureData::Vector>& all) {
  std::vector<glm::vec3> out;
  out.reserve(all.size());
  for (const auto& [x, y, z] : all) out.emplace_back(x, y, z);
  return out;
}

std::vector<engine::Openness> scene_openness(const PictureData& data) {
  std::vector<engine::Openness> out;
  out.reserve(data.openness.size());
  for (const auto& [n, front, back] : data.openness) {
    out.push_back({{n[0], n[1], n[2]}, front, back});
  }
  return out;
}

Result<void> upload_surface(engine::Renderer& renderer, const PictureData& data,
                            std::span<const glm::vec3> positions) {
  const auto openness = scene_openness(data);
  return renderer.set_surface({positions, data.faces, data.solid, openness});
}

Result<void> upload_answer(engine::Renderer& renderer, const PictureData& data,
                           const PictureDataSettings& settings) {
  if (!data.values.empty()) {
    if (auto done = renderer.set_values(data.values); !done) return done;
  }
  if (auto done = renderer.set_face_values(data.face_values); !done) return done;
  if (auto done = upload_colours(renderer, data, settings); !done) return done;
  if (auto done = upload_lines(renderer, data, settings); !done) return done;
  const auto arrows = renderer.set_arrows(scene_vectors(data.heat_directions),
                                          scene_vectors(data.distance_gradients));
  if (!arrows) return arrows;
  return renderer.set_markers(scene_markers(data));
}

Result<void> upload_picture(engine::Renderer& renderer, const PictureData& data,
                            const PictureDataSettings& settings,
                            std::span<const glm::vec3> positions) {
  if (auto done = upload_surface(renderer, data, positions); !done) return done;
  return upload_answer(renderer, data, settings);
}

DrawingDevice to_drawing_device(const engine::DeviceInfo& info) {
  DrawingDevice device;
  device.name = info.name;
  device.kind = info.kind;
  device.driver = info.driver;
  device.api = "Vulkan " + std::to_string(info.api_major) + "." + std::to_string(info.api_minor) +
               "." + std::to_string(info.api_patch);
  device.memory_mb = static_cast<double>(info.memory) / (1024.0 * 1024.0);
  device.software = info.software;
  device.chosen = info.chosen;
  device.lacks = info.lacks;
  return device;
}

}  // namespace geotherm::app
