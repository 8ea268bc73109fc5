// SPDX-License-Identifier: MIT
#include "ui/interface.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "app/session/script.h"
#include "app/text/text.h"
#include "ui/action.h"
#include "ui/canvas.h"
#include "ui/dialogs.h"
#include "ui/frame.h"
#include "ui/key_map.h"
#include "ui/panels.h"

namespace geotherm::ui {
namespace {

constexpr double kTurnPerSecond = 20;   ///< degrees, while the model rotates
constexpr double kLongestFrame = 0.25;  ///< seconds; after a pause the model goes on, not leaps
constexpr double kSaysDrop = 12;        ///< seconds
constexpr int kAwake = 3;  ///< frames that ImGui needs until it shows what a click has done

/// Whether the user does anything: then a few frames follow, until all of it is seen.
bool is_active() {
  const ImGuiIO& io = ImGui::GetIO();
  const bool mouse = io.MouseDelta.x != 0 || io.MouseDelta.y != 0 || io.MouseWheel != 0;
  const auto any = [](const auto& flags) {
    return std::any_of(std::begin(flags), std::end(flags), [](bool flag) { return flag; });
  };
  return mouse || any(io.MouseDown) || any(io.MouseReleased) || any(io.KeysDown) ||
         !io.InputQueueCharacters.empty();
}

void take_drop(Frame& frame) {
  if (frame.ui.dropped.empty()) return;
  const std::string file = frame.ui.dropped.front();
  if (const std::size_t count = frame.ui.dropped.size(); count > 1) {
    const std::string name = std::filesystem::path(file).filename().string();
    frame.ui.notices.push_back(
        {std::to_string(count) +
             " files were dropped. One is shown at a time: " + app::one_line(name) + " is opened.",
         app::LogLine::Kind::kNote, ImGui::GetTime() + kSaysDrop});
  }
  frame.ui.dropped.clear();
  if (app::is_session(file)) {
    frame.ui.write_question.send(frame, app::command::Run{file});
  } else {
    frame.send(app::command::Open{file});
  }
}

/// What was opened can be opened again, from wherever the program is started then.
void note_model(Frame& frame) {
  if (!frame.model() ||
      std::exchange(frame.ui.noted_model, frame.model()->model.path) == frame.model()->model.path) {
    return;
  }
  const std::string& path = frame.model()->model.path;
  std::error_code unknown;
  const auto whole = std::filesystem::absolute(path, unknown);
  if (!path.empty() && !unknown) add_recent(frame.ui.layout, whole.lexically_normal().string());
}

void rotate(Frame& frame) {
  if (!frame.state().rotating || frame.ui.input.is_dragging()) return;
  for (const app::Command& command : frame.out.commands) {
    if (std::holds_alternative<app::command::Rotate>(command)) return;  // it ends in this frame
  }
  const double seconds = std::min<double>(ImGui::GetIO().DeltaTime, kLongestFrame);
  frame.send(app::command::Orbit{kTurnPerSecond * seconds, 0});
}

void take_keys(Frame& frame) {
  if (ImGui::GetTopMostPopupModal()) return;
  const bool typing = ImGui::GetIO().WantTextInput;
  const bool popup = ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup);
  if (popup && !typing && is_escape_pressed()) return ImGui::ClosePopupToLevel(0, true);
  for (const Action action : pressed_actions(typing)) perform(frame, action);
}

/// The window that popups belong to; nothing of it is seen.
void begin_host() {
  ImGui::SetNextWindowPos({0, 0});
  ImGui::SetNextWindowSize({1, 1});
  ImGui::Begin("##host", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs |
                   ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoFocusOnAppearing);
}

}  // namespace

struct Interface::State : UiState {};

Interface::Interface(Layout layout, std::span<const std::byte> font, float scale)
    : state_(std::make_unique<State>()) {
  state_->layout = std::move(layout);
  state_->font = font;
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;  // what is remembered is the layout
  io.LogFilename = nullptr;
  io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;  // lists of more than 65,536 vertices
  io.ConfigWindowsMoveFromTitleBarOnly = true;
  io.ConfigInputTextCursorBlink = false;  // a window that nobody touches draws nothing
  set_scale(scale);
}

Interface::~Interface() = default;

void Interface::set_scale(float scale) {
  state_->scale = scale;
  load_fonts(state_->font, scale);
  set_style(state_->layout.theme, scale);
}

float Interface::scale() const { return state_->scale; }

FrameOutput Interface::draw(const app::Session& session, const Canvas& canvas, bool for_file) {
  FrameOutput out;
  UiState& ui = *state_;
  if (std::exchange(ui.restyle, false)) set_style(ui.layout.theme, ui.scale);
  Frame frame{session, canvas, ui, out, {}};
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  ui.places =
      place_panels(ui.layout, window.x, window.y, ui.scale, ImGui::GetFrameHeight(), ui.drawer);
  if (!ui.places.over) ui.drawer = Drawer::kNone;  // it has room now
  ui.items.clear();
  take_drop(frame);
  note_model(frame);
  take_notices(frame);
  if (for_file) ui.says_written_until = 0;  // that is of the file before

  begin_host();
  ui.input.draw(frame);     // first: panels show what lies under the pointer now
  ui.sources.pointed = -1;  // the list says so anew, where it is shown
  draw_menu_bar(frame);
  draw_side_bars(frame);
  draw_toolbar(frame);
  draw_status_bar(frame);
  draw_canvas_overlay(frame);
  draw_sculpt_bar(frame);
  const float timeline = draw_timeline(frame);
  if (!for_file) draw_notices(frame, timeline);
  draw_canvas_menu(frame);
  take_keys(frame);
  ui.dialog.draw(frame);
  ui.write_question.draw(frame);
  draw_keys_dialog(frame);
  draw_about_dialog(frame);
  ImGui::End();

  rotate(frame);
  ui.awake = is_active() || !out.commands.empty() ? kAwake : std::max(0, ui.awake - 1);
  const bool plays_on = play(frame);
  out.dragging = ui.input.is_dragging() || ui.scrubs || session.state().timeline.playing;
  out.animating = session.state().rotating || plays_on || ui.awake > 0;
  return out;
}

Rect Interface::canvas() const { return state_->places.canvas; }

void Interface::drop(const std::vector<std::string>& files) { state_->dropped = files; }

const Layout& Interface::layout() const { return state_->layout; }

std::optional<Rect> Interface::place_of_item(std::string_view name) const {
  const auto found = state_->items.find(name);
  if (found == state_->items.end()) return std::nullopt;
  return found->second;
}

}  // namespace geotherm::ui
