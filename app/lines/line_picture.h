// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/cli_app.h"
#include "app/picture/picture_settings.h"
#include "solver/core/progress.h"
#include "solver/core/result.h"
#include "solver/path/write_polylines.h"

// Lines on a surface as a vector picture, seen as `render` sees the model.
namespace geotherm::app {

/// How the picture is to look, as typed.
struct LinePictureArguments {
  std::string size = "1280x720", background = "light";
  std::string azimuth = "30", elevation = "20", zoom = "1", pan = "0:0";
  std::string projection = "perspective";
};

struct LinePictureSettings {
  int width = 1280, height = 720;
  PictureBackground background = PictureBackground::kLight;
  CameraSettings camera;
};

/// What is shown.
struct LinePicture {
  std::shared_ptr<const TriangleMesh> mesh;
  std::vector<Polyline> lines;
  std::vector<Vec3> markers;  ///< model units: ends of paths, sources
  double largest_value = 0;   ///< of the colour scale, which begins at 0; 0: one colour
  std::string title;
};

void add_line_picture_options(CLI::App& command, LinePictureArguments& arguments);

/// Errors: kBadInput, with the option's name.
Result<LinePictureSettings> line_picture_settings(const LinePictureArguments& arguments);

struct LinePictureSvg {
  std::string text;
  bool shows_lines = false;  ///< or the surface hides all of them
};

/// The lines where the surface does not hide them, over its shape in a few tones and its outline.
/// Errors: those of RayTree::build(), kCancelled.
Result<LinePictureSvg> line_picture_svg(const LinePicture& picture,
                                        const LinePictureSettings& settings,
                                        const Progress& progress = {});

}  // namespace geotherm::app
