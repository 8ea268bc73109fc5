// SPDX-License-Identifier: MIT
// The tools of the left button, above the picture.
#include <imgui.h>
#include <imgui_internal.h>

#include "app/text/text.h"
#include "ui/action.h"
#include "ui/canvas.h"
#include "ui/frame.h"
#include "ui/key_map.h"
#include "ui/widgets.h"

namespace geotherm::ui {
namespace {

struct ToolEntry {
  Tool tool;
  Action action;
  const char* label;
  const char* hint;  ///< what a click does
};
constexpr ToolEntry kToolEntries[] = {
    {Tool::kView, Action::kViewTool, "View", "drag turns, Shift moves, wheel zooms"},
    {Tool::kSource, Action::kSourceTool, "Source",
     "click: source here; Shift adds one; drag moves one"},
    {Tool::kBrush, Action::kBrush, "Brush", "drag paints sources; right drag turns"},
    {Tool::kPath, Action::kPathTool, "Path", "click: paths from here to the source"},
    {Tool::kPick, Action::kPickTool, "Pick", "click: the figures of that point"},
    {Tool::kSculpt, Action::kSculpt, "Sculpt", "drag pulls, Ctrl pushes, Shift smooths"},
};

std::string hint_now(const Frame& frame) {
  if (!frame.model()) return "open a model, or drop one here";
  const auto place = frame.ui.input.pointed(frame);
  if (place && frame.ui.input.tool == Tool::kSource) {
    const app::Explored& explored = frame.explored();
    const auto entry = static_cast<std::size_t>(explored.places[*place].entry);
    return short_name(explored.sources[entry]) + ": drag moves it, Delete removes it";
  }
  for (const ToolEntry& entry : kToolEntries) {
    if (entry.tool == frame.ui.input.tool) return entry.hint;
  }
  return {};
}

}  // namespace

std::string short_name(const app::SourceSpec& source) {
  const auto counted = [](const char* one, const char* many, std::size_t count) {
    return app::counted(static_cast<Index>(count), one, many);
  };
  if (const auto* list = std::get_if<app::VertexList>(&source)) {
    if (list->vertices.size() != 1) return counted("vertex", "vertices", list->vertices.size());
    return "vertex " + std::to_string(list->vertices[0]);
  }
  if (const auto* curve = std::get_if<app::VertexCurve>(&source)) {
    return "curve of " + counted("vertex", "vertices", curve->vertices.size());
  }
  if (std::holds_alternative<app::SurfaceCurve>(source)) return "curve across faces";
  if (const auto* random = std::get_if<app::RandomVertices>(&source)) {
    return std::to_string(random->count) + " random";
  }
  if (const auto* point = std::get_if<app::FacePoint>(&source)) {
    return "point in face " + std::to_string(point->face);
  }
  if (const auto* point = std::get_if<app::SpacePoint>(&source)) {
    return "point " + app::significant(point->position.x(), 3) + ", " +
           app::significant(point->position.y(), 3) + ", " +
           app::significant(point->position.z(), 3);
  }
  if (std::holds_alternative<app::WholeBoundary>(source)) return "the whole boundary";
  return app::to_text(source);
}

void draw_toolbar(Frame& frame) {
  const Rect& place = frame.ui.places.tools;
  frame.section = "Tools";
  const float above = (place.height - ImGui::GetFrameHeight()) / 2;
  if (!begin_bar("##tools", place, {frame.px(6), above}, ImGuiWindowFlags_NoNavInputs)) return;
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {frame.px(3), 0});
  for (const ToolEntry& entry : kToolEntries) {
    const bool on = frame.ui.input.tool == entry.tool;
    if (draw_toggle(frame, {entry.label, entry.label, on, is_possible(frame, entry.action)}, 0) &&
        !on) {
      perform(frame, entry.action);
    }
    draw_tip(frame, std::string(entry.hint) + " (" + std::string(shortcut(entry.action)) + ")");
    ImGui::SameLine();
  }
  const std::string hint = hint_now(frame);
  const float room = ImGui::GetContentRegionAvail().x - frame.px(8);
  if (room > frame.px(60)) {
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + frame.px(8));
    ImGui::AlignTextToFramePadding();
    const ImVec2 low = ImGui::GetCursorScreenPos();
    const float line = ImGui::GetFrameHeight();
    ImGui::PushStyleColor(ImGuiCol_Text, frame.colours().dim);
    ImGui::RenderTextEllipsis(
        ImGui::GetWindowDrawList(), {low.x, low.y + ImGui::GetStyle().FramePadding.y},
        {low.x + room, low.y + line}, low.x + room, low.x + room, hint.c_str(), nullptr, nullptr);
    ImGui::PopStyleColor();
    ImGui::Dummy({room, line});
    draw_tip(frame, hint);
  }
  ImGui::PopStyleVar();
  ImGui::End();
}

}  // namespace geotherm::ui
