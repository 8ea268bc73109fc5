// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "app/picture/drawing.h"
#include "app/picture/picture_data.h"
#include "app/picture/picture_settings.h"
#include "geotherm/error.h"

// Files that others draw (Drawing::scene_file()), of what a picture shows: `shown` is the data, or
// what a slice leaves of them; scales and cameras are those of the whole.
namespace geotherm::app {

/// A binary glTF: the surface in model units with the colours of the view, its distances as the
/// vertex attribute _DISTANCE (_ERROR of a view of errors), and the paths. Where the model is far
/// from the origin its vertices are relative to a translated node.
Result<std::string> glb_file(const PictureData& shown, const PictureData& whole,
                             const PictureSettings& settings, const std::vector<FileText>& texts);

/// A page that draws the picture with WebGL 2.
Result<std::string> page_file(const PictureData& shown, const PictureData& whole,
                              const PictureSettings& settings, const std::vector<FileText>& texts);

}  // namespace geotherm::app
