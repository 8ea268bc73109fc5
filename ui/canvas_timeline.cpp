// SPDX-License-Identifier: MIT
// The timeline of a surface that moves: the bar over the picture, and playing.
#include <imgui.h>

#include <algorithm>

#include "app/text/text.h"
#include "ui/action.h"
#include "ui/canvas.h"
#include "ui/frame.h"
#include "ui/widgets.h"

namespace geotherm::ui {
namespace {

constexpr double kFramesPerSecond = 24;

}  // namespace

bool play(Frame& frame) {
  const app::Timeline& timeline = frame.state().timeline;
  const int frames = frame.model() ? frame.model()->frames : 0;
  if (!timeline.playing || frames == 0) return false;
  for (const app::Command& command : frame.out.commands) {
    if (std::holds_alternative<app::command::Play>(command)) return false;  // it ends now
  }
  if (!frame.session.failure().empty()) {
    frame.send(app::command::Play{false});
    return false;
  }
  if (frame.session.stale()) return false;  // whoever works on the frame wakes the window
  const double now = ImGui::GetTime();
  if (now - frame.ui.played_at < 1 / kFramesPerSecond) return true;
  frame.ui.played_at = now;
  if (timeline.frame + 1 < frames) {
    frame.send(app::command::ShowFrame{timeline.frame + 1});
  } else if (timeline.loop) {
    frame.send(app::command::ShowFrame{0});
  } else {
    frame.send(app::command::Play{false});
  }
  return false;
}

float draw_timeline(Frame& frame) {
  const Rect& canvas = frame.ui.places.canvas;
  const app::Timeline& timeline = frame.state().timeline;
  frame.ui.scrubs = false;
  if (timeline.sequence.empty() || !frame.model() || canvas.width < frame.px(300)) return 0;
  frame.section = "Timeline";
  ImGui::SetNextWindowSize({canvas.width - frame.px(32), 0});
  begin_floating(frame, "##timeline",
                 {canvas.x + frame.px(16), canvas.y + canvas.height - frame.px(34)}, {0, 1});
  const int frames = std::max(1, frame.model()->frames);
  struct Entry {
    const char *key, *label;
    Action action;
    const char* tip;
  };
  const Entry entries[] = {
      {"previous", "\u25c0", Action::kPreviousFrame, "One frame back (,)."},
      {"play", timeline.playing ? "pause" : "play", Action::kPlay,
       "Shows frame after frame, each with its distances (space)."},
      {"next", "\u25b6", Action::kNextFrame, "One frame on (.)."},
      {"loop", "loop", Action::kLoop, "Whether the first frame follows the last (l)."}};
  for (const Entry& entry : entries) {
    const bool sign = entry.label[0] == '\xe2';
    draw_action(frame, entry.key, entry.label, entry.action, entry.tip, frame.px(sign ? 30 : 58));
    ImGui::SameLine();
  }
  int shown = std::min(timeline.frame, frames - 1);
  const std::string last = std::to_string(frames - 1);
  const float close = ImGui::GetFrameHeight(), gap = ImGui::GetStyle().ItemSpacing.x;
  const float widest = ImGui::CalcTextSize((last + " / " + last).c_str()).x;
  const float begin = ImGui::GetCursorPosX();
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted((std::to_string(shown) + " / " + last).c_str());
  frame.mark("number");
  ImGui::SameLine(begin + widest + gap);  // it stays where it is while the number grows
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - close - gap);
  if (ImGui::SliderInt("##frame", &shown, 0, frames - 1, "",
                       ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_NoInput) &&
      shown != timeline.frame) {
    frame.send(app::command::ShowFrame{shown});
  }
  frame.mark("frame");
  frame.ui.scrubs = ImGui::IsItemActive();
  draw_tip(frame, timeline.sequence);
  ImGui::SameLine();
  if (draw_button(frame, "close", "\u00d7", true, close)) {
    frame.send(app::command::ShowSequence{});
  }
  draw_tip(frame, "The model as its file has it.");
  const float top = ImGui::GetWindowPos().y;
  ImGui::End();
  return canvas.y + canvas.height - top;
}

}  // namespace geotherm::ui
