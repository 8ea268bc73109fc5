// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/picture/picture_data.h"
#include "app/picture/picture_settings.h"
#include "geotherm/error.h"
#include "geotherm/progress.h"

namespace geotherm::app {

struct Figure;

/// A finished picture: rows from the top, four bytes a pixel, alpha not multiplied in.
struct DrawnPicture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> pixels;
  std::shared_ptr<const Figure> figure = nullptr;  ///< DrawAs::kFigure: what lies over the pixels
};

/// All of a picture as pixels, or its lines, markers and letters apart, as shapes.
enum class DrawAs { kPixels, kFigure };

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

  /// The letters of a text that pictures show as a box, such as "'x' (U+1234)", each once. Needs no
  /// device.
  virtual std::vector<std::string> missing_letters(const std::string& /*text*/) const { return {}; }

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
                            const TakeFrame& frame, DrawAs as = DrawAs::kPixels) = 0;

  /// The same of several models side by side, row after row, each over its caption, with one
  /// colour bar for all. Preconditions: open(), 1 <= columns, some cells; the settings give all of
  /// them one scale.
  virtual Result<void> draw_cells(const std::vector<PictureData>& cells, int columns,
                                  const PictureSettings& settings, const TakeFrame& frame) = 0;
};

/// What this build draws with: the engine, or a stand-in that says that there is none. Opens
/// nothing yet.
std::unique_ptr<Drawing> make_drawing();

}  // namespace geotherm::app
