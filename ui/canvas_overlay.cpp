// SPDX-License-Identifier: MIT
#include "ui/canvas.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "app/session/model.h"
#include "app/session/wording.h"
#include "app/text/text.h"
#include "ui/action.h"
#include "ui/panels.h"
#include "ui/source_edit.h"
#include "ui/widgets.h"

namespace geotherm::ui {
namespace {

constexpr double kNoticeTime = 12;  ///< seconds
constexpr std::size_t kMaxNotices = 3;
constexpr float kNoticesShare = 0.45F;  ///< of the height of the picture, whose middle stays free

void draw_centred(const char* text) {
  const float width = ImGui::CalcTextSize(text).x;
  ImGui::SetCursorPosX(std::max(0.0F, (ImGui::GetWindowWidth() - width) / 2));
  ImGui::TextUnformatted(text);
}

/// A window in the middle of the picture. False: there is no room for it.
bool begin_middle(Frame& frame, const char* name, float width) {
  const Rect& canvas = frame.ui.places.canvas;
  width = std::min(frame.px(width), canvas.width - frame.px(16));
  if (width < frame.px(120) || canvas.height < frame.px(120)) return false;
  ImGui::SetNextWindowSizeConstraints({width, 0}, {width, canvas.height - frame.px(8)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {frame.px(20), frame.px(18)});
  begin_floating(frame, name, {canvas.x + canvas.width / 2, canvas.y + canvas.height / 2},
                 {0.5F, 0.5F});
  ImGui::PopStyleVar();
  return true;
}

void draw_hint(Frame& frame) {
  frame.section = "Hint";
  if (!begin_middle(frame, "##hint", 400)) return;
  if (big_font()) ImGui::PushFont(big_font());
  draw_centred("Drop a model here");
  if (big_font()) ImGui::PopFont();
  ImGui::PushStyleColor(ImGuiCol_Text, frame.colours().dim);
  draw_centred(".obj  .ply  .off  .stl  .glb  and others");
  ImGui::PopStyleColor();
  ImGui::Dummy({0, frame.px(4)});
  const float room = ImGui::GetContentRegionAvail().x;
  if (draw_button(frame, "open", "Open a file\u2026   Ctrl+O", true, room)) {
    perform(frame, Action::kOpenModel);
  }
  ImGui::Dummy({0, frame.px(4)});
  draw_dim(frame, "or a bundled one:");
  const float width = button_width(3);
  int column = 0;
  for (const app::BundledModel& model : app::bundled_models()) {
    if (column++ % 3 != 0) ImGui::SameLine();
    const std::string name(model.name);
    if (draw_button(frame, name, name.c_str(), true, width)) frame.send(app::command::Open{name});
    draw_tip(frame, model.feature);
  }
  ImGui::Dummy({0, frame.px(4)});
  draw_dim(frame, "F1 shows all keys.");
  ImGui::End();
}

/// Over an empty picture while the first model is read.
void draw_reading(Frame& frame) {
  frame.section = "Reading";
  if (!begin_middle(frame, "##reading", 340)) return;
  const app::SessionWork work = frame.session.work();
  draw_centred((work.stage.empty() ? std::string("working") : work.stage).c_str());
  draw_dim(frame, frame.state().model);
  draw_progress(frame, work.share, frame.px(5));
  if (draw_button(frame, "cancel", "Cancel", true, ImGui::GetContentRegionAvail().x)) {
    frame.out.cancel = true;
  }
  ImGui::End();
}

/// A small label on the picture, its middle at `at`.
Rect draw_badge(Frame& frame, ImVec2 at, const std::string& text) {
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const ImVec2 pad(frame.px(9), frame.px(3));
  const ImVec2 low(std::floor(at.x - size.x / 2 - pad.x), std::floor(at.y - size.y / 2 - pad.y));
  const ImVec2 high(low.x + size.x + 2 * pad.x, low.y + size.y + 2 * pad.y);
  ImDrawList* list = ImGui::GetBackgroundDrawList();
  list->AddRectFilled(low, high, packed(faded(frame.colours().panel, 0.92F)), frame.px(4));
  list->AddRect(low, high, packed(frame.colours().border), frame.px(4));
  list->AddText({low.x + pad.x, low.y + pad.y}, packed(frame.colours().text), text.c_str());
  return {low.x, low.y, high.x - low.x, high.y - low.y};
}

void draw_shown_badge(Frame& frame) {
  if (!frame.state().kept || !frame.model()) return;
  constexpr const char* kShown[] = {"A", "B", "A \u2212 B"};
  std::string text = kShown[static_cast<std::size_t>(frame.state().shown)];
  const auto& difference = frame.explored().difference;
  const bool equal = difference && difference->most == 0;
  if (equal && frame.state().shown == app::Shown::kDifference) text += "  \u00b7  equal";
  const Rect& canvas = frame.ui.places.canvas;
  const float down = frame.ui.input.tool == Tool::kSculpt ? 62 : 20;  // below the bar of the tools
  const float middle = std::max(frame.px(down), frame.canvas.title_height() + frame.px(14));
  frame.ui.items["Picture/shown"] =
      draw_badge(frame, {canvas.x + canvas.width / 2, canvas.y + middle}, text);
}

void draw_picked(Frame& frame) {
  const auto& picked = frame.state().picked;
  if (!picked || !frame.model()) return;
  const auto point = surface_point(*picked, frame.model()->model.mesh->face_count());
  if (!point) return;
  const auto figures = app::figures_at(frame.explored(), frame.state().shown, *point);
  const auto seen = frame.canvas.place_of(figures.position);
  if (!seen || is_hidden(frame, figures.position, *seen)) return;
  const ImVec2 at((*seen)[0], (*seen)[1]);
  ImDrawList* list = ImGui::GetBackgroundDrawList();
  const float arm = frame.px(9);
  const auto cross = [&](ImU32 colour, float thick) {
    list->AddLine({at.x - arm, at.y}, {at.x + arm, at.y}, colour, frame.px(thick));
    list->AddLine({at.x, at.y - arm}, {at.x, at.y + arm}, colour, frame.px(thick));
  };
  cross(packed({0, 0, 0, 0.65F}), 4);
  cross(packed({1, 1, 1, 1}), 2);
  const auto value = value_shown(figures, frame.state().shown);
  if (!value) return;
  const std::string text = std::isfinite(*value) ? app::significant(*value) : "not reached";
  draw_badge(frame, {at.x, at.y - frame.px(24)}, text);
}

/// What a click takes care of; the notice goes with it.
void draw_buttons(Frame& frame, Notice& notice) {
  ImGui::PushID(&notice);
  if (!notice.sources.empty() && draw_button(frame, "bring back", "Bring them back")) {
    frame.send(app::command::SetSources{notice.sources});
    notice.until = 0;
  }
  if (draw_remedies(frame, notice.settings, false)) notice.until = 0;
  ImGui::PopID();
}

}  // namespace

void draw_notices(Frame& frame, float below) {
  auto& notices = frame.ui.notices;
  for (Notice& notice : notices) {  // an undo brings sources back, too
    if (notice.sources.empty()) continue;
    if (notice.sources != frame.state().sources) {
      notice.replaced = true;
    } else if (notice.replaced) {
      notice.until = 0;
    }
  }
  std::erase_if(notices, [&frame](const Notice& notice) {
    const bool mended = notice.of_failure && frame.session.failure() != notice.text;
    return mended || notice.until < ImGui::GetTime();
  });
  const Rect& canvas = frame.ui.places.canvas;
  const float width = std::min(frame.px(460), canvas.width - frame.px(24));
  if (notices.empty() || width < frame.px(100)) return;
  frame.section = "Notices";
  ImGui::SetNextWindowSizeConstraints({width, 0},
                                      {width, std::max(1.0F, canvas.height * kNoticesShare)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, ImGui::GetStyle().FrameBorderSize);
  begin_floating(frame, "##notices",
                 {canvas.x + canvas.width / 2, canvas.y + canvas.height - below - frame.px(12)},
                 {0.5F, 1});
  ImGui::PopStyleVar();
  for (Notice& notice : notices) {
    const Palette& p = frame.colours();
    const bool error = notice.kind == app::LogLine::Kind::kError;
    draw_note(notice.text, error ? p.error : p.text);
    draw_buttons(frame, notice);
  }
  const float button = frame.px(70);
  if (draw_button(frame, "close", "Close", true, button)) notices.clear();
  ImGui::SameLine();
  if (draw_button(frame, "log", "Log", true, button)) {
    notices.clear();
    frame.ui.layout.log = true;
  }
  ImGui::End();
}

void take_notices(Frame& frame) {
  const auto log = frame.session.log();
  std::size_t& taken = frame.ui.notified;
  // The session forgets the oldest lines of a long log at times; only the newest is new then.
  if (taken > log.size()) taken = log.size() - std::min<std::size_t>(1, log.size());
  for (; taken < log.size(); ++taken) {
    const app::LogLine& line = log[taken];
    if (line.has_written) {
      frame.ui.written = line.text;
      frame.ui.says_written_until = ImGui::GetTime() + kNoticeTime;
    }
    if (line.kind != app::LogLine::Kind::kError) continue;
    auto& notices = frame.ui.notices;
    std::string text = sentence(line.text, line.hint);
    std::erase_if(notices, [&](const Notice& notice) { return notice.text == text; });
    Notice notice{text, line.kind, ImGui::GetTime() + kNoticeTime, settings_of(line.hint)};
    notice.of_failure = text == frame.session.failure();
    notices.push_back(std::move(notice));
    if (notices.size() > kMaxNotices) notices.erase(notices.begin());
  }
}

void draw_canvas_overlay(Frame& frame) {
  if (!frame.model()) {
    if (frame.session.work().busy) {
      draw_reading(frame);
    } else {
      draw_hint(frame);
    }
  }
  draw_shown_badge(frame);
  draw_picked(frame);
}

}  // namespace geotherm::ui
