// SPDX-License-Identifier: MIT
#include "ui/status_bar.h"

#include <imgui.h>

#include <cmath>

#include "app/answer_check.h"
#include "app/method_words.h"
#include "app/picture/picture_text.h"
#include "app/text.h"
#include "ui/source_edit.h"
#include "ui/widgets.h"

namespace geotherm::ui {
namespace {

std::string what_is_shown(const Frame& frame) {
  if (!frame.model()) return "no model";
  std::vector<std::string> parts = {frame.model()->model.name,
                                    app::to_text(frame.state().picture.view)};
  if (frame.state().kept) {
    constexpr const char* kShown[] = {"A", "B", "A \u2212 B"};
    parts.emplace_back(kShown[static_cast<std::size_t>(frame.state().shown)]);
  }
  if (const app::Answer* answer = frame.answer()) {
    parts.push_back(app::solver_at_work(*answer->method, answer->result));
    parts.push_back("query " + app::milliseconds(answer->result.timing.query) + " ms");
  }
  return app::joined(parts, "  \u00b7  ");
}

/// What the pointer points at.
std::string what_is_there(const Frame& frame) {
  const auto& hovered = frame.ui.input.hovered();
  if (!hovered || !frame.model()) return {};
  const auto figures = app::figures_at(frame.explored(), frame.state().shown, *hovered);
  const auto& value = figures.difference ? figures.difference : figures.distance;
  if (!value) return {};
  const std::string number = std::isfinite(*value) ? app::significant(*value) : "not reached";
  return (figures.difference ? "A \u2212 B = " : "d = ") + number;
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
      ("error " + app::percent(report.figures.mean_relative) + ", " + to_text(report.grade))
          .c_str());
  ImGui::PopStyleColor();
  frame.mark("error");
  draw_tip(frame, app::accuracy_line(report));
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
  return {"", p.dim};
}

}  // namespace

void draw_status_bar(Frame& frame) {
  const Rect& place = frame.ui.places.status;
  if (place.width < 1) return;
  frame.section = "Status";
  ImGui::SetNextWindowPos({place.x, place.y});
  ImGui::SetNextWindowSize({place.width, place.height});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {frame.px(10), 0});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, frame.colours().window);
  ImGui::Begin("##status", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoScrollWithMouse |
                   ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoNavInputs);
  ImGui::PopStyleColor();
  ImGui::PopStyleVar();
  ImGui::AlignTextToFramePadding();

  const std::string fps = app::fixed(frame.canvas.fps(), 0) + " fps";
  const std::string right = fps + "  \u00b7  " + frame.canvas.device();
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
