// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/picture/picture_data.h"
#include "app/picture/picture_settings.h"
#include "app/session/command.h"
#include "app/session/session.h"
#include "geotherm/error.h"
#include "geotherm/progress.h"

namespace geotherm::app {

/// A finished picture: rows from the top, four bytes a pixel, alpha not multiplied in.
struct DrawnPicture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> pixels;
};

/// A device on which pictures can be drawn, for `geotherm devices`.
struct DrawingDevice {
  std::string name, kind, driver, api;
  double memory_mb = 0;
  bool software = false, chosen = false;
  std::vector<std::string> lacks;  ///< why it cannot be used; empty: it can
};

/// What draws: the program's one link to the engine, which this folder does not know. main() hands
/// in the real one.
class Drawing {
 public:
  virtual ~Drawing() = default;

  /// Names of the colour maps, the default first. Needs no device.
  virtual std::vector<std::string> colour_maps() const = 0;

  /// All devices, in the order of preference. Errors: kNoDevice (no loader, no device).
  virtual Result<std::vector<DrawingDevice>> devices() = 0;

  /// Opens the device that the settings name. Called before the solve, so that a machine that
  /// cannot draw says so at once. Errors: kNoDevice, kOutOfMemory.
  virtual Result<DrawingDevice> open(const PictureSettings& settings) = 0;

  /// Draws `data` as the settings say, once for each camera turn: `frame(i, picture)` is called for
  /// i = 0 .. max(turntable, 1) - 1 and ends the work by returning an error. Precondition: open().
  /// Errors: kNoDevice (it was lost), kOutOfMemory, those of `frame`.
  using TakeFrame = std::function<Result<void>(int, const DrawnPicture&)>;
  virtual Result<void> draw(const PictureData& data, const PictureSettings& settings,
                            const TakeFrame& frame) = 0;
};

/// What this build draws with: the engine, or a stand-in that says that there is none. Opens
/// nothing yet.
std::unique_ptr<Drawing> make_drawing();

/// What a window begins with.
struct ViewerStart {
  std::vector<Command> commands;  ///< at once: those that the command line stands for
  std::string script;             ///< a file of commands that follow; empty: none
  std::string device;             ///< part of its name; empty: the best
  int width = 0, height = 0;      ///< of the window; 0: the usual
  double scale = 0;               ///< of letters and panels; 0: the monitor's
  bool validation = false;        ///< reports what Vulkan's validation says as errors
  std::string command;            ///< the command line, for the files of pictures
};

/// The program's link to the window, which this folder does not know. main() hands in the real one.
class ViewerWindow {
 public:
  virtual ~ViewerWindow() = default;

  /// Opens the window and returns when it is closed. Errors: kNoDevice (no display, no device, a
  /// device that was lost and did not come back), kBadFile (a model or script that cannot be read
  /// at the start), kNumericalFailure (validation spoke).
  virtual Result<void> run(const ViewerStart& start) = 0;
};

/// The window of this build, or a stand-in that says that there is none. Opens nothing yet.
std::unique_ptr<ViewerWindow> make_window();

/// Who draws the picture of a session, and what its file says about that.
struct ViewPainter {
  /// `settings` has the picture's size; `panels`: with what lies over it in the window.
  std::function<Result<DrawnPicture>(const PictureData& data, const PictureSettings& settings,
                                     bool panels)>
      draw;
  std::function<DrawingDevice()> device;
  std::string command;        ///< the command line
  int width = 0, height = 0;  ///< where the command names no size; 0: the settings'
};

/// Draws and writes what a session shows, as a .png that says of itself what `render`'s do.
/// Errors: those of drawing and writing; kBadInput: no model is open.
Result<void> save_view_picture(const command::SavePicture& save, const Session& session,
                               const ViewPainter& painter);

}  // namespace geotherm::app
