// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/cli/commands.h"
#include "app/cli/film.h"
#include "app/cli/picture_report.h"
#include "app/picture/figure.h"
#include "app/session/sources.h"
#include "solver/core/stopwatch.h"

// What `render` of one model, of several and of frames have in common.
namespace geotherm::app {

/// Points that were named before a model was read.
struct RenderPlaces {
  std::vector<Source> sources, targets;
};

/// What cannot be drawn together. Errors: kBadInput.
Result<void> check_figure(const PictureSettings& settings, const MethodOptions& options,
                          const RenderArguments& arguments);

/// What --field takes the place of. Errors: kBadInput.
Result<void> check_field(const RenderArguments& arguments, View view, bool has_sources);

/// --fps, and what films cannot show. Errors: kBadInput, those of find_ffmpeg().
Result<void> check_film(const RenderArguments& arguments, const PictureSettings& settings);

/// The figure that a path names; absent: pixels.
std::optional<FigureFormat> figure_format(const std::string& path);

/// Reads the model, solves where sources are given, and fills the data.
Result<PictureData> prepare_picture(const RenderArguments& arguments, const ViewerState& asked,
                                    const RenderPlaces& places, CheckSettings check,
                                    const Progress& progress, PictureFigures& figures,
                                    std::vector<Warning>& warnings);

/// Says what is missing in a picture: lines, faces, letters, the use of options.
void note_picture(const RenderArguments& arguments, const PictureFigures& figures,
                  const PictureData& data, const Drawing& drawing, std::vector<Warning>& warnings);

/// The files of a turn of the camera: one a frame, or the film that holds all.
std::vector<std::string> picture_paths(const std::string& output, const PictureSettings& settings);

/// Encodes and writes the frames of figures.paths, or makes a film of them.
class FrameWriter {
 public:
  /// `standard_output` takes the picture of "-".
  FrameWriter(const RenderArguments& arguments, Outputs& outputs, PictureFigures& figures,
              Progress progress, std::string& standard_output);

  /// Errors: kCancelled, those of png_bytes(), Outputs and Film.
  Result<void> take(int frame, const DrawnPicture& picture);
  Drawing::TakeFrame taker() {
    return [this](int frame, const DrawnPicture& picture) { return take(frame, picture); };
  }

  const std::string& path() const { return arguments_.output; }
  DrawAs as() const { return figure_format(path()) ? DrawAs::kFigure : DrawAs::kPixels; }

  /// The film is whole. Errors: those of Film.
  Result<void> finish();

 private:
  const RenderArguments& arguments_;
  Outputs& outputs_;
  PictureFigures& figures_;
  Progress progress_;
  std::string& standard_output_;
  std::optional<Film> film_;
  Stopwatch watch_;
};

/// `render A B ...`: the models side by side, with one scale of colours. `outputs`: expected.
Result<CommandOutput> run_render_models(const RenderArguments& arguments, const AskedPicture& asked,
                                        const RenderPlaces& places, DrawingDevice device,
                                        Drawing& drawing, Outputs& outputs,
                                        const Progress& progress);

}  // namespace geotherm::app
