// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>

namespace geotherm::ui {

struct Frame;

/// A model that comes with the program.
struct Bundled {
  std::string_view name, what;
};
std::span<const Bundled> bundled();

/// A list to choose one from.
void draw_bundled_list(Frame& frame, float width);

/// Entries of a menu.
void draw_bundled_menu(Frame& frame);

}  // namespace geotherm::ui
