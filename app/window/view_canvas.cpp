// SPDX-License-Identifier: MIT
#include "app/window/view_canvas.h"

#include <imgui.h>

#include "app/cli/picture_report.h"
#include "app/drawing/picture_camera.h"
#include "engine/scene/colours.h"

namespace geotherm::app {
namespace {

glm::dmat4 to_clip(const engine::Camera& camera) {
  return glm::dmat4(camera.projection) * glm::dmat4(camera.view);
}

glm::dvec3 divided(const glm::dvec4& v) { return glm::dvec3(v) / v.w; }

}  // namespace

ViewCanvas::ViewCanvas(const SceneScreen& screen, const Explored& explored, double fps,
                       float pixels_per_point)
    : screen_(screen), explored_(explored), fps_(fps), pixels_per_point_(pixels_per_point) {}

glm::dvec2 ViewCanvas::in_picture(float x, float y) const {
  return glm::dvec2(x, y) * pixels_per_point_ - glm::dvec2(screen_.area().corner);
}

std::array<float, 2> ViewCanvas::in_window(const glm::dvec2& pixel) const {
  const glm::dvec2 p = (pixel + glm::dvec2(screen_.area().corner)) / pixels_per_point_;
  return {static_cast<float>(p.x), static_cast<float>(p.y)};
}

ViewCanvas::Ray ViewCanvas::ray_at(float x, float y) const {
  const engine::Camera& camera = screen_.camera();
  const glm::dvec2 clip = 2.0 * in_picture(x, y) / glm::dvec2(camera.extent) - 1.0;
  const glm::dmat4 back = glm::inverse(to_clip(camera));
  const glm::dvec3 near = divided(back * glm::dvec4(clip, 1, 1));
  const glm::dvec3 along = divided(back * glm::dvec4(clip, 0, 1)) - near;
  return {{near.x, near.y, near.z}, {along.x, along.y, along.z}};
}

Vec3 ViewCanvas::in_model(const Vec3& scene) const {
  const PictureData& data = screen_.data();
  return data.centre + data.model_per_scene * scene;
}

std::optional<SurfacePoint> ViewCanvas::surface_at(float x, float y) const {
  const auto& model = explored_.model;
  if (!model || !model->rays || !screen_.has_model()) return std::nullopt;
  if (!screen_.has_surface_of(*model)) return std::nullopt;
  Ray ray = ray_at(x, y);
  if (const CutPicture* cut = screen_.cut()) {
    const auto front = screen_.hit_cut(ray.origin, ray.direction);
    if (!front || cut->origin[static_cast<std::size_t>(front->point.face)] == kNoIndex) return {};
    constexpr double kBefore = 1e-5;  // scene units: what is removed lies farther in front
    ray.origin += front->distance * ray.direction - kBefore * ray.direction.normalized();
  }
  const Vec3 origin = in_model(ray.origin);
  const auto hit = model->rays->first_hit(origin, in_model(ray.origin + ray.direction) - origin);
  if (!hit) return std::nullopt;
  return hit->point;
}

std::optional<ui::InsidePoint> ViewCanvas::inside_at(float x, float y) const {
  const CutPicture* cut = screen_.cut();
  if (cut == nullptr || !explored_.model) return std::nullopt;
  if (!screen_.has_surface_of(*explored_.model)) return std::nullopt;
  const Ray ray = ray_at(x, y);
  const auto hit = screen_.hit_cut(ray.origin, ray.direction);
  if (!hit) return std::nullopt;
  const auto face = static_cast<std::size_t>(hit->point.face);
  if (cut->origin[face] != kNoIndex) return std::nullopt;
  ui::InsidePoint inside{in_model(ray.origin + hit->distance * ray.direction), std::nullopt};
  if (cut->data.values.empty()) return inside;
  double value = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const float corner = cut->data.values[cut->data.faces[face][k]];
    if (corner == kNoPictureValue) return inside;
    value += hit->point.weights[k] * double{corner};
  }
  inside.value = cut->data.in_model_units(value);
  return inside;
}

