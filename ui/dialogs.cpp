// SPDX-License-Identifier: MIT
#include "ui/dialogs.h"

#include <imgui.h>
#include <algorithm>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "app/session/script.h"
#include "app/text/text.h"
#include "ui/frame.h"
#include "ui/key_map.h"
#include "ui/widgets.h"

namespace geotherm::ui {
namespace {

constexpr const char* kKeysName = "keys";
constexpr const char* kAboutName = "about";

void draw_close_button(Frame& frame) {
  const float width = frame.px(110);
  ImGui::SetCursorPosX(ImGui::GetWindowContentRegionMax().x - width);
  const bool closed = draw_button(frame, "close", "Close", true, width);
  if (closed || is_escape_pressed()) ImGui::CloseCurrentPopup();
}

struct Row {
  std::string_view group, keys, what;
};

/// All rows of the list: keys, then the mouse.
std::vector<Row> all_rows() {
  std::vector<Row> rows;
  for (const KeyBinding& key : key_bindings()) rows.push_back({key.group, key.keys, key.what});
  for (const MouseBinding& mouse : mouse_bindings()) {
    rows.push_back({mouse.group, mouse.stroke, mouse.what});
  }
  return rows;
}

/// The groups that stand in one column of the list, and how wide their keys are.
struct ListColumn {
  std::vector<std::string_view> groups;
  float keys;  ///< pixels at scale 1
};

void draw_group(Frame& frame, std::string_view group, float width) {
  const std::string name(group);
  draw_heading(frame, name.c_str());
  if (!ImGui::BeginTable(name.c_str(), 2)) return;
  ImGui::TableSetupColumn("keys", ImGuiTableColumnFlags_WidthFixed, frame.px(width));
  ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthStretch);
  for (const Row& row : all_rows()) {
    if (row.group != group) continue;
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(std::string(row.keys).c_str());
    frame.mark(row.keys);
    ImGui::TableNextColumn();
    draw_dim(frame, row.what);
  }
  ImGui::EndTable();
}

}  // namespace

bool is_escape_pressed() { return ImGui::IsKeyPressed(kKeyEscape, false); }

bool is_enter_pressed() {
  return ImGui::IsKeyPressed(kKeyEnter, false) || ImGui::IsKeyPressed(kKeyPadEnter, false);
}

bool begin_dialog(Frame& frame, const char* id, const char* title, float width, float height) {
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  const ImVec2 size(std::min(frame.px(width), window.x * 0.96F),
                    std::min(frame.px(height), window.y * 0.94F));
  ImGui::SetNextWindowSize(size);
  ImGui::SetNextWindowPos({window.x / 2, window.y / 2}, ImGuiCond_Always, {0.5F, 0.5F});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {frame.px(16), frame.px(12)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, frame.px(6));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, ImGui::GetStyle().FrameBorderSize);
  constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove |
                                      ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoSavedSettings;
  const bool open = ImGui::BeginPopupModal(id, nullptr, kFlags);
  ImGui::PopStyleVar(3);
  if (!open) return false;
  if (big_font()) ImGui::PushFont(big_font());
  ImGui::TextUnformatted(title);
  if (big_font()) ImGui::PopFont();
  ImGui::Dummy({0, frame.px(2)});
  return true;
}

