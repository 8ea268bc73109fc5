// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "engine/device.h"
#include "engine/target.h"
#include "engine/window/window.h"

namespace geotherm::engine {

/// A window to draw into. Follows its size: the swapchain is made anew when the window's pixels are
/// not its own or the system says that it is out of date. end() shows the frame and waits until it
/// is drawn, so that what it was drawn from may be changed. The window outlives it.
class WindowTarget final : public Target {
 public:
  /// Precondition: the device was opened for this window (DeviceOptions::window).
  /// Errors: kNoDevice, kOutOfMemory.
  static Result<std::unique_ptr<WindowTarget>> build(const Device& device, Window& window);
  ~WindowTarget() override;

  /// Follows the window's size. False: there is nothing to draw into now (minimised, no size).
  /// Call before the frame is laid out; extent() holds until the next call. Errors: kNoDevice (the
  /// device or the window's surface is lost for good), kOutOfMemory.
  Result<bool> follow_window();

  /// Where the picture's first pixel lies in the window: panels take the rest. From even corners
  /// pictures look as they do alone; from odd ones thin lines differ a little.
  void set_picture_corner(glm::ivec2 corner);

  glm::ivec2 extent() const override;
  Result<void> begin(TargetFrame& frame) override;
  Result<void> end(TargetFrame& frame) override;

 private:
  struct State;
  explicit WindowTarget(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace geotherm::engine
