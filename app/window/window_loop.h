// SPDX-License-Identifier: MIT
#pragma once

#include <imgui.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>

#include "app/cli/viewer_window.h"
#include "app/window/scene_screen.h"
#include "engine/window/window.h"
#include "ui/interface.h"

namespace geotherm::app {

/// Says how long the loop may sleep, and how many frames a second were drawn of late.
class FrameClock {
 public:
  using Clock = std::chrono::steady_clock;

  /// Frames that follow something that happened: what is laid out anew settles in two. Where the
  /// panels want more, they say so.
  static constexpr int kFramesAfterEvent = 2;

  void something_happened() { frames_left_ = kFramesAfterEvent; }
  bool frame_is_due() const { return frames_left_ > 0; }

  void begin_frame() {
    if (frames_left_ > 0) --frames_left_;
  }

  /// Those that are laid out and give way to work do not count.
  void begin_drawing() {
    const Clock::time_point now = Clock::now();
    // A pause is no slow frame.
    if (!begins_.empty() && now - begins_.back() > std::chrono::seconds(1)) begins_.clear();
    begins_.push_back(now);
    if (begins_.size() > kFrames) begins_.pop_front();
  }

  double frames_per_second() const {
    if (begins_.size() < 2) return 0;
    const std::chrono::duration<double> span = begins_.back() - begins_.front();
    return span.count() > 0 ? static_cast<double>(begins_.size() - 1) / span.count() : 0;
  }

 private:
  static constexpr std::size_t kFrames = 30;
  int frames_left_ = kFramesAfterEvent;
  std::deque<Clock::time_point> begins_;
};

/// The scale of panels in ImGui's points, on a monitor that asks for `monitor` times as many pixels
/// as usual: on Wayland points have these pixels already, on X11 a point is a pixel. Of a window
/// `pixels_per_point` is known but for a pixel of its width, and scales are multiples of 1/20.
inline float panel_scale(float monitor, float pixels_per_point) {
  constexpr float kSteps = 20;
  return monitor / (std::round(kSteps * pixels_per_point) / kSteps);
}

/// Dear ImGui's context, current while it lives.
struct PanelContext {
  PanelContext() : context(ImGui::CreateContext()) {}
  ~PanelContext() { ImGui::DestroyContext(context); }
  PanelContext(const PanelContext&) = delete;
  PanelContext& operator=(const PanelContext&) = delete;
  ImGuiContext* context;
};

/// A window from opening to closing. Draws when something has happened and sleeps otherwise.
class WindowLoop {
 public:
  /// Errors: kNoDevice.
  static Result<std::unique_ptr<WindowLoop>> open(const ViewerStart& start);
  ~WindowLoop();

  /// Until the user quits. Errors: those of a device that was lost and did not come back, and of
  /// the commands it starts with.
  Result<void> run();

 private:
  explicit WindowLoop(const ViewerStart& start) : start_(start) {}

  Result<void> begin_session();
  Result<void> open_screen();
  Result<void> frame();
  Result<void> draw_frame(Detail detail);
  bool is_urgent() const;
  bool gives_way(const ui::FrameOutput& out) const;
  Result<void> after_failure(const Error& error);
  void sleep();
  Result<void> follow_scale();
  void remember_layout();
  void name_window();
  ui::FrameOutput lay_out_panels(bool for_file = false);
  PictureArea area() const;
  float pixels_per_point() const;

  Result<void> save_picture(const command::SavePicture& save, const Session& session);
  Result<DrawnPicture> picture_with_panels(const PictureSettings& settings);

  ViewerStart start_;
  // In the order of creation; the last go first: the session's workers before all that they wake.
  PanelContext panels_;
  std::unique_ptr<engine::Window> window_;
  std::unique_ptr<SceneScreen> screen_;
  std::unique_ptr<ui::Interface> interface_;
  std::unique_ptr<Session> session_;
  std::string title_;  ///< of the window
  std::string layout_path_;
  ui::Layout saved_layout_;
  std::uint64_t font_version_ = 0;
  bool font_is_uploaded_ = false;
  float base_scale_ = 1;  ///< of the monitor or the command line
  FrameClock clock_;
  std::optional<std::chrono::steady_clock::time_point> last_loss_;
  struct Wanted {
    std::string model;  ///< its name: frames of a sequence have that of the sequence
    PictureDataSettings settings;
    bool operator==(const Wanted&) const = default;
  };
  std::optional<Wanted> no_memory_for_;  ///< what was drawn last, and it was said
  std::uint64_t drawn_version_ = 0;      ///< of Explored, in the last frame
  std::chrono::steady_clock::time_point drawn_at_;
  Detail detail_ = Detail::kFull;  ///< of the last frame
  double full_frame_ms_ = 0;       ///< of the last one with all samples
};

}  // namespace geotherm::app
