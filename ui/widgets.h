// SPDX-License-Identifier: MIT
#pragma once

#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "ui/action.h"
#include "ui/frame.h"

// Rows of the panels: a label on the left, what belongs to it on the right. `key` names the item
// within its section.
namespace geotherm::ui {

/// A window that fills its place; ImGui::End() must follow. False: it has no size. `padding`: about
/// what it holds, in pixels.
bool begin_bar(const char* name, const Rect& place, ImVec2 padding, ImGuiWindowFlags flags);

/// A window over the picture, as large as what it holds; ImGui::End() must follow. `pivot`: the
/// share of its size that lies before `at`.
void begin_floating(Frame& frame, const char* name, ImVec2 at, ImVec2 pivot);

/// A heading that opens and closes what follows; remembered in the layout. True: open.
bool draw_section(Frame& frame, const char* name, bool open_at_first = true);

/// A line inside a section that opens and closes what follows, closed at first. True: open.
bool draw_more(Frame& frame, const char* name);

/// A bar behind the row that is drawn next, `share` of its width.
void draw_share(Frame& frame, double share);

/// A small heading inside a section.
void draw_heading(Frame& frame, const char* text);

/// The label column; the next item starts after it and is as wide as what is left.
void draw_label(Frame& frame, std::string_view label, std::string_view help = {});

/// A number or a word at the right edge. A long one is cut and shown whole on hover.
void draw_value(Frame& frame, std::string_view label, std::string_view value,
                std::string_view unit = {}, std::string_view help = {});
void draw_value(Frame& frame, std::string_view label, std::string_view value, std::string_view unit,
                std::string_view help, const ImVec4& colour);

/// Wrapped text.
void draw_note(std::string_view text, const ImVec4& colour);
void draw_dim(Frame& frame, std::string_view text);

/// Shown while the mouse rests on the last item.
void draw_tip(Frame& frame, std::string_view text);

bool draw_button(Frame& frame, std::string_view key, const char* label, bool possible = true,
                 float width = 0);

/// The width of each of `count` buttons that fill a row.
float button_width(int count);

bool draw_checkbox(Frame& frame, std::string_view key, const char* label, bool& on);

/// Alternatives side by side; the one that is chosen is lit. The index of a click, or -1.
struct Segment {
  std::string_view key;
  const char* label;
  bool on = false, possible = true;
};
int draw_segments(Frame& frame, std::initializer_list<Segment> segments);

/// A button that is lit while what it stands for is on.
bool draw_toggle(Frame& frame, const Segment& segment, float width);

/// A list to choose from, after a label. What was chosen, if anything was.
std::optional<std::string> draw_choice(Frame& frame, std::string_view key,
                                       const std::string& current,
                                       std::span<const std::string> values);

/// A button that performs an action, lit while that is on.
void draw_action(Frame& frame, std::string_view key, const char* label, Action action,
                 std::string_view tip, float width = 0);

/// A slider with a field beside it. What it is moved to or what is typed.
std::optional<std::string> draw_slider_row(Frame& frame, std::string_view key, double current,
                                           double low, double high, ImGuiSliderFlags flags = 0);

/// A field that holds `current` and gives what was typed once it is left or Enter is pressed.
std::optional<std::string> draw_field(Frame& frame, std::string_view key,
                                      const std::string& current, const char* hint = "");

}  // namespace geotherm::ui
