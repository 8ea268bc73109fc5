// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "app/picture/picture_settings.h"

// A turntable is a turn of the camera about the vertical axis in equal steps; one picture is a turn
// of one frame.
namespace geotherm::app {

int frame_count(const PictureSettings& settings);

/// The camera's settings for frame i, azimuth within 0 to 360 unless there is one frame.
CameraSettings frame_camera(const PictureSettings& settings, int frame);

/// Where each frame goes: `output` itself for one picture; for a turntable of N its name with -000
/// to N - 1 before the extension, with as many digits as N - 1 has and at least three.
std::vector<std::string> frame_paths(const std::string& output, const PictureSettings& settings);

}  // namespace geotherm::app
