// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/picture/drawing.h"
#include "app/picture/picture_scale.h"
#include "app/picture/png_file.h"
#include "app/session/model.h"
#include "app/session/report.h"

namespace geotherm::app {

/// All there is to say about pictures of one model.
struct PictureFigures {
  Model model;
  std::string model_argument;        ///< as typed: a path or a bundled name
  std::vector<std::string> sources;  ///< as typed
  std::string field;                 ///< the file of the values in place of distances, or empty
  std::optional<Answer> solve;       ///< none: drawn without distances
  PictureSettings settings;
  PictureScale scale;
  DrawingDevice device;
  std::vector<std::string> paths;  ///< one a frame
  std::size_t scene_bytes = 0;     ///< of a file that others draw; 0: pictures
  struct Line {
    std::string target, field;
    double length = 0;  ///< model units
  };
  std::vector<Line> lines;           ///< paths that are drawn
  double draw_ms = 0, write_ms = 0;  ///< all frames together
  std::string frames, frame_times;   ///< in words, of a surface that moves; empty: it does not
};

/// "bunny, 4,000 faces, t = 0.0123, cholmod": what stands under a picture.
std::string caption_of(const PictureFigures& figures);

/// What the file of frame i says about itself: software, title, the command line, and every option
/// of solve and picture with its value.
std::vector<FileText> picture_texts(const PictureFigures& figures, int frame);

/// The keys of solve_json where there was a solve, and `picture`.
Json picture_json(const PictureFigures& figures);

/// What `render` shows to people.
std::string picture_table(const PictureFigures& figures);

/// "llvmpipe, in software".
std::string device_in_words(const DrawingDevice& device);

}  // namespace geotherm::app
