// SPDX-License-Identifier: MIT
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>

#include "app/text.h"
#include "ui/command_line.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace geotherm::ui {
namespace {

using Kind = app::LogLine::Kind;

struct KindRow {
  Kind kind;
  const char* label;
  const char* sign;  ///< before each line
};
constexpr KindRow kKinds[] = {{Kind::kCommand, "commands", ">"},
                              {Kind::kNote, "notes", " "},
                              {Kind::kWarning, "warnings", "!"},
                              {Kind::kError, "errors", "\u2717"}};

ImVec4 colour_of(const Frame& frame, Kind kind) {
  const Palette& p = frame.colours();
  switch (kind) {
    case Kind::kCommand:
      return p.accent;
    case Kind::kWarning:
      return p.warning;
    case Kind::kError:
      return p.error;
    default:
      return p.text;
  }
}

std::vector<const app::LogLine*> shown_lines(const Frame& frame) {
  std::vector<const app::LogLine*> lines;
  for (const app::LogLine& line : frame.session.log()) {
    if (frame.ui.log.shown[static_cast<std::size_t>(line.kind)]) lines.push_back(&line);
  }
  return lines;
}

void draw_filters(Frame& frame, const std::vector<const app::LogLine*>& lines) {
  LogForm& form = frame.ui.log;
  for (const KindRow& row : kKinds) {
    draw_checkbox(frame, row.label, row.label, form.shown[static_cast<std::size_t>(row.kind)]);
    ImGui::SameLine(0, frame.px(12));
  }
  draw_checkbox(frame, "follow", "follow", form.follow);
  ImGui::SameLine(0, frame.px(12));
  if (draw_button(frame, "copy", "Copy")) {
    std::string text;
    for (const app::LogLine* line : lines) (text += line->text) += '\n';
    ImGui::SetClipboardText(text.c_str());
  }
  draw_tip(frame, "Copies the lines that are shown.");
}

void draw_line(Frame& frame, const app::LogLine& line) {
  ImGui::PushStyleColor(ImGuiCol_Text, faded(colour_of(frame, line.kind), 0.8F));
  ImGui::TextUnformatted(kKinds[static_cast<std::size_t>(line.kind)].sign);
  ImGui::PopStyleColor();
  ImGui::SameLine(frame.px(16));
  ImGui::PushStyleColor(ImGuiCol_Text, colour_of(frame, line.kind));
  // One line each, so that a long log costs what is seen of it.
  ImGui::TextUnformatted(app::one_line(line.text).c_str());
  ImGui::PopStyleColor();
  if (ImGui::CalcTextSize(line.text.c_str()).x > ImGui::GetWindowWidth() - frame.px(30)) {
    draw_tip(frame, line.text);
  }
}

}  // namespace

void draw_log_panel(Frame& frame) {
  frame.section = "Log";
  const auto lines = shown_lines(frame);
  draw_filters(frame, lines);
  const float below = ImGui::GetFrameHeightWithSpacing() + command_error_height(frame);
  ImGui::PushStyleColor(ImGuiCol_ChildBg, frame.colours().frame);
  ImGui::BeginChild("lines", {0, -below});
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(lines.size()));
  while (clipper.Step()) {
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) draw_line(frame, *lines[i]);
  }
  LogForm& form = frame.ui.log;
  if (form.follow && frame.session.log().size() != form.drawn) ImGui::SetScrollHereY(1);
  form.drawn = frame.session.log().size();
  ImGui::EndChild();
  ImGui::PopStyleColor();
  draw_command_line(frame);
}

}  // namespace geotherm::ui
