// SPDX-License-Identifier: MIT
#pragma once

#include <imgui.h>

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "ui/canvas_input.h"
#include "ui/file_dialog.h"
#include "ui/places.h"
#include "ui/write_question.h"

namespace geotherm::ui {

/// The field that is being typed in: the session hears of it when it is left.
struct TextEdit {
  ImGuiID id = 0;
  std::string start;  ///< what it held at first
  std::string text;
};

struct SourcesForm {
  std::string ids, error;
  int count = 5;
};

struct LogForm {
  std::array<bool, 4> shown = {true, true, true, true};  ///< by LogLine::Kind
  bool follow = true;
  std::string line, error;
  std::vector<std::string> past;  ///< command lines, oldest first
  int recalled = -1;              ///< index of the one in the field; negative: none
  std::size_t drawn = 0;          ///< lines of the log in the last frame
};

/// A failure that floats over the picture for a while.
struct Notice {
  std::string text;
  app::LogLine::Kind kind = app::LogLine::Kind::kError;
  double until = 0;                        ///< ImGui's time
  std::vector<SettingHint> settings = {};  ///< that may help
};

/// All that the panels remember between frames; nothing of it decides what is computed.
struct UiState {
  Layout layout;
  std::span<const std::byte> font;
  float scale = 1;
  bool restyle = false;  ///< the theme has changed
  Places places;
  std::map<std::string, Rect, std::less<>> items;  ///< where they were drawn in this frame
  TextEdit edit;
  CanvasInput input;
  std::optional<SurfacePoint> menu_point;  ///< of the menu that is open over the picture
  bool ask_menu = false;
  FileDialog dialog;
  WriteQuestion write_question;
  SourcesForm sources;
  LogForm log;
  std::set<std::string> left_out;  ///< backends that are not to be compared
  std::vector<Notice> notices;
  std::size_t notified = 0;  ///< lines of the log that notices were made of
  std::vector<std::string> dropped;
  bool quit = false;
  bool ask_keys = false, ask_about = false;  ///< dialogs to be opened in this frame
  double peak_mb = 0, peak_read_at = -1;     ///< memory of the program, and ImGui's time then
  int awake = 0;                             ///< frames to follow at once
};

}  // namespace geotherm::ui
