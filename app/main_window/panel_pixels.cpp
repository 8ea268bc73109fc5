// SPDX-License-Identifier: MIT
#include "app/main_window/panel_pixels.h"

#include <imgui.h>

namespace geotherm::app {

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
