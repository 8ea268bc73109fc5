// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>

#include "app/cli/drawing.h"
#include "app/session/session.h"

namespace geotherm::app {

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
