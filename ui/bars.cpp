// SPDX-License-Identifier: MIT
#include "ui/panels.h"

#include <imgui.h>
#include <algorithm>
#include <cmath>

#include "app/picture/picture_text.h"
#include "app/session/check.h"
#include "app/session/wording.h"
#include "app/text/text.h"
#include "ui/action.h"
#include "ui/source_edit.h"
#include "ui/widgets.h"

namespace geotherm::ui {
namespace {

constexpr float kGrip = 5;       ///< width of an edge that can be dragged, pixels at scale 1
constexpr float kMaxBar = 900;   ///< pixels at scale 1
constexpr float kMaxLog = 1000;  ///< pixels at scale 1

/// Tab moves through the fields of a bar while one of them is typed in, and is a key of the picture
/// otherwise; ImGui would start with the first field.
ImGuiWindowFlags tab_flag() {
  return ImGui::GetIO().WantTextInput ? ImGuiWindowFlags_None : ImGuiWindowFlags_NoNavInputs;
}

/// An edge. True while it is dragged.
bool draw_grip(Frame& frame, const char* name, ImVec2 at, ImVec2 size) {
  ImGui::SetCursorScreenPos(at);
  ImGui::InvisibleButton(name, size);
  frame.section = "Bars";
  frame.mark(name);
  const bool upright = size.y > size.x;
  const bool lit = ImGui::IsItemHovered() || ImGui::IsItemActive();
  if (lit) {
    ImGui::SetMouseCursor(upright ? ImGuiMouseCursor_ResizeEW : ImGuiMouseCursor_ResizeNS);
  }
  const Palette& p = frame.colours();
  const float line = std::max(1.0F, frame.px(lit ? 2 : 1));
  const ImVec2 middle(at.x + (size.x - line) / 2, at.y + (size.y - line) / 2);
  ImGui::GetWindowDrawList()->AddRectFilled(
      {upright ? middle.x : at.x, upright ? at.y : middle.y},
      {upright ? middle.x + line : at.x + size.x, upright ? at.y + size.y : middle.y + line},
      packed(lit ? p.accent : p.border));
  return ImGui::IsItemActive();
}

/// The part of a bar that scrolls.
template <class Draw>
void draw_inside(Frame& frame, ImVec2 at, ImVec2 size, Draw draw) {
  ImGui::SetCursorScreenPos(at);
  if (size.x < 1 || size.y < 1) return;
  ImGui::BeginChild("inside", size, false, ImGuiWindowFlags_AlwaysUseWindowPadding | tab_flag());
  draw(frame);
  ImGui::EndChild();
}

void draw_left(Frame& frame) {
  const Rect& place = frame.ui.places.left;
  if (!begin_bar("##left", place, {0, 0}, tab_flag())) return;
  const float grip = frame.px(kGrip);
  draw_inside(frame, {place.x, place.y}, {place.width - grip, place.height}, [](Frame& inside) {
    draw_view_panel(inside);
    draw_sources_panel(inside);
    draw_solver_panel(inside);
    draw_ab_panel(inside);
    draw_model_panel(inside);
  });
  if (draw_grip(frame, "left edge", {place.x + place.width - grip, place.y},
                {grip, place.height})) {
    const float width = (ImGui::GetIO().MousePos.x + grip / 2) / frame.ui.scale;
    frame.ui.layout.left_width = std::clamp(width, kMinBar, kMaxBar);
  }
  ImGui::End();
}

void draw_right(Frame& frame) {
  const Rect& place = frame.ui.places.right;
  if (!begin_bar("##right", place, {0, 0}, tab_flag())) return;
  const float grip = frame.px(kGrip);
  draw_inside(frame, {place.x + grip, place.y}, {place.width - grip, place.height},
              [](Frame& inside) {
                draw_point_panel(inside);
                draw_error_panel(inside);
                draw_quality_panel(inside);
                draw_timing_panel(inside);
                draw_compare_panel(inside);
              });
  if (draw_grip(frame, "right edge", {place.x, place.y}, {grip, place.height})) {
    const float all = ImGui::GetIO().DisplaySize.x;
    const float width = (all - ImGui::GetIO().MousePos.x + grip / 2) / frame.ui.scale;
    frame.ui.layout.right_width = std::clamp(width, kMinBar, kMaxBar);
  }
  ImGui::End();
}

void draw_log(Frame& frame) {
  const Rect& place = frame.ui.places.log;
  if (!begin_bar("##log", place, {0, 0}, tab_flag())) return;
  const float grip = frame.px(kGrip);
  draw_inside(frame, {place.x, place.y + grip}, {place.width, place.height - grip}, draw_log_panel);
  if (draw_grip(frame, "log edge", {place.x, place.y}, {place.width, grip})) {
    const float bottom = place.y + place.height;
    const float height = (bottom - ImGui::GetIO().MousePos.y + grip / 2) / frame.ui.scale;
    frame.ui.layout.log_height = std::clamp(height, kMinLog, kMaxLog);
  }
  ImGui::End();
}

}  // namespace

void draw_side_bars(Frame& frame) {
  draw_left(frame);
  draw_right(frame);
  draw_log(frame);
}

namespace {

std::string what_is_shown(const Frame& frame) {
  if (!frame.model()) return "no model";
  // Figures stand in the panels; what the window's title lacks is said here.
  std::string text = geotherm::to_text(frame.state().picture.view);
  const app::Answer* answer = frame.answer();
  if (answer == nullptr) return text;
  return text + "  \u00b7  " + app::solver_at_work(*answer->method, answer->result);
}

/// What the pointer points at.
std::string what_is_there(const Frame& frame) {
  const auto& hovered = frame.ui.input.hovered();
  if (!hovered || !frame.model()) return {};
  const auto figures = app::figures_at(frame.explored(), frame.state().shown, *hovered);
  const auto value = value_shown(figures, frame.state().shown);
  if (!value) return {};
  const std::string number = std::isfinite(*value) ? app::significant(*value) : "not reached";
  return (frame.state().shown == app::Shown::kDifference ? "A \u2212 B = " : "d = ") + number;
}

/// How wrong what is shown is, where that is known.
void draw_error(Frame& frame) {
  const app::Answer* answer = frame.answer();
  if (!answer || !answer->error || !answer->error->measured) return;
  const AccuracyReport& report = *answer->error;
  ImGui::SameLine(0, frame.px(18));
  ImGui::PushStyleColor(ImGuiCol_Text,
                        report.is_poor() ? frame.colours().warning : frame.colours().dim);
  ImGui::TextUnformatted(
      ("error " + percent_text(report.figures.mean_relative) + ", " + to_text(report.grade))
          .c_str());
  ImGui::PopStyleColor();
  frame.mark("error");
  if (ImGui::IsItemClicked()) show_figures(frame, kErrorSection);
  draw_tip(frame, sentence(app::accuracy_line(report)) + ". A click shows its figures.");
}

struct State {
  std::string text;
  ImVec4 colour;
};
State what_goes_on(const Frame& frame) {
  const Palette& p = frame.colours();
  const app::SessionWork work = frame.session.work();
  if (work.busy) {
    std::string text = work.stage.empty() ? "working" : work.stage;
    if (work.share >= 0) text += " " + app::fixed(100 * work.share, 0) + " %";
    return {text + "\u2026", p.accent};
  }
  if (!frame.session.failure().empty()) return {"failed", p.error};
  if (frame.session.stale()) return {"stale", p.warning};
  if (ImGui::GetTime() < frame.ui.says_written_until) return {frame.ui.written, p.good};
  return {"", p.dim};
}

}  // namespace

void draw_status_bar(Frame& frame) {
  const Rect& place = frame.ui.places.status;
  frame.section = "Status";
  ImGui::PushStyleColor(ImGuiCol_WindowBg, frame.colours().window);
  const bool shown = begin_bar("##status", place, {frame.px(10), 0}, ImGuiWindowFlags_NoNavInputs);
  ImGui::PopStyleColor();
  if (!shown) return;
  ImGui::AlignTextToFramePadding();

  // A picture that rests has no rate.
  const bool moves = frame.state().rotating || frame.state().timeline.playing || frame.ui.scrubs ||
                     frame.ui.input.is_dragging();
  const bool rests = !moves || frame.canvas.fps() < 1;
  const std::string fps = rests ? "" : app::fixed(frame.canvas.fps(), 0) + " fps";
  const std::string right = fps + (rests ? "" : "  \u00b7  ") + frame.canvas.device();
  const float room = ImGui::GetContentRegionAvail().x;
  ImGui::PushStyleColor(ImGuiCol_Text, frame.colours().dim);
  ImGui::TextUnformatted(what_is_shown(frame).c_str());
  ImGui::PopStyleColor();
  frame.mark("shown");
  draw_error(frame);
  const State state = what_goes_on(frame);
  if (!state.text.empty()) {
    ImGui::SameLine(0, frame.px(18));
    ImGui::PushStyleColor(ImGuiCol_Text, state.colour);
    ImGui::TextUnformatted(state.text.c_str());
    ImGui::PopStyleColor();
    frame.mark("work");
    draw_tip(frame, frame.session.failure());
  }
  const std::string there = what_is_there(frame);
  if (!there.empty()) {
    ImGui::SameLine(0, frame.px(18));
    ImGui::TextUnformatted(there.c_str());
  }
  // What does not fit beside the left part: the device's long name first, then all of it.
  const float left = ImGui::GetItemRectMax().x - place.x;
  for (const std::string& text : {right, fps}) {
    const float width = ImGui::CalcTextSize(text.c_str()).x;
    if (left + frame.px(18) + width > room) continue;
    ImGui::SameLine(room - width + frame.px(10));
    ImGui::PushStyleColor(ImGuiCol_Text, frame.colours().dim);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopStyleColor();
    draw_tip(frame, right);
    break;
  }
  ImGui::End();
}

}  // namespace geotherm::ui
