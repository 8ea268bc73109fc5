// SPDX-License-Identifier: MIT
#include "ui/bundled.h"

#include <imgui.h>

#include <string>

#include "ui/widgets.h"

namespace geotherm::ui {
namespace {

constexpr Bundled kBundled[] = {
    {"terrain", "a landscape with one boundary"},
    {"sleeve", "a tube with two boundaries"},
    {"cube", "with exact edges"},
    {"gargoyle", "200,000 faces"},
    {"bunny", "4,000 faces"},
};

void draw_entries(Frame& frame) {
  for (const Bundled& model : kBundled) {
    const std::string name(model.name);
    if (ImGui::MenuItem(name.c_str(), std::string(model.what).c_str())) {
      frame.send(app::command::Open{name});
    }
    frame.mark(name);
  }
}

}  // namespace

std::span<const Bundled> bundled() { return kBundled; }

void draw_bundled_list(Frame& frame, float width) {
  if (draw_button(frame, "bundled", "Bundled\u2026", true, width)) ImGui::OpenPopup("bundled");
  if (!ImGui::BeginPopup("bundled")) return;
  draw_entries(frame);
  ImGui::EndPopup();
}

void draw_bundled_menu(Frame& frame) { draw_entries(frame); }

}  // namespace geotherm::ui
