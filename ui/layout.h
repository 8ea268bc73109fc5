// SPDX-License-Identifier: MIT
#pragma once

#include <imgui.h>

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace geotherm::ui {

enum class Theme { kDark, kLight };

/// How the panels lie; lengths in pixels at scale 1. What the configuration folder remembers.
struct Layout {
  float left_width = 310, right_width = 310, log_height = 190;
  bool left = true, right = true, log = false;  ///< shown
  bool right_first = false;  ///< where one side bar alone has room, it is the right one
  Theme theme = Theme::kDark;
  float scale = 1;                   ///< beside the monitor's own
  std::map<std::string, bool> open;  ///< sections that are open or closed, by name
  std::vector<std::string> recent;   ///< models, the newest first, kMaxRecent at most

  bool operator==(const Layout&) const = default;
};

inline constexpr std::size_t kMaxRecent = 8;

/// Puts a model in front of those that were opened of late.
void add_recent(Layout& layout, const std::string& path);

/// One `name = value` a line. What is unknown or out of range is left at its default.
std::string to_text(const Layout& layout);
Layout parse_layout(std::string_view text);

/// $XDG_CONFIG_HOME/geotherm/viewer.conf, or ~/.config/...; empty where there is neither.
std::string layout_path();
/// The defaults where there is no such file, or none that can be read.
Layout load_layout(const std::string& path);
/// Makes the folder. False when it cannot be written: nothing depends on it.
bool save_layout(const std::string& path, const Layout& layout);

/// Pixels from the top left corner of the window, as ImGui counts them.
struct Rect {
  float x = 0, y = 0, width = 0, height = 0;
};

inline constexpr float kMinCanvas = 200;  ///< pixels at scale 1 that panels leave to the picture
inline constexpr float kMinCanvasShare = 0.45F;  ///< of the window's width, beside the bars
inline constexpr float kMinBar = 240;            ///< width of a side bar, pixels at scale 1
inline constexpr float kMinLog = 70;             ///< height of the log, pixels at scale 1

/// Where panels lie. What is hidden, or has no room, has no width.
struct Places {
  Rect menu, status, left, right, log, tools, canvas;
  bool over = false;  ///< the drawer lies over the picture
};

/// A bar that has no room beside the picture and is shown over it instead, until it is closed.
enum class Drawer { kNone, kLeft, kRight, kLog };

/// Divides a window. `line`: height of menu bar and status bar, pixels; the toolbar is a little
/// higher. Where room is scarce, side bars and log shrink, then the right one goes, then the left
/// one, the log, the toolbar and the status bar. `Layout::right_first`: the left one goes first.
/// Nothing overlaps but the drawer, and nothing is smaller than 0.
Places place_panels(const Layout& layout, float width, float height, float scale, float line,
                    Drawer drawer = Drawer::kNone);

/// Colours beside those that ImGui knows of.
struct Palette {
  ImVec4 window, panel, header, frame, border, button;  ///< from back to front
  ImVec4 text, dim;                                     ///< dim: labels and units
  ImVec4 accent, selected;
  ImVec4 good, warning, error;
  ImVec4 series[3];  ///< of plots: told apart by lightness as well
};
const Palette& palette(Theme theme);

inline constexpr float kLetters = 15;     ///< height of the font, pixels at scale 1
inline constexpr float kBigLetters = 21;  ///< of the few titles

/// The current context's style: paddings for the scale, colours of the theme.
void set_style(Theme theme, float scale);

/// Replaces the current context's fonts by this one in two sizes. Without bytes: ImGui's own.
void load_fonts(std::span<const std::byte> font, float scale);

/// The larger of both sizes.
ImFont* big_font();

inline ImU32 packed(const ImVec4& colour) { return ImGui::ColorConvertFloat4ToU32(colour); }
ImVec4 faded(ImVec4 colour, float alpha);

}  // namespace geotherm::ui
