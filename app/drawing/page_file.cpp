// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <span>

#include "app/drawing/packed_arrays.h"
#include "app/drawing/page_shaders.h"
#include "app/drawing/picture_camera.h"
#include "app/drawing/picture_scene.h"
#include "app/drawing/scene_files.h"
#include "app/drawing/scene_mesh.h"
#include "embedded/page_data_js.h"
#include "embedded/page_draw_js.h"
#include "embedded/page_legend_js.h"
#include "embedded/page_page_css.h"
#include "embedded/page_page_html.h"
#include "embedded/page_page_js.h"
#include "engine/scene/arrows.h"
#include "engine/scene/line_set.h"
#include "engine/scene/uniforms.h"
#include "solver/core/text.h"

namespace geotherm::app {
namespace {

using PageJson = nlohmann::ordered_json;
using Numbers = std::vector<std::uint32_t>;

/// Bits of a quantised coordinate: a millionth of the box, which is below a pixel at any zoom that
/// shows more than a few triangles of a million; small models keep the precision of 32-bit floats.
constexpr int kCoordinateBits = 20, kFineBits = 24;
constexpr std::size_t kSmallModel = 100'000;
constexpr int kNormalBits = 12, kVectorBits = 12, kValueBits = 24;

template <class Vector>
std::span<const float> numbers_in(const std::vector<Vector>& vectors) {
  return {reinterpret_cast<const float*>(vectors.data()), vectors.size() * sizeof(Vector) / 4};
}

/// Unit vectors on the faces of an octahedron that is folded open into a square (Q. Meyer and
/// others, "On floating-point normal vectors", 2010).
std::vector<float> octahedral(const std::vector<glm::vec3>& normals) {
  std::vector<float> out;
  for (const glm::vec3& n : normals) {
    const float size = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
    const glm::vec2 p = glm::vec2(n) / size;
    const glm::vec2 side(p.x >= 0 ? 1 : -1, p.y >= 0 ? 1 : -1);
    const glm::vec2 q = n.z >= 0 ? p : (1.0F - glm::abs(glm::vec2(p.y, p.x))) * side;
    out.insert(out.end(), {q.x, q.y});
  }
  out.insert(out.end(), {-1, -1, 1, 1});  // two more, so that all of the square is the range
  return out;
}

PageJson colour_json(const glm::vec3& c) { return {c.r, c.g, c.b}; }

/// The views of a page: those that this answer has.
std::vector<View> views_of(const PictureData& data, View asked) {
  std::vector<View> views;
  const auto add = [&](View view, bool there) {
    if (there || view == asked) views.push_back(view);
  };
  add(View::kContours, !data.values.empty() && !data.is_signed);
  add(View::kRegions, !data.nearest.empty());
  add(View::kHeatGradient, !data.heat_directions.empty() && !data.is_field);
  add(View::kGradientError, !data.distance_gradients.empty());
  for (const View view : {View::kExactError, View::kEikonalError, View::kLostGradients,
                          View::kTriangleQuality, View::kNonDelaunay}) {
    add(view, false);
  }
  for (const View view : {View::kSmooth, View::kFlat, View::kWireframe}) add(view, true);
  add(View::kSources, !data.sources.empty());
  return views;
}

PageJson legend_json(const engine::Legend& legend, const engine::LegendLayout& layout) {
  PageJson ticks = PageJson::array(), keys = PageJson::array();
  for (const engine::Tick& tick : legend.ticks) ticks.push_back({tick.position, tick.label});
  for (const engine::Key& key : legend.keys) {
    PageJson one = {{"label", key.label}, {"colour", colour_json(key.colour)}};
    if (key.rim) one["rim"] = colour_json(*key.rim);
    for (const glm::vec3& patch : key.patches) one["patches"].push_back(colour_json(patch));
    keys.push_back(std::move(one));
  }
  PageJson json = {{"line", layout.line}, {"heading", legend.heading}, {"keys", std::move(keys)}};
  if (legend.bar) {
    const glm::vec2 &a = layout.bar_min, &b = layout.bar_max;
    json["bar"] = {{"box", {a.x, a.y, b.x, b.y}}, {"title", legend.title},
                   {"below", legend.below},       {"above", legend.above},
                   {"ticks", std::move(ticks)},   {"lines", legend.lines}};
  }
  return json;
}

/// Colour tables that several views share are written once.
class PageTables {
 public:
  std::size_t place_of(const engine::ColourTable& table) {
    std::string bytes;
    for (const glm::vec4& c : table) {
      for (int k = 0; k < 3; ++k) bytes += static_cast<char>(std::lround(c[k] * 255.0F));
    }
    const std::string text = base64(bytes);
    const auto known = std::ranges::find(texts_, text);
    if (known != texts_.end()) return static_cast<std::size_t>(known - texts_.begin());
    texts_.push_back(text);
    return texts_.size() - 1;
  }
  const std::vector<std::string>& texts() const { return texts_; }

