// SPDX-License-Identifier: MIT
#include "ui/command_line.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>

#include "app/text.h"
#include "app/told.h"
#include "ui/widgets.h"

namespace geotherm::ui {
namespace {

constexpr std::size_t kMaxPast = 200;

/// Up and down through what was typed before.
int recall(ImGuiInputTextCallbackData* data) {
  LogForm& form = *static_cast<LogForm*>(data->UserData);
  const int count = static_cast<int>(form.past.size());
  if (count == 0) return 0;
  int index = form.recalled < 0 ? count : form.recalled;
  index += data->EventKey == ImGuiKey_UpArrow ? -1 : 1;
  index = std::clamp(index, 0, count);
  form.recalled = index == count ? -1 : index;
  data->DeleteChars(0, data->BufTextLen);
  if (form.recalled >= 0) data->InsertChars(0, form.past[form.recalled].c_str());
  return 0;
}

void run_line(Frame& frame) {
  LogForm& form = frame.ui.log;
  const std::string line(app::trimmed(form.line));
  if (line.empty()) return;
  auto command = app::parse_command(line);
  if (!command) {  // stays in the field to be mended
    form.error = app::told(command.error());
    return;
  }
  form.error.clear();
  frame.ui.write_question.send(frame, *std::move(command));
  form.past.push_back(line);
  if (form.past.size() > kMaxPast) form.past.erase(form.past.begin());
  form.recalled = -1;
  form.line.clear();
}

}  // namespace

float command_error_height(Frame& frame) {
  return frame.ui.log.error.empty() ? 0 : ImGui::GetTextLineHeightWithSpacing();
}

void draw_command_line(Frame& frame) {
  LogForm& form = frame.ui.log;
  if (!form.error.empty()) {
    ImGui::PushStyleColor(ImGuiCol_Text, frame.colours().error);
    ImGui::TextUnformatted(app::one_line(form.error).c_str());
    ImGui::PopStyleColor();
    draw_tip(frame, form.error);
  }
  ImGui::SetNextItemWidth(-FLT_MIN);
  const bool enter = ImGui::InputTextWithHint(
      "##command", "a command, such as: view contours, source add 812, time-factor 2", &form.line,
      ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_CallbackHistory, recall, &form);
  frame.mark("command");
  if (ImGui::IsItemEdited()) form.error.clear();
  if (!enter) return;
  run_line(frame);
  ImGui::SetKeyboardFocusHere(-1);  // for the next one
}

}  // namespace geotherm::ui
