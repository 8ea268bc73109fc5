// SPDX-License-Identifier: MIT
#include "app/text/text.h"

#include <imgui.h>
#include <imgui_internal.h>
#include <imgui_stdlib.h>
#include <algorithm>

#include "ui/key_map.h"
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

/// Goes on in the same line where a box or a button with that label has room there.
void continue_line(Frame& frame, const char* label) {
  ImGui::SameLine(0, frame.px(12));
  const float width =
      ImGui::GetFrameHeight() + ImGui::GetStyle().ItemInnerSpacing.x + ImGui::CalcTextSize(label).x;
  if (ImGui::GetContentRegionAvail().x < width) ImGui::NewLine();
}

void draw_filters(Frame& frame, const std::vector<const app::LogLine*>& lines) {
  LogForm& form = frame.ui.log;
  for (const KindRow& row : kKinds) {
    if (&row != kKinds) continue_line(frame, row.label);
    draw_checkbox(frame, row.label, row.label, form.shown[static_cast<std::size_t>(row.kind)]);
  }
  continue_line(frame, "follow");
  draw_checkbox(frame, "follow", "follow", form.follow);
  continue_line(frame, "Copy");
  if (draw_button(frame, "copy", "Copy")) {
    std::string text;
    for (const app::LogLine* line : lines) (text += sentence(line->text, line->hint)) += '\n';
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
  const std::string text = sentence(line.text, line.hint);
  ImGui::TextUnformatted(app::one_line(text).c_str());
  ImGui::PopStyleColor();
  if (ImGui::CalcTextSize(text.c_str()).x > ImGui::GetWindowWidth() - frame.px(30)) {
    draw_tip(frame, text);
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
  const bool changed = frame.session.log().size() != form.drawn || below != form.below;
  if (form.follow && changed) ImGui::SetScrollHereY(1);
  form.drawn = frame.session.log().size();
  form.below = below;
  ImGui::EndChild();
  ImGui::PopStyleColor();
  draw_command_line(frame);
}

namespace {

constexpr std::size_t kMaxPast = 200;

/// The word before the cursor, as far as all that it may become agree.
void complete(ImGuiInputTextCallbackData* data, LogForm& form) {
  const std::string_view line(data->Buf, static_cast<std::size_t>(data->CursorPos));
  const auto words = app::completions(line);
  form.choices.clear();
  if (words.empty()) return;
  std::string common = words.front();
  for (const std::string& word : words) {
    const auto [end, other] = std::ranges::mismatch(common, word);
    common.erase(end, common.end());
  }
  const std::size_t blank = line.rfind(' ');
  const std::size_t begun = line.size() - (blank == std::string_view::npos ? 0 : blank + 1);
  if (words.size() == 1) {
    // What follows a folder or a kind of source belongs to the same word.
    if (!common.ends_with('/') && !common.ends_with(':')) common += ' ';
  } else {
    form.choices = app::joined(words, "  ");
  }
  data->InsertChars(data->CursorPos, common.c_str() + begun);
}

/// Tab completes; up and down lead through what was typed before.
int recall(ImGuiInputTextCallbackData* data) {
  LogForm& form = *static_cast<LogForm*>(data->UserData);
  if (data->EventFlag == ImGuiInputTextFlags_CallbackCompletion) {
    complete(data, form);
    return 0;
  }
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
    form.error = sentence(command.error());
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
  const LogForm& form = frame.ui.log;
  if (form.error.empty()) return form.choices.empty() ? 0 : ImGui::GetTextLineHeightWithSpacing();
  const float width = ImGui::GetContentRegionAvail().x;
  return ImGui::CalcTextSize(app::one_line(form.error).c_str(), nullptr, false, width).y +
         ImGui::GetStyle().ItemSpacing.y;
}

void draw_command_line(Frame& frame) {
  LogForm& form = frame.ui.log;
  if (!form.error.empty()) {
    draw_note(app::one_line(form.error), frame.colours().error);
    frame.mark("error");
  } else if (!form.choices.empty()) {
    ImGui::PushStyleColor(ImGuiCol_Text, frame.colours().dim);
    ImGui::TextUnformatted(form.choices.c_str());
    ImGui::PopStyleColor();
    draw_tip(frame, form.choices);
  }
  ImGui::SetNextItemWidth(-FLT_MIN);
  const bool enter = ImGui::InputTextWithHint(
      "##command", "a command, such as: view contours, source add 812, time-factor 2", &form.line,
      ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_CallbackHistory |
          ImGuiInputTextFlags_CallbackCompletion,
      recall, &form);
  frame.mark("command");
  if (ImGui::IsItemEdited()) {
    form.error.clear();
    if (!ImGui::IsKeyPressed(kKeyTab)) form.choices.clear();
  }
  if (!enter) return;
  run_line(frame);
  ImGui::SetKeyboardFocusHere(-1);  // for the next one
}

}  // namespace geotherm::ui