void draw_keys_dialog(Frame& frame) {
  frame.section = "Keys";
  if (frame.ui.ask_keys) ImGui::OpenPopup(kKeysName);
  const bool just_opened = std::exchange(frame.ui.ask_keys, false);
  if (!begin_dialog(frame, kKeysName, "Keys and mouse", 1080, 560)) return;
  const float below = ImGui::GetFrameHeightWithSpacing();
  ImGui::BeginChild("bindings", {0, -below});
  const ListColumn columns[] = {{{"View", "Sources", "A and B"}, 40},
                                {{"Tools", "File", "Edit", "Window"}, 105},
                                {{"Camera", "Set sources", "Sculpt", "Figures"}, 205}};
  // In a small window the columns stand below each other.
  const bool narrow = ImGui::GetContentRegionAvail().x < frame.px(760);
  if (ImGui::BeginTable("columns", narrow ? 1 : 3, ImGuiTableFlags_SizingStretchProp)) {
    for (const float share : {0.9F, 1.0F, 1.3F}) {
      if (!narrow) ImGui::TableSetupColumn("", 0, share);
    }
    for (const ListColumn& column : columns) {
      ImGui::TableNextColumn();
      for (const std::string_view group : column.groups) draw_group(frame, group, column.keys);
    }
    ImGui::EndTable();
  }
  ImGui::EndChild();
  draw_close_button(frame);
  // The key that opened the list closes it again.
  if (!just_opened && ImGui::IsKeyPressed(kKeyF1, false)) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
}

void draw_about_dialog(Frame& frame) {
  frame.section = "About";
  if (std::exchange(frame.ui.ask_about, false)) ImGui::OpenPopup(kAboutName);
  if (!begin_dialog(frame, kAboutName, "geotherm", 460, 260)) return;
  ImGui::TextWrapped(
      "Geodesic distance on triangle meshes by the heat method: solve (A + t L) u = u\u2080, take "
      "X = \u2212\u2207u / |\u2207u|, solve L \u03c6 = div X.");
  ImGui::Dummy({0, frame.px(4)});
  draw_dim(frame,
           "K. Crane, C. Weischedel, M. Wardetzky: Geodesics in heat, ACM Transactions on "
           "Graphics 32 (5), 2013.");
  ImGui::Dummy({0, frame.px(4)});
  draw_dim(frame, "Drawn by " + frame.canvas.device() + ". Free software under the MIT licence.");
  draw_close_button(frame);
  ImGui::EndPopup();
}

namespace {

constexpr const char* kQuestionName = "write";

bool is_there(const std::string& path) {
  std::error_code unknown;
  return std::filesystem::exists(std::filesystem::symlink_status(path, unknown));
}

}  // namespace

void WriteQuestion::send(Frame& frame, app::Command command) {
  files_.clear();
  if (const auto* run = std::get_if<app::command::Run>(&command)) {
    for (const std::string& path : app::files_written_by(run->path)) {
      files_.push_back(app::one_line(path) + (is_there(path) ? "  (is there already)" : ""));
    }
    title_ = "Run the commands of a file";
    text_ = app::one_line(run->path) + " writes " +
            app::counted(static_cast<std::int64_t>(files_.size()), "file", "files") + ":";
    verb_ = "Run";
  } else if (const std::string* path = app::saved_path(command); path && is_there(*path)) {
    files_.push_back(app::one_line(*path));
    title_ = "Replace a file";
    text_ = "This file is there already. Replace it?";
    verb_ = "Replace";
  }
  if (files_.empty()) return frame.send(std::move(command));
  command_ = std::move(command);
  asked_ = true;
}

void WriteQuestion::draw(Frame& frame) {
  frame.section = "Write";
  if (std::exchange(asked_, false)) ImGui::OpenPopup(kQuestionName);
  if (!begin_dialog(frame, kQuestionName, title_.c_str(), 620, 300)) return;
  ImGui::TextWrapped("%s", text_.c_str());
  ImGui::BeginChild("files", {0, -ImGui::GetFrameHeightWithSpacing()}, true);
  for (const std::string& file : files_) ImGui::TextUnformatted(file.c_str());
  ImGui::EndChild();
  const float width = frame.px(110);
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  ImGui::SetCursorPosX(ImGui::GetWindowContentRegionMax().x - 2 * width - gap);
  bool closed = draw_button(frame, "cancel", "Cancel", true, width) || is_escape_pressed();
  ImGui::SameLine();
  if (draw_button(frame, "agree", verb_, true, width) && command_) {
    frame.send(*std::exchange(command_, std::nullopt));
    closed = true;
  }
  if (closed) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
}

}  // namespace geotherm::ui
