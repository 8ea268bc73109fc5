// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "app/drawing/picture_scene.h"
#include "app/drawing/scene_files.h"
#include "app/drawing/scene_mesh.h"
#include "engine/scene/colours.h"
#include "engine/scene/line_set.h"
#include "solver/mesh/io/scene_reader.h"

namespace geotherm::app {
namespace {

using GlbJson = nlohmann::ordered_json;

// Numbers that the specification of glTF 2.0 gives.
constexpr int kFloat = 5126, kUnsignedShort = 5123, kUnsignedInt = 5125;
constexpr int kVertexData = 34962, kIndexData = 34963;
constexpr int kLineStrip = 3, kTriangles = 4;
constexpr std::uint32_t kMagic = 0x46546C67, kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;

/// The value of _DISTANCE where no source is: the format forbids infinity.
constexpr float kUnreachedDistance = -1;

/// The one buffer, and what the JSON says about its parts.
class GlbBuffer {
 public:
  /// `parts`: numbers of an element. Returns the accessor's number.
  template <class Number>
  int add(std::span<const Number> numbers, std::size_t parts, int component, int target,
          bool normalized = false, bool bounds = false) {
    constexpr std::array kTypes = {"SCALAR", "VEC2", "VEC3", "VEC4"};
    views_.push_back({{"buffer", 0},
                      {"byteOffset", bytes_.size()},
                      {"byteLength", numbers.size_bytes()},
                      {"target", target}});
    GlbJson accessor = {{"bufferView", views_.size() - 1},
                        {"componentType", component},
                        {"count", numbers.size() / parts},
                        {"type", kTypes[parts - 1]}};
    if (normalized) accessor["normalized"] = true;
    for (std::size_t k = 0; bounds && k < parts; ++k) {
      Number least = numbers[k], most = numbers[k];
      for (std::size_t i = k; i < numbers.size(); i += parts) {
        least = std::min(least, numbers[i]);
        most = std::max(most, numbers[i]);
      }
      accessor["min"].push_back(least);
      accessor["max"].push_back(most);
    }
    accessors_.push_back(std::move(accessor));
    bytes_.append(reinterpret_cast<const char*>(numbers.data()), numbers.size_bytes());
    bytes_.resize((bytes_.size() + 3) / 4 * 4);
    return static_cast<int>(accessors_.size()) - 1;
  }

  const std::string& bytes() const { return bytes_; }
  const GlbJson& views() const { return views_; }
  const GlbJson& accessors() const { return accessors_; }

 private:
  std::string bytes_;
  GlbJson views_ = GlbJson::array(), accessors_ = GlbJson::array();
};

template <class Vector>
std::span<const float> floats_of(const std::vector<Vector>& vectors) {
  return {reinterpret_cast<const float*>(vectors.data()), vectors.size() * sizeof(Vector) / 4};
}

/// Scene space in model units: relative to the centre where the model is far from the origin for
/// its size, so that 32 bits lose nothing.
class ModelSpace {
 public:
  explicit ModelSpace(const PictureData& data)
      : scale_(data.model_per_scene), centre_(data.centre) {
    if (centre_.cwiseAbs().maxCoeff() > scale_) std::swap(centre_, translation_);
  }

