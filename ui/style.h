// SPDX-License-Identifier: MIT
#pragma once

#include <imgui.h>

#include <cstddef>
#include <span>

#include "ui/layout.h"

namespace geotherm::ui {

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
