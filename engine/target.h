// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "engine/device.h"
#include "geotherm/error.h"

namespace geotherm::engine {

/// Rows from the top, four bytes a pixel: red, green, blue (sRGB), alpha. Alpha is not multiplied
/// into the colours.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> pixels;  ///< 4 * width * height

  const std::uint8_t* at(int x, int y) const {
    return pixels.data() + 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                                static_cast<std::size_t>(x));
  }
};

struct TargetFrame;  // engine/vulkan/device_state.h

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

/// A picture in memory. end() waits until it is drawn.
class OffscreenTarget final : public Target {
 public:
  /// Errors: kOutOfMemory, kNoDevice.
  static Result<std::unique_ptr<OffscreenTarget>> build(const Device& device, glm::ivec2 extent);
  ~OffscreenTarget() override;

  /// The next frame shows the part of the whole picture that begins at this pixel. A negative one
  /// leaves room for panels before the picture.
  void set_origin(glm::ivec2 origin);

  glm::ivec2 extent() const override;
  Result<void> begin(TargetFrame& frame) override;
  Result<void> end(TargetFrame& frame) override;

  /// Copies the first width x height pixels of what was drawn last to `image` at `at`.
  /// Precondition: they fit there.
  void read(Image& image, glm::ivec2 at, glm::ivec2 size) const;

 private:
  struct State;
  explicit OffscreenTarget(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace geotherm::engine