std::optional<std::array<float, 2>> ViewCanvas::place_of(const Vec3& point) const {
  if (explored_.model && !screen_.has_surface_of(*explored_.model)) return std::nullopt;
  const engine::Camera& camera = screen_.camera();
  const PictureData& data = screen_.data();
  const Vec3 p = (point - data.centre) / data.model_per_scene;
  const glm::dvec4 clip = to_clip(camera) * glm::dvec4(p[0], p[1], p[2], 1);
  if (!(clip.w > 0)) return std::nullopt;
  const glm::dvec2 device = glm::dvec2(clip) / clip.w;
  return in_window((device + 1.0) / 2.0 * glm::dvec2(camera.extent));
}

std::array<float, 2> ViewCanvas::lens_centre() const {
  return in_window(app::lens_centre(screen_.area().extent, screen_.insets()));
}

float ViewCanvas::title_height() const {
  return static_cast<float>(double{screen_.insets().top} / pixels_per_point_);
}

std::optional<command::Place> ViewCanvas::tight() const {
  if (!screen_.has_model()) return std::nullopt;
  const CameraSettings camera = screen_.tight_camera();
  return command::Place{camera.azimuth, camera.elevation, camera.zoom, camera.pan_right,
                        camera.pan_up};
}

std::vector<std::string> ViewCanvas::colour_maps() const {
  std::vector<std::string> names;
  for (const engine::ColourMap& map : engine::colour_maps()) names.emplace_back(map.name);
  return names;
}

std::string ViewCanvas::device() const { return device_in_words(screen_.device()); }

engine::PanelFont panel_font(std::uint64_t version) {
  ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
  unsigned char* pixels = nullptr;
  engine::PanelFont font;
  fonts.GetTexDataAsAlpha8(&pixels, &font.width, &font.height);
  const auto count = static_cast<std::size_t>(font.width) * static_cast<std::size_t>(font.height);
  font.pixels.assign(pixels, pixels + count);
  font.version = version;
  return font;
}

engine::PanelDraw panel_draw() {
  engine::PanelDraw out;
  const ImDrawData* const data = ImGui::GetDrawData();
  if (data == nullptr || !data->Valid) return out;
  const glm::vec2 origin(data->DisplayPos.x, data->DisplayPos.y);
  const glm::vec2 scale(data->FramebufferScale.x, data->FramebufferScale.y);
  out.vertices.reserve(static_cast<std::size_t>(data->TotalVtxCount));
  out.indices.reserve(static_cast<std::size_t>(data->TotalIdxCount));
  for (int i = 0; i < data->CmdListsCount; ++i) {
    const ImDrawList& list = *data->CmdLists[i];
    const auto first_vertex = static_cast<std::int32_t>(out.vertices.size());
    const auto first_index = static_cast<std::uint32_t>(out.indices.size());
    for (const ImDrawVert& v : list.VtxBuffer) {
      out.vertices.push_back(
          {(glm::vec2(v.pos.x, v.pos.y) - origin) * scale, {v.uv.x, v.uv.y}, v.col});
    }
    out.indices.insert(out.indices.end(), list.IdxBuffer.begin(), list.IdxBuffer.end());
    for (const ImDrawCmd& command : list.CmdBuffer) {
      if (command.UserCallback != nullptr || command.ElemCount == 0) continue;
      const ImVec4& clip = command.ClipRect;
      out.commands.push_back({{(clip.x - origin.x) * scale.x, (clip.y - origin.y) * scale.y,
                               (clip.z - origin.x) * scale.x, (clip.w - origin.y) * scale.y},
                              first_index + command.IdxOffset,
                              command.ElemCount,
                              first_vertex + static_cast<std::int32_t>(command.VtxOffset)});
    }
  }
  return out;
}

}  // namespace geotherm::app
