// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>

#include "geotherm/error.h"

namespace geotherm::engine {

struct TargetFrame;  // engine/vulkan/target_frame.h

/// Where the renderer draws: the only thing that differs between a window and a picture.
class Target {
 public:
  virtual ~Target() = default;

  /// Pixels that are drawn at once.
  virtual glm::ivec2 extent() const = 0;

  /// Starts a frame: an image to draw into and commands that are being recorded.
  virtual Result<void> begin(TargetFrame& frame) = 0;
  /// Ends it: hands the commands to the device.
  virtual Result<void> end(TargetFrame& frame) = 0;
};

}  // namespace geotherm::engine
