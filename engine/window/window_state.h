// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/vulkan/presentation.h"
#include "engine/window/panel_input.h"
#include "engine/window/window.h"

struct GLFWwindow;

namespace geotherm::engine {

/// Members are destroyed from the last to the first.
struct Window::State final : Presentation {
  explicit State(GLFWwindow* shown) : window(shown) {}
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State();

  std::vector<const char*> instance_extensions() const override;
  bool can_present(vk::Instance instance, vk::PhysicalDevice device,
                   std::uint32_t queue_family) const override;
  vk::SurfaceKHR make_surface(vk::Instance instance) const override;

  GLFWwindow* window;
  std::unique_ptr<PanelInput> panels;  ///< once connected
  std::vector<std::string> dropped;
  bool happened = false;  ///< something, since wait() was called
};

}  // namespace geotherm::engine
