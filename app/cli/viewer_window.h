// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/picture/drawing.h"
#include "app/session/command.h"
#include "app/session/session.h"
#include "geotherm/error.h"

namespace geotherm::app {

/// What a window begins with.
struct ViewerStart {
  std::vector<Command> commands;  ///< at once: those that the command line stands for
  std::string script;             ///< a file of commands that follow; empty: none
  std::string session;            ///< opened as one that is dropped on the window; empty: none
  std::string device;             ///< part of its name; empty: the best
  int width = 0, height = 0;      ///< of the window; 0: the usual
  double scale = 0;               ///< of letters and panels; 0: the monitor's
  bool validation = false;        ///< reports what Vulkan's validation says as errors
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
  /// `settings` has the picture's size; `panels`: with what lies over it in the window, as pixels.
  std::function<Result<DrawnPicture>(const PictureData& data, const PictureSettings& settings,
                                     bool panels, DrawAs as)>
      draw;
  std::function<DrawingDevice()> device;
  int width = 0, height = 0;             ///< where the command names no size; 0: the settings'
  std::optional<PaperLength> text_size;  ///< there, where the settings name none
};

/// Draws and writes what a session shows, as a .png, .pdf or .svg that says of itself what
/// `render`'s do. Errors: those of drawing and writing; kBadInput: no model is open, panels as
/// shapes.
Result<void> save_view_picture(const command::SavePicture& save, const Session& session,
                               const ViewPainter& painter);

}  // namespace geotherm::app
