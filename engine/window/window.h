// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

#include "engine/target.h"
#include "geotherm/error.h"

namespace geotherm::engine {

struct WindowOptions {
  std::string title = "geotherm";
  glm::ivec2 size{1280, 800};
};

/// A window of the desktop. For the main thread; at most one at a time. Keys, mouse and clipboard
/// reach Dear ImGui's context (connect_panels); what ImGui does not know comes from here.
class Window {
 public:
  /// Errors: kNoDevice (no display, no Vulkan for windows; with the system's reason).
  static Result<std::unique_ptr<Window>> open(const WindowOptions& options = {});
  ~Window();

  /// Connects the window to the current ImGui context (its GLFW back end), until it closes; the
  /// context is to live as long.
  void connect_panels();
  /// Sizes, time and mouse for the next ImGui frame. ImGui counts in the desktop's units; its
  /// DisplayFramebufferScale turns them into pixels (X11: 1).
  void begin_panels();
  /// The next ImGui frame has something to see: what happened within one frame is seen in several,
  /// so that no key or click is lost and each is where it was.
  bool has_more_input() const;

  /// Takes in what has happened; waits for it first, for `seconds` at most (negative: without end;
  /// 0: not at all). False when nothing happened but the time ran out.
  bool wait(double seconds);
  /// Ends a wait(), from any thread.
  static void wake();

  glm::ivec2 pixels() const;        ///< to draw into; 0 when minimised
  glm::vec2 content_scale() const;  ///< of the monitor: 2 on a HiDPI one
  /// Whether its user has asked to close it since the last call.
  bool take_close();
  std::vector<std::string> take_dropped_files();
  void set_title(const std::string& title);

  struct State;
  State& state() const { return *state_; }

 private:
  explicit Window(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace geotherm::engine
