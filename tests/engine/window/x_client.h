// SPDX-License-Identifier: MIT
#pragma once

#include <string>

// What other programs of a desktop do with a window, said to the server of DISPLAY. Throw
// std::runtime_error where there is no window of that class.
namespace geotherm::test {

/// As a window manager marks a window that it minimises or shows again.
void mark_minimised(const std::string& window_class, bool minimised);

/// As the close button of a frame.
void ask_to_close(const std::string& window_class);

/// As a file manager in which someone drags files to the window and lets them go there. `uris`: one
/// a line. Waits for the window to take them, which has to look at its events in the meantime.
void drop(const std::string& window_class, const std::string& uris);

}  // namespace geotherm::test
