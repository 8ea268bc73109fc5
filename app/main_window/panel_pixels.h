// SPDX-License-Identifier: MIT
#pragma once

#include "engine/renderer.h"

// What Dear ImGui has laid out, in the engine's words; of the current context.
namespace geotherm::app {

/// The image of all letters that are loaded now. `version` counts them.
engine::PanelFont panel_font(std::uint64_t version);

/// The panels of the last ImGui::Render(), in pixels of the target.
engine::PanelDraw panel_draw();

}  // namespace geotherm::app
