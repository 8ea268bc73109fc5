// SPDX-License-Identifier: MIT
#pragma once

struct GLFWwindow;
struct ImGuiContext;

namespace geotherm::engine {

/// Keys, mouse, clipboard, sizes and time of a window for the ImGui context that is current when it
/// is made. Callbacks that the window had before are still called. Context and window outlive it.
class PanelInput {
 public:
  explicit PanelInput(GLFWwindow* window);
  PanelInput(const PanelInput&) = delete;
  PanelInput& operator=(const PanelInput&) = delete;
  ~PanelInput();

  void begin();

 private:
  ImGuiContext* context_;
};

}  // namespace geotherm::engine
