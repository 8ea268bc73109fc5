// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "ui/action.h"

// The keys and mouse strokes there are. The text that the list of keys shows is what decides which
// key it is: what is shown cannot differ from what happens.
namespace geotherm::ui {

// Where keys stand in ImGuiIO::KeysDown: the numbers of the window system (GLFW). Letters and
// digits are their capital ASCII characters.
inline constexpr int kKeySpace = 32;
inline constexpr int kKeyEscape = 256;
inline constexpr int kKeyEnter = 257;
inline constexpr int kKeyTab = 258;
inline constexpr int kKeyDelete = 261;
inline constexpr int kKeyF1 = 290;  ///< the others follow
inline constexpr int kKeyPadEnter = 335;

struct KeyBinding {
  std::string_view keys;  ///< "p", "+", "Ctrl+Shift+Z", "F1", "Esc", "Tab"
  Action action;
  std::string_view group;  ///< heading in the list of keys
  std::string_view what;
};
std::span<const KeyBinding> key_bindings();

/// The first keys of an action; empty when there are none.
std::string_view shortcut(Action action);

/// What the keys of this frame ask for, out of the current ImGui context. Keys that print a
/// character count as that character, so that they are where the user's keyboard has them.
/// `typing`: a field has the keyboard, and leaves only function keys and what is pressed with Ctrl.
std::vector<Action> pressed_actions(bool typing);

/// What a stroke of the mouse over the picture does.
enum class MouseAction {
  kOrbit,
  kZoom,
  kPan,
  kMoveSource,
  kPaint,
  kSculpt,
  kSculptBack,  ///< the other way
  kSculptSmooth,
  kSetSource,
  kAddSource,
  kRemoveSource,
  kPick,
  kTarget,
  kCentre,
  kMenu,
  kWheelZoom,
};

struct MouseBinding {
  std::string_view stroke;  ///< "Left drag", "Ctrl+Left drag", "Right click", "Wheel"
  MouseAction action;
  std::string_view group;
  std::string_view what;
};
std::span<const MouseBinding> mouse_bindings();

struct Modifiers {
  bool ctrl = false, shift = false, alt = false;
};

/// `stroke`: without modifiers ("Left drag"). Nothing where no such stroke does anything.
std::optional<MouseAction> mouse_action(Modifiers modifiers, std::string_view stroke);

}  // namespace geotherm::ui
