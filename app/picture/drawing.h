// SPDX-License-Identifier: MIT
#pragma once

#include <array>
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
/// A word about a picture that travels in its file.
struct FileText {
  std::string keyword;  ///< 1 to 79 letters of ASCII
  std::string text;     ///< UTF-8; bytes that are not become '?'
};

/// A device on which pictures can be drawn, for `geotherm devices`.
struct DrawingDevice {
  std::string name, kind, driver, api;
  double memory_mb = 0;
  bool software = false, chosen = false;
  std::vector<std::string> lacks;  ///< why it cannot be used; empty: it can
};

/// A file that others draw and turn.
enum class SceneFormat {
  kGlb,   ///< glTF 2.0: surface, colours, distances, paths
  kPage,  ///< HTML that draws by itself, without any other file
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
  /// What was asked to be written about a picture and has no room in it, such as "the colour bar":
  /// all of it by a size of letters or of paper, else a title, and a bar by its label or units.
  /// Needs no device.
  virtual std::vector<std::string> left_out(const PictureData& /*data*/,
                                            const PictureSettings& /*settings*/) const {
    return {};
  }
  /// The colours of a map, near to far, as sRGB bytes. Needs no device. Errors: kNotAvailable (no
  /// such map), kNoDevice (this build has no renderer).
  using Colours = std::vector<std::array<std::uint8_t, 3>>;
  virtual Result<Colours> colours(const std::string& map) const = 0;

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
  /// them one scale. Errors: those of draw(), kBadInput (a cell has no pixel).
  virtual Result<void> draw_cells(const std::vector<PictureData>& cells, int columns,
                                  const PictureSettings& settings, const TakeFrame& frame,
                                  DrawAs as = DrawAs::kPixels) = 0;

  /// The bytes of a file of what draw() would show. `texts`: what it says about itself. Needs no
  /// device. Errors: kBadInput (coordinates beyond what the format holds), kOutOfMemory, kNoDevice
  /// (this build has no renderer).
  virtual Result<std::string> scene_file(SceneFormat format, const PictureData& data,
                                         const PictureSettings& settings,
                                         const std::vector<FileText>& texts) = 0;
};

/// What this build draws with: the engine, or a stand-in that says that there is none. Opens
/// nothing yet.
std::unique_ptr<Drawing> make_drawing();

}  // namespace geotherm::app