 private:
  std::vector<std::string> texts_;
};

PageJson view_json(const PictureData& whole, const PictureData& shown,
                   const PictureSettings& settings, const engine::Camera& camera,
                   PageTables& tables) {
  const PictureScale scale = picture_scale(whole, settings);
  engine::Scene scene = scene_of(whole, settings, scale);
  scene.camera = camera;
  const engine::shared::Frame frame = engine::frame_uniforms(scene, {0, 0}, camera.extent);
  std::array<float, sizeof(frame) / sizeof(float)> floats{};
  std::memcpy(floats.data(), &frame, sizeof(frame));
  const engine::Legend legend = legend_of(whole, settings, scale);
  const engine::ColourMap* map = engine::find_colour_map(colour_map_of(whole, settings));
  const bool regions = scene.surface.paint == engine::Paint::kRegions;
  const bool faces = scene.surface.paint == engine::Paint::kFaces && !shown.face_values.empty();
  if (scene.surface.paint == engine::Paint::kFaces && !faces) {
    scene.surface.paint = engine::Paint::kPlain;
  }
  PageJson json = {{"name", geotherm::to_text(settings.view)},
                   {"features", engine::surface_features(scene)},
                   {"paint", faces     ? "faces"
                             : regions ? "regions"
                                       : "values"},
                   {"frame", floats},
                   {"markers", scene.markers.visible},
                   {"hidden", scene.markers.hidden_opacity},
                   {"legend", legend_json(legend, engine::lay_out(legend, camera.extent))}};
  if (regions) {
    json["table"] = tables.place_of(engine::region_table());
  } else if (map != nullptr) {
    json["table"] = tables.place_of(colours_of(*map, settings));
  }
  const engine::ArrowStyle& arrows = scene.arrows;
  if (arrows.primary) json["arrows"].push_back(colour_json(arrows.primary_colour));
  if (arrows.secondary) json["arrows"].push_back(colour_json(arrows.secondary_colour));
  return json;
}

/// What the page turns: the matrix, and the lens.
PageJson camera_json(const engine::Camera& camera) {
  const glm::mat4& p = camera.projection;
  const glm::vec2 shift = camera.orthographic ? glm::vec2(p[3]) : -glm::vec2(p[2]);
  const glm::vec2 axis = 0.5F * shift * camera.extent;  // from the middle
  PageJson view = PageJson::array();
  for (int c = 0; c < 4; ++c) {
    for (int r = 0; r < 4; ++r) view.push_back(camera.view[c][r]);
  }
  return {{"view", std::move(view)},
          {"axis", {axis.x, axis.y}},
          {"pixels", camera.pixels_per_unit},
          {"orthographic", camera.orthographic}};
}

void pack_arrows(const PictureData& data, PackedArrays& arrays, PageJson& json) {
  if (data.heat_directions.empty() && data.distance_gradients.empty()) return;
  const std::vector<glm::vec3> positions = scene_vectors(data.positions);
  const engine::ArrowPlaces places({positions, data.faces, data.solid});
  Numbers faces;
  PageJson levels = PageJson::array();  // [how many places, their spacing]
  for (const auto& place : places.places()) {
    if (levels.empty() || levels.back()[1] != place.spacing) levels.push_back({0, place.spacing});
    levels.back()[0] = levels.back()[0].get<int>() + 1;
    faces.push_back(place.face);
  }
  arrays.add("arrow_faces", faces, 1);
  arrays.add_floats("heat", numbers_in(data.heat_directions), 3, kVectorBits);
  arrays.add_floats("gradients", numbers_in(data.distance_gradients), 3, kVectorBits);
  json["arrows"] = {{"levels", std::move(levels)},
                    {"spacing", engine::ArrowStyle().spacing},
                    {"solid", data.solid}};
}

void pack_lines(const PictureData& data, PackedArrays& arrays, PageJson& json) {
  std::vector<engine::LinePiece> pieces;
  for (const PictureData::Line& line : data.lines) {
    const std::size_t first = pieces.size();
    for (const auto& run : engine::finite_runs(scene_vectors(line.points))) {
      const auto more = engine::line_pieces(run);
      pieces.insert(pieces.end(), more.begin(), more.end());
    }
    const glm::vec3 colour(line.colour[0], line.colour[1], line.colour[2]);
    json["lines"].push_back({{"first", first},
                             {"count", pieces.size() - first},
                             {"colour", colour_json(colour)},
                             {"rim", colour_json(engine::LineStyle().rim_about(colour))}});
  }
  arrays.add_floats("lines", numbers_in(pieces), 13, kFineBits);
}

void pack_surface(const SceneMesh& mesh, const PictureData& data, bool regions,
                  PackedArrays& arrays) {
  const int bits = mesh.origin.size() > kSmallModel ? kCoordinateBits : kFineBits;
  arrays.add_floats("positions", numbers_in(mesh.positions), 3, bits);
  arrays.add_floats("normals", octahedral(mesh.normals), 2, kNormalBits);
  arrays.add("openness", mesh.openness, 2);
  arrays.add("origin", mesh.origin, 1);
  Numbers corners;
  for (const auto& face : mesh.faces) corners.insert(corners.end(), face.begin(), face.end());
  arrays.add("faces", corners, 1);
  arrays.add_floats("values", data.values, 1, kValueBits);
  arrays.add_floats("face_values", data.face_values, 1, kValueBits);
  Numbers places;
  if (regions) {
    for (const std::int32_t at : region_places(data))
      places.push_back(static_cast<std::uint32_t>(at + 1));
  }
  arrays.add("regions", places, 1);
  arrays.add_floats("margins", regions ? region_margins_of(data) : std::vector<float>(), 1,
                    kValueBits);
  arrays.add_floats("markers", numbers_in(scene_markers(data)), 10, kFineBits);
}

std::string html_text(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '<') out += "&lt;";
    if (c == '&') out += "&amp;";
    if (c == '"') out += "&quot;";
    if (c != '<' && c != '&' && c != '"') out += c;
  }
  return out;
}

