// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "engine/device.h"
#include "engine/image.h"
#include "engine/target.h"

namespace geotherm::engine {

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
