// SPDX-License-Identifier: MIT
#pragma once

#include <imgui.h>
#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/session/settings.h"
#include "ui/canvas.h"
#include "ui/dialogs.h"
#include "ui/file_dialog.h"
#include "ui/interface.h"
#include "ui/layout.h"

namespace geotherm::ui {

/// The field that is being typed in: the session hears of it when it is left.
struct TextEdit {
  ImGuiID id = 0;
  std::string start;  ///< what it held at first
  std::string text;
  int seen = 0;  ///< ImGui's frame in which the field was typed in last
};

struct SourcesForm {
  std::string ids, error;
  int count = 5;
  int pointed = -1;  ///< the entry whose name the pointer is at; negative: none
  std::optional<app::SourceSpec> chosen = {};  ///< whose name was clicked: Delete removes it
};

/// What the sculpting brush is set to.
struct SculptForm {
  app::SculptTool tool = app::SculptTool::kPull;
  float radius = 0.06F;  ///< share of the model's size
  float strength = 0.1F;
};

struct LogForm {
  std::array<bool, 4> shown = {true, true, true, true};  ///< by LogLine::Kind
  bool follow = true;
  std::string line, error;
  std::string choices;            ///< what the word in the field may become
  std::vector<std::string> past;  ///< command lines, oldest first
  int recalled = -1;              ///< index of the one in the field; negative: none
  std::size_t drawn = 0;          ///< lines of the log in the last frame
  float below = 0;                ///< the height below them then
};

/// What floats over the picture for a while: a failure, or what can be undone.
struct Notice {
  std::string text;
  app::LogLine::Kind kind = app::LogLine::Kind::kError;
  double until = 0;                           ///< ImGui's time
  std::vector<SettingHint> settings = {};     ///< that may help
  std::vector<app::SourceSpec> sources = {};  ///< that a button brings back; empty: none
  bool replaced = false;                      ///< whether others have been in their place
  bool of_failure = false;                    ///< it goes with Session::failure()
};

/// All that the panels remember between frames; nothing of it decides what is computed.
struct UiState {
  Layout layout;
  std::span<const std::byte> font;
  float scale = 1;
  bool restyle = false;  ///< the theme has changed
  Places places;
  Drawer drawer = Drawer::kNone;
  std::map<std::string, Rect, std::less<>> items;  ///< where they were drawn in this frame
  TextEdit edit, left;  ///< left: where another field took over before it was drawn again
  CanvasInput input;
  std::optional<SurfacePoint> menu_point;         ///< of the menu that is open over the picture
  std::shared_ptr<const TriangleMesh> menu_mesh;  ///< that the point is on; null: no menu is open
  bool ask_menu = false;
  FileDialog dialog;
  WriteQuestion write_question;
  SourcesForm sources;
  SculptForm sculpt;
  double played_at = 0;  ///< ImGui's time when a frame was sent last
  bool scrubs = false;   ///< the timeline is dragged
  LogForm log;
  std::set<std::string> left_out;  ///< backends that are not to be compared
  std::string_view sought;         ///< the section that is brought into sight
  int seeks = 0;                   ///< frames in which it is
  std::size_t compared = 0;        ///< rows of it in the last frame
  std::vector<Notice> notices;
  std::size_t notified = 0;       ///< lines of the log that notices were made of
  std::string written;            ///< what the status bar says of the file that was written last
  double says_written_until = 0;  ///< ImGui's time
  std::vector<std::string> dropped;
  std::string noted_model;                   ///< the file that was noted as opened last
  bool ask_keys = false, ask_about = false;  ///< dialogs to be opened in this frame
  double peak_mb = 0, peak_read_at = -1;     ///< memory of the program, and ImGui's time then
  int awake = 0;                             ///< frames to follow at once
};

/// What every panel is drawn with, for one draw().
struct Frame {
  const app::Session& session;
  const Canvas& canvas;
  UiState& ui;
  FrameOutput& out;
  std::string section;  ///< the one that is being drawn; prefix of its items' names

  void send(app::Command command) { out.commands.push_back(std::move(command)); }
  /// Settings of methods are those of A: while B is shown, A is shown again, or nothing would seem
  /// to happen.
  void set(std::string_view name, std::string value);
  const app::ViewerState& state() const { return session.state(); }
  const app::Explored& explored() const { return session.explored(); }
  /// The model that is shown; null: none.
  const app::ExploredModel* model() const { return session.explored().model.get(); }
  /// What is said of its mesh; null where none is open, and before it is described.
  const MeshReport* mesh() const { return model() && model()->mesh ? &*model()->mesh : nullptr; }
  const app::Answer* answer() const {
    return app::shown_answer(session.explored(), session.state().shown);
  }
  const Palette& colours() const { return palette(ui.layout.theme); }
  float px(float at_scale_1) const { return at_scale_1 * ui.scale; }
  /// Notes where the last item was drawn, under "section/key".
  void mark(std::string_view key);
};

}  // namespace geotherm::ui
