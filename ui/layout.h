// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace geotherm::ui {

enum class Theme { kDark, kLight };

/// How the panels lie; lengths in pixels at scale 1. What the configuration folder remembers.
struct Layout {
  float left_width = 310, right_width = 310, log_height = 190;
  bool left = true, right = true, log = false;  ///< shown
  Theme theme = Theme::kDark;
  float scale = 1;                   ///< beside the monitor's own
  std::map<std::string, bool> open;  ///< sections that are open or closed, by name

  bool operator==(const Layout&) const = default;
};

/// One `name = value` a line. What is unknown or out of range is left at its default.
std::string to_text(const Layout& layout);
Layout parse_layout(std::string_view text);

/// $XDG_CONFIG_HOME/geotherm/viewer.conf, or ~/.config/...; empty where there is neither.
std::string layout_path();
/// The defaults where there is no such file, or none that can be read.
Layout load_layout(const std::string& path);
/// Makes the folder. False when it cannot be written: nothing depends on it.
bool save_layout(const std::string& path, const Layout& layout);

}  // namespace geotherm::ui
