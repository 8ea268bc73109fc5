// SPDX-License-Identifier: MIT
#include "app/window/window_loop.h"

#include <algorithm>
#include <cmath>

#include "app/cli/picture_report.h"
#include "app/cli/viewer_window.h"
#include "app/session/machine.h"
#include "app/session/wording.h"
#include "app/text/text.h"
#include "app/window/view_canvas.h"
#include "engine/overlay/overlay.h"
#include "engine/scene/colours.h"
#include "solver/core/stopwatch.h"

// The window of the viewer: the one place where engine, panels and session meet.
namespace geotherm::app {
namespace {

using Clock = std::chrono::steady_clock;

/// A device that is lost again within this time does not come back.
constexpr std::chrono::seconds kLossPause{10};
/// While work runs, its progress is shown so often: seconds, and not more than one frame in so
/// many.
constexpr double kBusy = 0.2;
constexpr double kBusyFrames = 6;
/// While something that is dragged waits for its answer, software draws frames that show nothing
/// new so seldom.
constexpr std::chrono::milliseconds kGivesWay{150};
/// Milliseconds; above, panels that are only pointed at would lag behind the pointer.
constexpr double kSlowFrame = 120;

}  // namespace

WindowLoop::~WindowLoop() = default;

Result<std::unique_ptr<WindowLoop>> WindowLoop::open(const ViewerStart& start) {
  std::unique_ptr<WindowLoop> loop(new WindowLoop(start));
  // The model is read while the window opens.
  if (auto begun = loop->begin_session(); !begun) return begun.error();
  engine::WindowOptions options;
  if (start.width > 0) options.size = {start.width, start.height};
  auto window = engine::Window::open(options);
  if (!window) {
    return with_hint(window.error(), {"geotherm render and geotherm view ", SettingHint{"replay"},
                                      " draw without a display"});
  }
  loop->window_ = *std::move(window);
  if (auto opened = loop->open_screen(); !opened) return opened.error();
  loop->window_->connect_panels();
  loop->layout_path_ = ui::layout_path();
  loop->saved_layout_ = ui::load_layout(loop->layout_path_);
  if (start.scale > 0) loop->base_scale_ = static_cast<float>(start.scale);
  loop->interface_ =
      std::make_unique<ui::Interface>(loop->saved_layout_, engine::font_file(), loop->base_scale_);
  if (auto ready = loop->follow_scale(); !ready) return ready.error();
  if (!start.session.empty()) loop->interface_->drop({start.session});
  return loop;
}

Result<void> WindowLoop::open_screen() {
  screen_.reset();  // the window's surface belongs to one device at a time
  engine::DeviceOptions options;
  options.name = start_.device;
  options.validation = start_.validation;
  auto screen = SceneScreen::open(*window_, options);
  if (!screen) return screen.error();
  screen_ = *std::move(screen);
  font_is_uploaded_ = false;
  return {};
}

Result<void> WindowLoop::begin_session() {
  SessionHooks hooks;
  hooks.wake = [] { engine::Window::wake(); };
  hooks.save_picture = [this](const command::SavePicture& save, const Session& session) {
    return save_picture(save, session);
  };
  hooks.seen = [this] {
    const PictureSettings& picture = session_->state().picture;
    return screen_ && interface_ ? screen_->area().shown(picture) : picture;
  };
  for (const engine::ColourMap& map : engine::colour_maps()) {
    hooks.colour_maps.emplace_back(map.name);
  }
  session_ = std::make_unique<Session>(std::move(hooks));
  std::vector<Command> commands = start_.commands;
  if (!start_.script.empty()) commands.emplace_back(command::Run{start_.script});
  return session_->submit_all(commands);
}

Result<void> WindowLoop::run() {
  session_->say(LogLine::Kind::kNote, "drawing on " + device_in_words(screen_->device()));
  bool had_model = false;
  while (!session_->quits()) {
    sleep();
    if (session_->update()) clock_.something_happened();
    if (auto drawn = frame(); !drawn) {
      if (auto again = after_failure(drawn.error()); !again) return again;
    }
    if (!had_model && screen_->has_model()) {
      had_model = true;
      clock_.something_happened();  // the first picture is a quick one
      session_->say(LogLine::Kind::kNote, "first picture of a model " +
                                              milliseconds(process_milliseconds()) +
                                              " ms after the start of the program");
    }
    name_window();
    remember_layout();
  }
  const std::vector<std::string> messages = screen_->validation_messages();
  // The window goes at once, even where work that cannot be interrupted is still to end.
  interface_.reset();
  screen_.reset();
  window_.reset();
  if (messages.empty()) return {};
  return Error{ErrorCode::kNoDevice, "Vulkan's validation: " + one_line(messages.front())};
}

void WindowLoop::sleep() {
  if (clock_.frame_is_due()) {
    window_->wait(0);
    return;
  }
  double seconds = -1;
  // A bar that moves must not take the cores from the work it stands for.
  if (session_->work().busy) seconds = std::max(kBusy, kBusyFrames * full_frame_ms_ / 1e3);
  window_->wait(seconds);
  clock_.something_happened();
}

/// The monitor's scale, or that of the command line, times what the user has chosen.
Result<void> WindowLoop::follow_scale() {
  const float monitor = window_->content_scale().x;
  if (start_.scale <= 0 && monitor > 0) base_scale_ = panel_scale(monitor, pixels_per_point());
  const float scale = base_scale_ * interface_->layout().scale;
  if (scale != interface_->scale()) {
    interface_->set_scale(scale);
    font_is_uploaded_ = false;
  }
  if (font_is_uploaded_) return {};
  auto uploaded = screen_->set_panel_font(panel_font(++font_version_));
  font_is_uploaded_ = static_cast<bool>(uploaded);
  return uploaded;
}

void WindowLoop::name_window() {
  const auto& model = session_->explored().model;
  const std::string title = model ? one_line(model->model.name) + " - geotherm" : "geotherm";
  if (title == title_) return;
  title_ = title;
  window_->set_title(title);
}

void WindowLoop::remember_layout() {
  // While an edge is dragged, it changes with each frame.
  if (ImGui::IsAnyMouseDown() || interface_->layout() == saved_layout_) return;
  saved_layout_ = interface_->layout();
  [[maybe_unused]] const bool saved = ui::save_layout(layout_path_, saved_layout_);
}

float WindowLoop::pixels_per_point() const {
  const float scale = ImGui::GetIO().DisplayFramebufferScale.x;
  return scale > 0 ? scale : 1;
}

PictureArea WindowLoop::area() const {
  const ui::Rect rect = interface_->canvas();
  const float scale = pixels_per_point();
  const auto pixel = [scale](float x) { return static_cast<int>(std::lround(x * scale)); };
  PictureArea area;
  // Even: what is shaded in blocks of 2 x 2 pixels then looks as in the picture drawn alone.
  area.corner = {pixel(rect.x) & ~1, pixel(rect.y) & ~1};
  area.extent =
      glm::max(glm::ivec2(1),
               glm::ivec2(pixel(rect.x + rect.width), pixel(rect.y + rect.height)) - area.corner);
  area.line = ui::kLetters * interface_->scale() * scale;
  return area;
}

ui::FrameOutput WindowLoop::lay_out_panels(bool for_file) {
  ImGui::NewFrame();
  const ViewCanvas canvas(*screen_, session_->explored(), clock_.frames_per_second(),
                          pixels_per_point());
  ui::FrameOutput out = interface_->draw(*session_, canvas, for_file);
  ImGui::Render();
  return out;
}

Result<void> WindowLoop::frame() {
  if (window_->take_close()) {
    if (auto asked = session_->submit(command::Quit{}); !asked) return asked;
    if (session_->quits()) return {};  // else files are still written
  }
  if (const auto files = window_->take_dropped_files(); !files.empty()) interface_->drop(files);
  clock_.begin_frame();
  auto visible = screen_->follow_window();
  if (!visible) return visible.error();
  if (!*visible) return {};
  window_->begin_panels();  // it says how many pixels a point has
  if (auto ready = follow_scale(); !ready) return ready;
  if (window_->has_more_input()) clock_.something_happened();
  const ui::FrameOutput out = lay_out_panels();
  if (out.cancel) session_->cancel();
  if (out.study) session_->study();
  session_->set_dragging(out.dragging);
  const bool moves = out.dragging || session_->state().rotating;
  Detail detail = is_urgent() ? Detail::kOneSample : Detail::kFull;
  if (moves || (out.animating && full_frame_ms_ > kSlowFrame)) detail = Detail::kFewFaces;
  if (!out.commands.empty() || out.animating || detail != detail_) clock_.something_happened();
  detail_ = detail;
  // The frame that was laid out shows what commands change at once, but for the panels.
  for (const Command& command : out.commands) {
    [[maybe_unused]] const auto done = session_->submit(command);  // failures are in the log
  }
  return gives_way(out) ? Result<void>() : draw_frame(detail_);
}

/// Whether what is new should be seen soon, and work would have to share its cores with a frame
/// of all samples: a model whose distances are to come, distances while it is lit and checked.
bool WindowLoop::is_urgent() const {
  if (!screen_->has_model()) return true;
  const Explored& explored = session_->explored();
  return session_->work().busy && (!explored.a || explored.version != drawn_version_);
}

/// Whether a frame would only take the cores from the work that the next picture waits for.
bool WindowLoop::gives_way(const ui::FrameOutput& out) const {
  return out.dragging && session_->stale() && session_->explored().version == drawn_version_ &&
         Clock::now() - drawn_at_ < kGivesWay && screen_->device().software;
}

Result<void> WindowLoop::draw_frame(Detail detail) {
  const auto updated = screen_->update(*session_, area());
  // Where the device's memory ends, what it has is drawn on, with the panels that say so.
  if (!updated && updated.error().code != ErrorCode::kOutOfMemory) return updated;
  clock_.begin_drawing();
  drawn_version_ = session_->explored().version;
  drawn_at_ = Clock::now();
  const Stopwatch watch;
  auto drawn = screen_->draw(panel_draw(), detail);
  if (detail == Detail::kFull && screen_->drew_scene()) full_frame_ms_ = watch.milliseconds();
  if (drawn && session_->work().busy && !session_->explored().model && !screen_->is_warm()) {
    clock_.something_happened();  // over what that shows
    drawn = screen_->warm_up(session_->state().picture);
  }
  if (!drawn) return drawn;
  if (!updated) return updated;
  no_memory_for_.reset();
  return {};
}

Result<void> WindowLoop::after_failure(const Error& error) {
  if (error.code == ErrorCode::kOutOfMemory) {
    // What was drawn before is still there. It is said once of what was to be drawn.
    if (session_->state().timeline.playing) (void)session_->submit(command::Play{false});
    const auto& model = session_->explored().model;
    Wanted now{model ? model->model.name : std::string(), session_->state().picture};
    if (no_memory_for_ == now) return {};
    no_memory_for_ = std::move(now);
    session_->say(error);
    clock_.something_happened();
    return {};
  }
  session_->say(error);
  const Clock::time_point now = Clock::now();
  const bool again = last_loss_ && now - *last_loss_ < kLossPause;
  last_loss_ = now;
  if (again || error.code != ErrorCode::kNoDevice) return error;
  if (auto opened = open_screen(); !opened) {
    return Error{opened.error().code,
                 error.message + "; it did not come back: " + opened.error().message,
                 opened.error().hint};
  }
  session_->say(LogLine::Kind::kNote, "the device came back");
  clock_.something_happened();
  return {};
}

Result<DrawnPicture> WindowLoop::picture_with_panels(const PictureSettings& settings) {
  // A script may ask before the window has had its first frame.
  if (auto ready = follow_scale(); !ready) return ready.error();
  ImGuiIO& io = ImGui::GetIO();
  const float scale = pixels_per_point();
  const glm::ivec2 extent(settings.width, settings.height);
  const ImVec2 usual_size{std::max(0.0F, io.DisplaySize.x), std::max(0.0F, io.DisplaySize.y)};
  const ImVec2 usual_mouse = io.MousePos;
  io.DisplaySize = {static_cast<float>(extent.x) / scale, static_cast<float>(extent.y) / scale};
  io.MousePos = {-FLT_MAX, -FLT_MAX};
  const PictureArea usual_area = screen_->area();
  lay_out_panels(true);  // sizes first,
  lay_out_panels(true);  // then what depends on them
  auto updated = screen_->update(*session_, area());
  Result<DrawnPicture> picture =
      updated ? screen_->picture_of_window(extent, panel_draw()) : updated.error();
  io.DisplaySize = usual_size;
  io.MousePos = usual_mouse;
  lay_out_panels();
  if (auto back = screen_->update(*session_, usual_area); !back) return back.error();
  return picture;
}

Result<void> WindowLoop::save_picture(const command::SavePicture& save, const Session& session) {
  const bool drawable = screen_->window_extent().x > 0;
  if (auto updated = screen_->update(session, screen_->area()); !updated) return updated;
  ViewPainter painter;
  painter.device = [this] { return screen_->device(); };
  const glm::ivec2 extent = save.panels ? screen_->window_extent() : screen_->area().extent;
  if (drawable) {
    painter.width = extent.x;
    painter.height = extent.y;
    painter.text_size = screen_->area().shown({}).text_size;
  }
  painter.draw = [this](const PictureData& data, const PictureSettings& settings, bool panels,
                        DrawAs as) {
    return panels ? picture_with_panels(settings) : screen_->picture(data, settings, as);
  };
  return save_view_picture(save, session, painter);
}

namespace {

class EngineWindow final : public ViewerWindow {
 public:
  Result<void> run(const ViewerStart& start) override {
    auto loop = WindowLoop::open(start);
    if (!loop) return loop.error();
    return (*loop)->run();
  }
};

}  // namespace

std::unique_ptr<ViewerWindow> make_window() { return std::make_unique<EngineWindow>(); }

}  // namespace geotherm::app
