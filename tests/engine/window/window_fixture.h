// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <optional>

#include "engine/window/window.h"
#include "engine/window/window_target.h"
#include "tests/engine/gpu_fixture.h"
#include "tests/engine/stage.h"
#include "tests/support/private_display.h"

namespace geotherm::test {

/// A test with a display of its own. Skipped where there is no Xvfb, or failed where Vulkan is
/// required.
class DisplayTest : public testing::Test {
 protected:
  void SetUp() override;

  std::optional<PrivateDisplay> display_;
};

/// A test with a window to draw into, which fails when validation has anything to say.
class WindowTest : public DisplayTest {
 protected:
  void SetUp() override;
  void TearDown() override;

  static constexpr glm::ivec2 kSize{320, 240};

  /// Takes in what happens until it is so, for some seconds at most.
  bool eventually(const std::function<bool()>& so);
  /// Resizes the window from outside, as a user does, and waits until it knows.
  void resize(glm::ivec2 size);
  /// What the window shows.
  engine::Image content() const;
  /// Follows the window and draws, if there is something to draw into.
  bool draw(Stage& stage, const engine::Overlay& overlay = {},
            const engine::PanelDraw* panels = nullptr);

  // Members are destroyed from the last to the first.
  std::unique_ptr<engine::Window> window_;
  std::optional<engine::Device> device_;
  std::unique_ptr<engine::WindowTarget> target_;
};

}  // namespace geotherm::test
