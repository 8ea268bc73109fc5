// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <bitset>
#include <chrono>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "engine/vulkan/instance.h"
#include "engine/window/window.h"

struct GLFWwindow;
struct ImGuiContext;

namespace geotherm::engine {

/// Something that a hand has done, with the arguments of GLFW's callback of its kind.
struct PanelEvent {
  enum class Kind { kKey, kCharacter, kButton, kCursor, kCursorEnter, kScroll, kFocus };
  Kind kind = Kind::kKey;
  int code = 0;  ///< key, character, button, entered, focused
  int scan_code = 0, action = 0, modifiers = 0;
  double x = 0, y = 0;  ///< of cursor and scroll
  std::chrono::steady_clock::time_point time = std::chrono::steady_clock::now();
};

/// Keys, mouse, clipboard, sizes and time of a window for the ImGui context that is current when it
/// is made. Context and window outlive it.
///
/// ImGui looks at keys and buttons once a frame, so events wait in a queue: each frame sees one
/// change of a button, with the mouse where it was then, and one of a key. What is pressed and let
/// go while a slow frame is drawn is not lost, and a click is where the hand made it.
class PanelInput {
 public:
  explicit PanelInput(GLFWwindow* window);
  PanelInput(const PanelInput&) = delete;
  PanelInput& operator=(const PanelInput&) = delete;
  ~PanelInput();

  void add(const PanelEvent& event) { events_.push_back(event); }
  void begin();
  /// The next frame has something to see already.
  bool has_more() const { return !events_.empty(); }

 private:
  static constexpr int kButtons = 5;  // ImGui's
  static constexpr int kKeys = 512;   // ImGui's

  bool take(const PanelEvent& event);

  GLFWwindow* window_;
  ImGuiContext* context_;
  std::deque<PanelEvent> events_;
  std::array<bool, kButtons> down_{};
  std::array<std::chrono::steady_clock::time_point, kButtons> pressed_{};
  double x_ = 0, y_ = 0;
  bool inside_ = false;
  bool repeats_ = false;               // the last key event was of a key that is held
  bool button_changed_ = false;        // in this frame
  bool key_changed_ = false;           // in this frame, other than modifiers
  std::bitset<kKeys> keys_changed_{};  // in this frame
};

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
