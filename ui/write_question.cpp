// SPDX-License-Identifier: MIT
#include "ui/write_question.h"

#include <imgui.h>

#include <filesystem>
#include <system_error>
#include <utility>

#include "app/explore/saved_file.h"
#include "app/explore/script.h"
#include "app/text.h"
#include "ui/dialog.h"
#include "ui/frame.h"
#include "ui/widgets.h"

namespace geotherm::ui {
namespace {

constexpr const char* kName = "write";

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
  if (std::exchange(asked_, false)) ImGui::OpenPopup(kName);
  if (!begin_dialog(frame, kName, title_.c_str(), 620, 300)) return;
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
