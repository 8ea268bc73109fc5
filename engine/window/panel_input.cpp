// SPDX-License-Identifier: MIT
#include "engine/window/window_state.h"

#include <imgui_impl_glfw.h>

#include <cfloat>

namespace geotherm::engine {
namespace {

using Kind = PanelEvent::Kind;

constexpr int kRepeat = 2;  // GLFW's action of a key that is held
/// Between the presses of a double click.
constexpr std::chrono::milliseconds kDoubleClick{400};

/// Letters and signs come as characters as well, and as such in any number a frame.
bool is_typed(const PanelEvent& event) {
  constexpr int kFirst = 32, kLast = 126;
  const ImGuiIO& io = ImGui::GetIO();
  return event.code >= kFirst && event.code <= kLast && !io.KeyCtrl && !io.KeyAlt && !io.KeySuper;
}

bool is_modifier(const PanelEvent& event) {
  constexpr int kLeftShift = 340, kRightSuper = 347;  // GLFW's numbers, all modifiers between them
  return event.code >= kLeftShift && event.code <= kRightSuper;
}

}  // namespace

PanelInput::PanelInput(GLFWwindow* window) : window_(window), context_(ImGui::GetCurrentContext()) {
  // "For Vulkan" means that the window has no OpenGL context; nothing else. Events are ours.
  ImGui_ImplGlfw_InitForVulkan(window, false);
}

PanelInput::~PanelInput() {
  ImGuiContext* const current = ImGui::GetCurrentContext();
  ImGui::SetCurrentContext(context_);
  ImGui_ImplGlfw_Shutdown();
  // The back end leaves these behind, and with them the window that is gone.
  ImGuiIO& io = ImGui::GetIO();
  io.SetClipboardTextFn = nullptr;
  io.GetClipboardTextFn = nullptr;
  io.ClipboardUserData = nullptr;
  ImGui::SetCurrentContext(current);
}

/// False: it has to wait for the next frame.
bool PanelInput::take(const PanelEvent& event) {
  switch (event.kind) {
    case Kind::kKey: {
      // What follows a key may change what it means: Ctrl that is let go.
      if (key_changed_) return false;
      const bool known = event.code >= 0 && event.code < kKeys;
      if (known && !is_typed(event)) {
        if (keys_changed_[static_cast<std::size_t>(event.code)]) return false;
        keys_changed_.set(static_cast<std::size_t>(event.code));
        key_changed_ = !is_modifier(event);
      }
      repeats_ = event.action == kRepeat;
      ImGui_ImplGlfw_KeyCallback(window_, event.code, event.scan_code, event.action,
                                 event.modifiers);
      return true;
    }
    case Kind::kCharacter:
      // A key that is held writes on in a field; what it switches is switched once.
      if (repeats_ && !ImGui::GetIO().WantTextInput) return true;
      ImGui_ImplGlfw_CharCallback(window_, static_cast<unsigned>(event.code));
      return true;
    case Kind::kButton: {
      if (event.code < 0 || event.code >= kButtons) return true;
      if (button_changed_) return false;
      button_changed_ = true;
      const auto button = static_cast<std::size_t>(event.code);
      down_[button] = event.action != 0;
      if (!down_[button]) return true;
      // ImGui counts from frame to frame, which says nothing where these are slow.
      const bool twice = event.time - pressed_[button] < kDoubleClick;
      ImGui::GetIO().MouseDoubleClickTime = twice ? FLT_MAX : 0;
      pressed_[button] = event.time;
      return true;
    }
    case Kind::kCursor:
      if (button_changed_) return false;  // the click was before the mouse went on
      x_ = event.x;
      y_ = event.y;
      inside_ = true;
      return true;
    case Kind::kCursorEnter:
      inside_ = event.code != 0;
      ImGui_ImplGlfw_CursorEnterCallback(window_, event.code);
      return true;
    case Kind::kScroll:
      if (button_changed_) return false;
      ImGui_ImplGlfw_ScrollCallback(window_, event.x, event.y);
      return true;
    case Kind::kFocus:
      ImGui_ImplGlfw_WindowFocusCallback(window_, event.code);
      if (event.code == 0) down_ = {};
      return true;
  }
  return true;
}

void PanelInput::begin() {
  ImGui_ImplGlfw_NewFrame();
  button_changed_ = false;
  key_changed_ = false;
  keys_changed_.reset();
  while (!events_.empty() && take(events_.front())) events_.pop_front();
  ImGuiIO& io = ImGui::GetIO();
  bool held = false;
  for (int i = 0; i < kButtons; ++i) {
    io.MouseDown[i] = down_[static_cast<std::size_t>(i)];
    held |= io.MouseDown[i];
  }
  io.MousePos = inside_ || held ? ImVec2(static_cast<float>(x_), static_cast<float>(y_))
                                : ImVec2(-FLT_MAX, -FLT_MAX);
}

}  // namespace geotherm::engine
