// SPDX-License-Identifier: MIT
#include "ui/work_row.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "app/text.h"
#include "ui/widgets.h"

namespace geotherm::ui {

void draw_progress(Frame& frame, double share, float height) {
  const ImVec2 low = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  ImDrawList* list = ImGui::GetWindowDrawList();
  const float round = height / 2;
  list->AddRectFilled(low, {low.x + width, low.y + height}, packed(frame.colours().frame), round);
  float begin = 0, end = static_cast<float>(std::clamp(share, 0.0, 1.0));
  if (share < 0) {  // a piece that runs to and fro
    begin = 0.375F + 0.375F * static_cast<float>(std::sin(ImGui::GetTime() * 3));
    end = begin + 0.25F;
  }
  list->AddRectFilled({low.x + begin * width, low.y}, {low.x + end * width, low.y + height},
                      packed(frame.colours().accent), round);
  ImGui::Dummy({width, height});
}

void draw_work_row(Frame& frame) {
  const app::SessionWork work = frame.session.work();
  const Palette& p = frame.colours();
  if (!work.busy) {
    if (frame.session.stale())
      draw_note("stale: what is shown belongs to other settings", p.warning);
    return;
  }
  std::string text = work.stage.empty() ? "working" : work.stage;
  if (work.share >= 0) text += "  " + app::fixed(100 * work.share, 0) + " %";
  ImGui::AlignTextToFramePadding();
  ImGui::PushStyleColor(ImGuiCol_Text, p.accent);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopStyleColor();
  const float width = frame.px(70);
  ImGui::SameLine(ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x - width);
  if (draw_button(frame, "cancel", "Cancel", true, width)) frame.out.cancel = true;
  draw_progress(frame, work.share, frame.px(5));
}

}  // namespace geotherm::ui
