// SPDX-License-Identifier: MIT
#include <imgui.h>
#include <imgui_stdlib.h>

#include <cfloat>

#include "app/session/progress.h"
#include "app/text/text.h"
#include "ui/dialogs.h"
#include "ui/file_dialog.h"
#include "ui/key_map.h"
#include "ui/widgets.h"

namespace geotherm::ui {
namespace {

constexpr const char* kName = "files";

}  // namespace

void FileDialog::draw(Frame& frame) {
  frame.section = "Files";
  if (asked_) ImGui::OpenPopup(kName);
  asked_ = false;
  if (!begin_dialog(frame, kName, task_->title, 700, 500)) return;
  done_ = false;
  draw_folder(frame);
  draw_entries(frame, -height_below(frame));
  if (!replaced_.empty()) {
    draw_question(frame);
  } else {
    draw_name(frame);
    draw_formats(frame);
    if (task_->action == Action::kSavePicture) draw_picture_options(frame);
    draw_buttons(frame);
  }
  if (done_) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
}

void FileDialog::draw_folder(Frame& frame) {
  if (draw_button(frame, "up", "\u2191 Up", folder_.has_parent_path())) {
    enter(folder_.parent_path());
  }
  ImGui::SameLine();
  if (draw_button(frame, "home", "Home")) enter(typed_path("~", folder_));
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-FLT_MIN);
  if (const auto typed = draw_field(frame, "folder", folder_.string())) {
    enter(typed_path(*typed, folder_));
  }
}

void FileDialog::draw_entries(Frame& frame, float height) {
  ImGui::PushStyleColor(ImGuiCol_ChildBg, frame.colours().frame);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {frame.px(6), frame.px(4)});
  ImGui::BeginChild("entries", {0, height}, true);
  ImGui::PopStyleVar();
  if (listing_.entries.empty()) {
    draw_dim(frame, all_files_ ? "Nothing here." : "No folder and no file of this kind here.");
  }
  std::filesystem::path into;
  bool taken = false;
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(listing_.entries.size()));
  while (clipper.Step()) {
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
      const FolderEntry& entry = listing_.entries[i];
      const std::string label = (entry.is_folder ? "\u25b8 " : "    ") + entry.name +
                                (entry.is_folder ? "/" : "") + "##" + entry.name;
      const bool clicked = ImGui::Selectable(label.c_str(), !entry.is_folder && entry.name == name_,
                                             ImGuiSelectableFlags_AllowDoubleClick);
      frame.mark(entry.name);
      if (clicked && entry.is_folder) into = folder_ / entry.name;
      if (clicked && !entry.is_folder) {
        name_ = entry.name;
        replaced_.clear();
        taken = ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
      }
      if (entry.is_folder) continue;
      const std::string size = app::bytes_in_words(static_cast<double>(entry.bytes));
      const float width = ImGui::CalcTextSize(size.c_str()).x;
      ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - width);
      ImGui::TextDisabled("%s", size.c_str());
    }
  }
  ImGui::EndChild();
  ImGui::PopStyleColor();
  if (!into.empty()) enter(into);
  if (taken) accept(frame);
}

void FileDialog::draw_name(Frame& frame) {
  draw_label(frame, "name");
  if (take_focus_) ImGui::SetKeyboardFocusHere();
  take_focus_ = false;
  const bool enter_pressed = ImGui::InputText(
      "##name", &name_, ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
  frame.mark("name");
  if (ImGui::IsItemEdited()) error_ = listing_.error;
  if (enter_pressed) accept(frame);
}

void FileDialog::draw_formats(Frame& frame) {
  if (task_->saves) {
    draw_label(frame, "format");
    for (const std::string_view extension : task_->extensions) {
      const std::string text(extension);
      const bool on = has_extension(name_, {&extension, 1});
      if (draw_toggle(frame, {text, text.c_str(), on}, frame.px(90))) {
        name_ = std::filesystem::path(name_).replace_extension(text).string();
      }
      ImGui::SameLine();
    }
  } else {
    draw_label(frame, "files", "Listed are " + app::joined(task_->extensions, " "));
  }
  if (draw_checkbox(frame, "all files", "list all files", all_files_)) list();
}

void FileDialog::draw_picture_options(Frame& frame) {
  draw_label(frame, "size");
  ImGui::BeginDisabled(!is_of_pixels());
  draw_checkbox(frame, "panels", "with the panels", panels_);
  ImGui::EndDisabled();
  ImGui::SameLine(0, frame.px(16));
  if (draw_checkbox(frame, "as shown", "as shown", as_shown_)) error_ = listing_.error;
  if (as_shown_) return;
  ImGui::SameLine(0, frame.px(16));
  ImGui::SetNextItemWidth(-FLT_MIN);
  ImGui::InputText("##size", &size_);
  frame.mark("size");
  if (ImGui::IsItemEdited()) error_ = listing_.error;
  draw_tip(frame, "Pixels, such as 1600x1200, or on paper, such as 8.5cmx6cm.");
}

void FileDialog::draw_buttons(Frame& frame) {
  draw_note(error_.empty() ? " " : error_, frame.colours().error);
  const float width = frame.px(110);
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  ImGui::SetCursorPosX(ImGui::GetWindowContentRegionMax().x - 2 * width - gap);
  if (draw_button(frame, "cancel", "Cancel", true, width) || is_escape_pressed()) done_ = true;
  ImGui::SameLine();
  if (draw_button(frame, "accept", task_->verb, !name_.empty(), width)) accept(frame);
  // Enter in the field has been dealt with there.
  if (!done_ && !ImGui::GetIO().WantTextInput && is_enter_pressed()) accept(frame);
}

void FileDialog::draw_question(Frame& frame) {
  const std::string name = replaced_.filename().string();
  draw_note(name + " is there already. Replace it?", frame.colours().warning);
  frame.mark("replaces " + name);
  const float width = frame.px(110);
  if (draw_button(frame, "replace", "Replace", true, width) || is_enter_pressed()) accept(frame);
  ImGui::SameLine();
  if (draw_button(frame, "keep", "Keep", true, width) || is_escape_pressed()) {
    replaced_.clear();
    take_focus_ = true;
  }
}

float FileDialog::height_below(const Frame& frame) const {
  const float line = ImGui::GetFrameHeightWithSpacing();
  if (!replaced_.empty()) return 2 * line + frame.px(4);
  const float rows = task_->action == Action::kSavePicture ? 4 : 3;
  // A message may need two lines.
  const float messages = error_.empty() ? 1 : 2;
  return rows * line + messages * ImGui::GetTextLineHeightWithSpacing() + frame.px(4);
}

}  // namespace geotherm::ui
