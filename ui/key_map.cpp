// SPDX-License-Identifier: MIT
#include "ui/key_map.h"

#include <imgui.h>

#include <algorithm>

#include "app/text/text.h"

namespace geotherm::ui {
namespace {

constexpr KeyBinding kKeys[] = {
    {"1", Action::kWireframe, "View", "wireframe"},
    {"2", Action::kFlat, "View", "flat shading"},
    {"3", Action::kSmooth, "View", "smooth shading"},
    {"4", Action::kSources, "View", "heat sources"},
    {"5", Action::kHeatGradient, "View", "heat gradient X"},
    {"6", Action::kGradientError, "View", "gradient error: X beside \u2207\u03c6"},
    {"7", Action::kContours, "View", "distance contours"},
    {"8", Action::kExactError, "View", "error against a more accurate method"},
    {"9", Action::kRegions, "View", "nearest sources"},
    {"0", Action::kEikonalError, "View", "eikonal error: | |\u2207\u03c6| \u2212 1 | of each face"},
    {"g", Action::kLostGradients, "View", "faces without a direction of the heat"},
    {"t", Action::kTriangleQuality, "View", "triangle quality"},
    {"n", Action::kNonDelaunay, "View", "edges that are not Delaunay"},
    {"p", Action::kRotate, "View", "turn the model, and stop again"},
    {"f", Action::kFrame, "View", "the whole model, as large as it fits"},
    {"Space", Action::kPlay, "View", "play the frames, and pause"},
    {".", Action::kNextFrame, "View", "one frame on"},
    {",", Action::kPreviousFrame, "View", "one frame back"},
    {"l", Action::kLoop, "View", "play on or off from the last frame to the first"},
    {"+", Action::kMoreSources, "Sources", "one more random source"},
    {"-", Action::kFewerSources, "Sources", "one random source fewer"},
    {"h", Action::kShuffleSources, "Sources", "as many sources at new random places"},
    {"Delete", Action::kRemovePointed, "Sources",
     "remove the source that is pointed at or clicked"},
    {"v", Action::kViewTool, "Tools", "view: a click sets nothing"},
    {"a", Action::kSourceTool, "Tools", "sources: a click sets one"},
    {"b", Action::kBrush, "Tools", "brush on or off: paint a curve of sources"},
    {"r", Action::kPathTool, "Tools", "paths: a click shows those from there"},
    {"i", Action::kPickTool, "Tools", "pick: a click shows the figures of the point"},
    {"k", Action::kKeep, "A and B", "keep the present settings as B"},
    {"Tab", Action::kFlip, "A and B", "from A to B and back"},
    {"d", Action::kShowDifference, "A and B", "the difference A \u2212 B"},
    {"Ctrl+O", Action::kOpenModel, "File", "open a model"},
    {"Ctrl+Shift+O", Action::kOpenSession, "File", "open a session"},
    {"Ctrl+S", Action::kSaveSession, "File", "save the session"},
    {"Ctrl+P", Action::kSavePicture, "File", "save the picture"},
    {"Ctrl+Shift+S", Action::kSavePicture, "File", "save the picture"},
    {"Ctrl+D", Action::kSaveDistances, "File", "save the distances"},
    {"Ctrl+Q", Action::kQuit, "File", "quit"},
    {"Ctrl+Z", Action::kUndo, "Edit", "undo"},
    {"Ctrl+Y", Action::kRedo, "Edit", "redo"},
    {"Ctrl+Shift+Z", Action::kRedo, "Edit", "redo"},
    {"s", Action::kSculpt, "Tools", "sculpting on or off: pull, push, smooth"},
    {"Esc", Action::kStop, "Edit",
     "close a dialog or a bar over the picture, back to the tool of sources, cancel the work, "
     "forget paths, forget the "
     "point"},
    {"F1", Action::kKeys, "Window", "this list of keys"},
    {"F2", Action::kLeftPanel, "Window", "left side bar"},
    {"F3", Action::kRightPanel, "Window", "right side bar"},
    {"F4", Action::kLogPanel, "Window", "log and command line"},
};

constexpr MouseBinding kMouse[] = {
    {"Left drag", MouseAction::kOrbit, "Camera", "rotate"},
    {"Right drag", MouseAction::kOrbit, "Camera", "rotate, with the brush as well"},
    {"Ctrl+Left drag", MouseAction::kZoom, "Camera", "zoom"},
    {"Shift+Left drag", MouseAction::kPan, "Camera", "move in the plane of the picture"},
    {"Middle drag", MouseAction::kPan, "Camera", "move in the plane of the picture"},
    {"Wheel", MouseAction::kWheelZoom, "Camera", "zoom towards the pointer"},
    {"Left double click", MouseAction::kCentre, "Camera", "turn about this point"},
    {"Left click", MouseAction::kSetSource, "Set sources",
     "the source is here; on a source: it is chosen"},
    {"Shift+Left click", MouseAction::kAddSource, "Set sources", "one more source here"},
    {"Left drag of a source", MouseAction::kMoveSource, "Set sources", "move it"},
    {"Left drag with the brush", MouseAction::kPaint, "Set sources", "paint a curve of sources"},
    {"Left drag while sculpting", MouseAction::kSculpt, "Sculpt", "pull, or what the bar says"},
    {"Ctrl+Left drag while sculpting", MouseAction::kSculptBack, "Sculpt", "push where it pulls"},
    {"Shift+Left drag while sculpting", MouseAction::kSculptSmooth, "Sculpt", "smooth"},
    {"Left click with the pick tool", MouseAction::kPick, "Figures",
     "show the figures of this point"},
    {"Left click with the path tool", MouseAction::kTarget, "Figures",
     "paths from here to the source"},
    {"Ctrl+Left click", MouseAction::kPick, "Figures", "show the figures of this point"},
    {"Ctrl+Shift+Left click", MouseAction::kTarget, "Figures", "paths from here to the source"},
    {"Right click", MouseAction::kMenu, "Figures", "menu of this point"},
};

/// Keys that have a name, by how they are shown.
struct NamedKey {
  std::string_view name;
  int code;
};
constexpr NamedKey kNamed[] = {
    {"Esc", kKeyEscape}, {"Tab", kKeyTab}, {"Delete", kKeyDelete}, {"Space", kKeySpace}};

/// "Ctrl+Shift+Z" -> the modifiers and "Z".
std::pair<Modifiers, std::string_view> without_modifiers(std::string_view text) {
  Modifiers modifiers;
  const auto cut = [&text](std::string_view word, bool& flag) {
    if (!text.starts_with(word)) return;
    flag = true;
    text.remove_prefix(word.size());
  };
  cut("Ctrl+", modifiers.ctrl);
  cut("Shift+", modifiers.shift);
  return {modifiers, text};
}

bool same(Modifiers a, Modifiers b) {
  return a.ctrl == b.ctrl && a.shift == b.shift && a.alt == b.alt;
}

/// Where a key with a name or a letter stands in KeysDown.
int key_code(std::string_view key) {
  for (const NamedKey& named : kNamed) {
    if (named.name == key) return named.code;
  }
  if (key.size() == 1) return static_cast<unsigned char>(key[0]);
  const int number = app::number_in<int>(key.substr(1)).value_or(1);  // F1 and those that follow
  return kKeyF1 + number - 1;
}

bool is_typed(std::string_view character) {
  const ImGuiIO& io = ImGui::GetIO();
  const auto wanted = static_cast<ImWchar>(character[0]);
  const auto small = [](ImWchar c) {
    return c >= 'A' && c <= 'Z' ? static_cast<ImWchar>(c + 32) : c;
  };
  return std::any_of(io.InputQueueCharacters.begin(), io.InputQueueCharacters.end(),
                     [&](ImWchar typed) { return small(typed) == wanted; });
}

/// Whether a field that is typed in wants the keys for itself.
bool is_for_typing(const KeyBinding& key) {
  const bool function_key =
      key.keys.size() > 1 && key.keys[0] == 'F' && key.keys[1] >= '1' && key.keys[1] <= '9';
  const bool edits = key.action == Action::kUndo || key.action == Action::kRedo;
  return edits || !(function_key || key.keys.starts_with("Ctrl+"));
}

bool is_pressed(std::string_view keys) {
  const auto [modifiers, key] = without_modifiers(keys);
  const bool plain = !modifiers.ctrl && !modifiers.alt && !modifiers.shift;
  if (plain && key.size() == 1) return is_typed(key);
  const ImGuiIO& io = ImGui::GetIO();
  return same(modifiers, {io.KeyCtrl, io.KeyShift, io.KeyAlt}) &&
         ImGui::IsKeyPressed(key_code(key), false);
}

}  // namespace

std::span<const KeyBinding> key_bindings() { return kKeys; }

std::string_view shortcut(Action action) {
  const auto* found = std::find_if(std::begin(kKeys), std::end(kKeys),
                                   [action](const auto& key) { return key.action == action; });
  return found == std::end(kKeys) ? std::string_view() : found->keys;
}

std::vector<Action> pressed_actions(bool typing) {
  std::vector<Action> actions;
  for (const KeyBinding& key : kKeys) {
    if (typing && is_for_typing(key)) continue;
    if (is_pressed(key.keys)) actions.push_back(key.action);
  }
  return actions;
}

std::span<const MouseBinding> mouse_bindings() { return kMouse; }

std::optional<MouseAction> mouse_action(Modifiers modifiers, std::string_view stroke) {
  for (const MouseBinding& binding : kMouse) {
    const auto [needed, rest] = without_modifiers(binding.stroke);
    if (rest == stroke && same(needed, modifiers)) return binding.action;
  }
  return std::nullopt;
}

}  // namespace geotherm::ui