  glm::vec3 operator()(const glm::vec3& scene) const {
    const Vec3 p = centre_ + scale_ * Vec3(scene.x, scene.y, scene.z);
    return {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
  }
  const Vec3& translation() const { return translation_; }

  /// Smaller or larger models have no place in 32-bit numbers.
  bool fits() const {
    constexpr double kSmallest = 1e-30, kLargest = 1e30;
    return scale_ >= kSmallest && scale_ <= kLargest &&
           translation_.cwiseAbs().maxCoeff() <= kLargest;
  }

 private:
  double scale_;
  Vec3 centre_, translation_ = Vec3::Zero();
};

/// The turn to the y that is up in glTF, of models whose up is another axis.
glm::dquat turn_of(UpAxis up) {
  const auto axes = axes_of(up);
  glm::dmat3 turn;  // by columns
  for (int row = 0; row < 3; ++row) {
    const auto& [x, y, z] = axes[static_cast<std::size_t>(row)];
    turn[0][row] = x;
    turn[1][row] = y;
    turn[2][row] = z;
  }
  return glm::quat_cast(turn);
}

/// glTF multiplies light in linear colours.
std::uint16_t linear_short(float srgb) {
  const double x = std::clamp(static_cast<double>(srgb), 0.0, 1.0);
  const double linear = x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
  return static_cast<std::uint16_t>(std::lround(linear * 65535));
}

using Colour16 = std::array<std::uint16_t, 4>;
Colour16 linear_colour(const glm::vec3& c) {
  return {linear_short(c.r), linear_short(c.g), linear_short(c.b), 65535};
}

bool paints_faces(const PictureData& data, const PictureSettings& settings) {
  return scene_of(data, settings, picture_scale(data, settings)).surface.paint ==
         engine::Paint::kFaces;
}

/// On the colour map, 0 to 1 between the ends.
float place_on(const engine::SurfaceStyle& style, float value) {
  const float width = style.range_max - style.range_min;
  if (!(width > 0)) return 0;
  if (!style.log) return (value - style.range_min) / width;
  const float low = style.range_min + style.log_offset, high = style.range_max + style.log_offset;
  value += style.log_offset;
  return value > 0 ? std::log(value / low) / std::log(high / low) : 0;
}

/// What the view paints, one colour a vertex.
std::vector<Colour16> colours_of(const SceneMesh& mesh, const PictureData& shown,
                                 const PictureData& whole, const PictureSettings& settings) {
  const engine::Scene scene = scene_of(whole, settings, picture_scale(whole, settings));
  const engine::SurfaceStyle& style = scene.surface;
  std::vector<Colour16> colours(mesh.origin.size(), linear_colour(style.colour));
  if (style.paint == engine::Paint::kPlain) return colours;
  const engine::ColourMap* map = engine::find_colour_map(colour_map_of(whole, settings));
  if (map == nullptr) return colours;
  if (style.paint == engine::Paint::kRegions) {
    const auto table = engine::region_table();
    const auto places = region_places(shown);
    for (std::size_t i = 0; i < colours.size(); ++i) {
      const std::int32_t at = places[mesh.origin[i]];
      colours[i] = linear_colour(at < 0 ? engine::kNoValueColour
                                        : glm::vec3(table[static_cast<std::size_t>(at)]));
    }
    return colours;
  }
  for (std::size_t i = 0; i < colours.size(); ++i) {
    const float value = style.paint == engine::Paint::kFaces ? shown.face_values[i / 3]
                                                             : shown.values[mesh.origin[i]];
    const float place = place_on(style, value);
    colours[i] =
        linear_colour(value == kNoPictureValue ? engine::kNoValueColour
                                               : engine::colour_at(*map, place, settings.reverse));
  }
  return colours;
}

std::vector<float> distances_of(const SceneMesh& mesh, const PictureData& data) {
  std::vector<float> out;
  for (const std::uint32_t v : mesh.origin) {
    const double value = data.in_model_units(data.values[v]);
    const bool known = data.values[v] != kNoPictureValue;
    out.push_back(
        known ? static_cast<float>(std::clamp<double>(value, std::numeric_limits<float>::lowest(),
                                                      std::numeric_limits<float>::max()))
              : (data.is_signed || data.is_field ? 0 : kUnreachedDistance));
  }
  return out;
}

GlbJson material_of(bool lit) {
  GlbJson material = {{"doubleSided", true},
                      {"pbrMetallicRoughness", {{"metallicFactor", 0}, {"roughnessFactor", 0.8}}}};
  if (!lit) material["extensions"] = {{"KHR_materials_unlit", GlbJson::object()}};
  return material;
}

/// A mesh of the paths, or none: one primitive a piece that does not end.
GlbJson paths_mesh(const PictureData& data, const ModelSpace& space, GlbBuffer& buffer) {
  GlbJson primitives = GlbJson::array();
  for (const PictureData::Line& line : data.lines) {
    for (std::vector<glm::vec3>& run : engine::finite_runs(scene_vectors(line.points))) {
      if (run.size() < 2) continue;
      for (glm::vec3& point : run) point = space(point);
      const std::vector<Colour16> colours(
          run.size(), linear_colour({line.colour[0], line.colour[1], line.colour[2]}));
      const std::span<const std::uint16_t> shorts(colours.front().data(), 4 * colours.size());
      primitives.push_back(
          {{"attributes",
            {{"POSITION", buffer.add(floats_of(run), 3, kFloat, kVertexData, false, true)},
             {"COLOR_0", buffer.add(shorts, 4, kUnsignedShort, kVertexData, true)}}},
           {"material", 1},
           {"mode", kLineStrip}});
    }
  }
  return primitives;
}

void append_word(std::string& bytes, std::uint64_t word) {
  for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(word >> shift & 255);
}

std::string joined_chunks(std::string json, const std::string& binary) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  std::string bytes;
  append_word(bytes, kMagic);
  append_word(bytes, 2);
  append_word(bytes, 12 + 8 + json.size() + (binary.empty() ? 0 : 8 + binary.size()));
  append_word(bytes, json.size());
  append_word(bytes, kJsonChunk);
  bytes += json;
  if (binary.empty()) return bytes;
  append_word(bytes, binary.size());
  append_word(bytes, kBinaryChunk);
  return bytes + binary;
}

}  // namespace

Result<std::string> glb_file(const PictureData& shown, const PictureData& whole,
                             const PictureSettings& settings, const std::vector<FileText>& texts) {
  const ModelSpace space(whole);
  if (!space.fits()) {
    return Error{ErrorCode::kBadInput,
                 "the model's coordinates are beyond the 32-bit numbers of glTF",
                 {"write .html"}};
  }
  SceneMesh mesh = scene_mesh(shown);
  if (paints_faces(whole, settings)) mesh = separate_corners(mesh);
  const std::vector<Colour16> colours = colours_of(mesh, shown, whole, settings);
  for (glm::vec3& p : mesh.positions) p = space(p);

  GlbBuffer buffer;
  GlbJson meshes = GlbJson::array(), nodes = GlbJson::array(), roots = GlbJson::array();
  const auto add_node = [&](const std::string& name, GlbJson primitives, GlbJson extras) {
    if (primitives.empty()) return;
    meshes.push_back({{"name", name}, {"primitives", std::move(primitives)}});
    if (!extras.empty()) meshes.back()["extras"] = std::move(extras);
    GlbJson node = {{"name", name}, {"mesh", meshes.size() - 1}};
    const Vec3& t = space.translation();
    if (!t.isZero(0)) node["translation"] = {t.x(), t.y(), t.z()};
    roots.push_back(nodes.size());
    nodes.push_back(std::move(node));
  };
  if (!mesh.faces.empty()) {
    const std::span<const std::uint32_t> corners(mesh.faces.front().data(), 3 * mesh.faces.size());
    const std::span<const std::uint16_t> shorts(colours.front().data(), 4 * colours.size());
    GlbJson attributes = {
        {"POSITION", buffer.add(floats_of(mesh.positions), 3, kFloat, kVertexData, false, true)},
        {"COLOR_0", buffer.add(shorts, 4, kUnsignedShort, kVertexData, true)}};
    // Without normals a surface is drawn flat.
    if (settings.view != View::kFlat) {
      attributes["NORMAL"] = buffer.add(floats_of(mesh.normals), 3, kFloat, kVertexData);
    }
    GlbJson extras;
    if (!shown.values.empty()) {
      const std::vector<float> values = distances_of(mesh, shown);
      const bool distances = !shown.is_signed && !shown.is_field;
      attributes[distances        ? "_DISTANCE"
                 : shown.is_field ? "_VALUE"
                                  : "_ERROR"] =
          buffer.add(std::span(values), 1, kFloat, kVertexData, false, true);
      if (distances) extras["unreached"] = kUnreachedDistance;
    }
    add_node("surface",
             {{{"attributes", std::move(attributes)},
               {"indices", buffer.add(corners, 1, kUnsignedInt, kIndexData)},
               {"material", 0},
               {"mode", kTriangles}}},
             std::move(extras));
  }
  add_node("paths", paths_mesh(shown, space, buffer), {});

  const UpAxis up = settings.camera.up == UpAxis::kAuto ? whole.up : settings.camera.up;
  if (up != UpAxis::kAuto && up != UpAxis::kY && !nodes.empty()) {
    const glm::dquat turn = turn_of(up);
    nodes.push_back({{"name", std::string(io::kTurnedRoot) + geotherm::to_text(up)},
                     {"rotation", {turn.x, turn.y, turn.z, turn.w}},
                     {"children", std::move(roots)}});
    roots = GlbJson::array({nodes.size() - 1});
  }

  GlbJson extras = GlbJson::object();
  for (const FileText& text : texts) extras[text.keyword] = text.text;
  const bool lit = settings.light != PictureLight::kNone;
  GlbJson json = {
      {"asset", {{"version", "2.0"}, {"generator", "geotherm"}, {"extras", std::move(extras)}}},
      {"scene", 0}};
  json["scenes"].push_back(GlbJson::object());
  if (!nodes.empty()) {
    json["scenes"][0]["nodes"] = std::move(roots);
    json["nodes"] = std::move(nodes);
    json["materials"] = {material_of(lit)};
    if (!shown.lines.empty()) json["materials"].push_back(material_of(false));
    if (!lit || !shown.lines.empty()) json["extensionsUsed"] = {"KHR_materials_unlit"};
    json["meshes"] = std::move(meshes);
    json["accessors"] = buffer.accessors();
    json["bufferViews"] = buffer.views();
    json["buffers"].push_back({{"byteLength", buffer.bytes().size()}});
  }
  return joined_chunks(json.dump(-1, ' ', false, GlbJson::error_handler_t::replace),
                       buffer.bytes());
}

}  // namespace geotherm::app