/// The template with what its marks, {{name}}, stand for.
std::string filled(std::string_view rest, const std::map<std::string_view, std::string>& texts) {
  std::string out;
  for (std::size_t at = 0; (at = rest.find("{{")) != std::string_view::npos;) {
    const std::size_t end = rest.find("}}", at);
    out += rest.substr(0, at);
    out += texts.at(rest.substr(at + 2, end - at - 2));
    rest.remove_prefix(end + 2);
  }
  return out += rest;
}

std::string_view text_in(std::span<const unsigned char> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

Result<std::string> page_file(const PictureData& shown, const PictureData& whole,
                              const PictureSettings& settings, const std::vector<FileText>& texts) {
  const glm::vec2 extent(settings.width, settings.height);
  const auto layout =
      engine::lay_out(legend_of(whole, settings, picture_scale(whole, settings)), extent);
  const std::vector<glm::vec3> fitted =
      scene_vectors(whole.framed.empty() ? whole.positions : whole.framed);
  const engine::Camera camera =
      camera_of(whole, settings.camera, fitted, extent, insets_of(settings, layout, extent));

  const SceneMesh mesh = scene_mesh(shown);
  PageTables tables;
  PageJson json = {
      {"size", {settings.width, settings.height}},
      {"camera", camera_json(camera)},
      {"asked", geotherm::to_text(settings.view)},
      {"background", geotherm::to_text(settings.background)},
      {"caption", settings.caption ? whole.caption : std::string()},
      {"vertices", whole.positions.size()},
      {"centre", {whole.centre.x(), whole.centre.y(), whole.centre.z()}},
      {"model_per_scene", whole.model_per_scene},
      {"value",
       {{"base", whole.value_base}, {"unit", whole.value_unit}, {"title", whole.value_title}}},
      {"face_title", whole.face_title},
      {"pixel_scale", scene_of(whole, settings, {}).pixel_scale}};
  const engine::LineStyle lines;
  json["hidden_lines"] = {
      {"width", lines.hidden_width}, {"opacity", lines.hidden_opacity}, {"dash", lines.dash}};
  bool regions = false;
  for (const View view : views_of(whole, settings.view)) {
    PictureSettings of_view = settings;
    of_view.view = view;
    regions = regions || shows_regions(shown, of_view);
    json["views"].push_back(view_json(whole, shown, of_view, camera, tables));
  }
  for (const PictureBackground background :
       {PictureBackground::kLight, PictureBackground::kDark, PictureBackground::kTransparent}) {
    PictureSettings other = settings;
    other.background = background;
    const engine::Scene scene = scene_of(whole, other, {});
    const engine::Legend legend = legend_of(whole, other, {});
    const glm::vec4& b = scene.background;
    json["backgrounds"][geotherm::to_text(background)] = {{"colour", {b.r, b.g, b.b, b.a}},
                                                          {"ink", colour_json(legend.ink)}};
  }
  for (const PageShader& shader : page_shaders()) json["shaders"][shader.name] = shader.text;
  for (const FileText& text : texts) json["about"][text.keyword] = text.text;

  PackedArrays arrays;
  pack_surface(mesh, shown, regions, arrays);
  pack_arrows(shown, arrays, json);
  pack_lines(shown, arrays, json);
  json["tables"] = tables.texts();
  json["arrays"] = arrays.index();
  const auto data = arrays.deflated();
  if (!data) return data.error();

  std::string head = json.dump(-1, ' ', true, PageJson::error_handler_t::replace);
  for (std::size_t at = 0; (at = head.find('<', at)) != std::string::npos;) {
    head.replace(at, 1, "\\u003c");  // the script that holds it must not end
  }
  const auto title = std::ranges::find(texts, "Title", &FileText::keyword);
  std::string script;
  for (const auto part : {embedded::page_data_js(), embedded::page_draw_js(),
                          embedded::page_legend_js(), embedded::page_page_js()}) {
    script += text_in(part);
  }
  return filled(
      text_in(embedded::page_page_html()),
      {{"title", title == texts.end() ? "geotherm" : html_text(geotherm::printable(title->text))},
       {"style", std::string(text_in(embedded::page_page_css()))},
       {"scene", std::move(head)},
       {"data", base64(*data)},
       {"script", std::move(script)}});
}

}  // namespace geotherm::app
