// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/picture/picture_settings.h"
#include "geotherm/error.h"
#include "geotherm/path.h"
#include "geotherm/progress.h"

// Lines on a surface as a vector picture, seen as `render` sees the model.
namespace geotherm::app {

/// What is shown.
struct LinePicture {
  std::shared_ptr<const TriangleMesh> mesh;
  std::vector<Polyline> lines;  ///< on a scale those without a value are black
  std::vector<Vec3> markers;    ///< model units: ends of paths, sources
  double largest_value = 0;     ///< of the colour scale; 0: one colour
  std::string title;
  double least_value = 0;     ///< where the scale begins; below 0 both sides of 0 have own colours
  bool shows_hidden = true;   ///< of lines in one colour: dashes where the surface hides them
  UpAxis up = UpAxis::kAuto;  ///< that of the model's file, for cameras that leave it open
};

struct LinePictureSvg {
  std::string text;
  bool shows_lines = false;  ///< or the surface hides all of them
};

/// The lines where the surface does not hide them, over its shape in a few tones and its outline.
/// Errors: those of RayTree::build(), kCancelled.
Result<LinePictureSvg> line_picture_svg(const LinePicture& picture, const PictureSettings& settings,
                                        const Progress& progress = {});

}  // namespace geotherm::app
