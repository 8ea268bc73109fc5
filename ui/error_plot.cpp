// SPDX-License-Identifier: MIT
#include "ui/error_plot.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "app/text.h"
#include "ui/widgets.h"

namespace geotherm::ui {
namespace {

constexpr float kHeight = 74;  ///< pixels at scale 1

/// The ends of the range under the plot, 0 where it lies between them.
void draw_ends(Frame& frame, const ErrorHistogram& histogram) {
  const std::string low = app::significant(histogram.low, 3);
  const std::string high = app::significant(histogram.high, 3);
  const float left = ImGui::GetCursorPosX();
  const float room = ImGui::GetContentRegionAvail().x;
  ImGui::PushStyleColor(ImGuiCol_Text, frame.colours().dim);
  ImGui::TextUnformatted(low.c_str());
  ImGui::SameLine(left + room - ImGui::CalcTextSize(high.c_str()).x);
  ImGui::TextUnformatted(high.c_str());
  ImGui::PopStyleColor();
}

}  // namespace

void draw_error_plot(Frame& frame, const ErrorHistogram& histogram) {
  const std::size_t bins = histogram.count.size();
  const Index most = bins > 0 ? *std::ranges::max_element(histogram.count) : 0;
  if (most == 0) return;
  const ImVec2 low = ImGui::GetCursorScreenPos();
  const ImVec2 size(std::max(1.0F, ImGui::GetContentRegionAvail().x), frame.px(kHeight));
  ImGui::InvisibleButton("##error plot", size);
  frame.mark("plot");
  ImDrawList* list = ImGui::GetWindowDrawList();
  const float pad = frame.px(4);
  list->AddRectFilled(low, {low.x + size.x, low.y + size.y}, packed(frame.colours().frame),
                      frame.px(4));
  const float column = (size.x - 2 * pad) / static_cast<float>(bins);
  const float bottom = low.y + size.y - pad;
  const double width = (histogram.high - histogram.low) / static_cast<double>(bins);
  for (std::size_t i = 0; i < bins; ++i) {
    // The root makes the few vertices that are far off visible beside the many that are not.
    const auto share = static_cast<float>(
        std::sqrt(static_cast<double>(histogram.count[i]) / static_cast<double>(most)));
    const float x = low.x + pad + column * static_cast<float>(i);
    const double middle = histogram.low + width * (static_cast<double>(i) + 0.5);
    list->AddRectFilled({x, bottom - share * (size.y - 2 * pad)},
                        {x + std::max(1.0F, column - frame.px(1)), bottom},
                        packed(frame.colours().series[middle < 0 ? 2 : 1]));
    const float mouse = ImGui::GetIO().MousePos.x;
    if (ImGui::IsItemHovered() && mouse >= x && mouse < x + column) {
      ImGui::SetTooltip("%s: error %s to %s",
                        app::counted(histogram.count[i], "vertex", "vertices").c_str(),
                        app::significant(middle - width / 2, 3).c_str(),
                        app::significant(middle + width / 2, 3).c_str());
    }
  }
  if (histogram.low < 0 && histogram.high > 0) {
    const auto share = static_cast<float>(-histogram.low / (histogram.high - histogram.low));
    const float x = low.x + pad + share * (size.x - 2 * pad);
    list->AddLine({x, low.y + pad}, {x, bottom}, packed(frame.colours().text), frame.px(1));
  }
  draw_ends(frame, histogram);
}

}  // namespace geotherm::ui
