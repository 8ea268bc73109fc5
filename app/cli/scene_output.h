// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/cli/options.h"
#include "app/cli/picture_report.h"
#include "app/picture/drawing.h"
#include "app/session/outputs.h"

// `render -o FILE.glb` and `FILE.html`: scenes that others draw.
namespace geotherm::app {

/// By the extension; nothing where a picture is asked for.
std::optional<SceneFormat> scene_format(const std::string& path);

/// What such a file has no place for, and was asked for, becomes a warning: settings, and what the
/// view draws beside colours.
void note_what_has_no_place(const SettingArguments& typed, SceneFormat format, View view,
                            const PictureData& data, std::vector<Warning>& warnings);

/// Writes the scene to figures.paths. Errors: those of Drawing::scene_file() and of the file.
Result<void> write_scene(Drawing& drawing, SceneFormat format, const PictureData& data,
                         const Progress& progress, Outputs& outputs, PictureFigures& figures);

}  // namespace geotherm::app
