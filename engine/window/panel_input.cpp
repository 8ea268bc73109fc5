// SPDX-License-Identifier: MIT
#include "engine/window/panel_input.h"

#include <imgui_impl_glfw.h>

namespace geotherm::engine {

PanelInput::PanelInput(GLFWwindow* window) : context_(ImGui::GetCurrentContext()) {
  // "For Vulkan" means that the window has no OpenGL context; nothing else.
  ImGui_ImplGlfw_InitForVulkan(window, true);
}

PanelInput::~PanelInput() {
  ImGuiContext* const current = ImGui::GetCurrentContext();
  ImGui::SetCurrentContext(context_);
  ImGui_ImplGlfw_Shutdown();
  // The back end leaves these behind, and with them the window that is gone.
  ImGuiIO& io = ImGui::GetIO();
  io.SetClipboardTextFn = nullptr;
  io.GetClipboardTextFn = nullptr;
  io.ClipboardUserData = nullptr;
  ImGui::SetCurrentContext(current);
}

void PanelInput::begin() { ImGui_ImplGlfw_NewFrame(); }

}  // namespace geotherm::engine
