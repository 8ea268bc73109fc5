// SPDX-License-Identifier: MIT
#include "app/picture/picture_settings.h"

#include <algorithm>
#include <cmath>

namespace geotherm::app {

int frame_count(const PictureSettings& settings) { return std::max(settings.turntable, 1); }

CameraSettings frame_camera(const PictureSettings& settings, int frame) {
  constexpr double kTurn = 360;
  CameraSettings camera = settings.camera;
  if (settings.turntable == 0) return camera;
  camera.azimuth = std::fmod(camera.azimuth + kTurn * frame / settings.turntable, kTurn);
  if (camera.azimuth < 0) camera.azimuth += kTurn;
  return camera;
}

std::vector<std::string> frame_paths(const std::string& output, const PictureSettings& settings) {
  if (settings.turntable == 0) return {output};
  const std::size_t slash = output.rfind('/');
  const std::size_t point = output.rfind('.');
  const bool has_extension =
      point != std::string::npos && (slash == std::string::npos || point > slash);
  const std::string stem = output.substr(0, has_extension ? point : output.size());
  const std::string extension = output.substr(stem.size());
  const std::size_t digits =
      std::max<std::size_t>(3, std::to_string(settings.turntable - 1).size());
  std::vector<std::string> paths;
  for (int i = 0; i < settings.turntable; ++i) {
    const std::string number = std::to_string(i);
    paths.push_back(stem + '-' + std::string(digits - number.size(), '0') + number + extension);
  }
  return paths;
}

}  // namespace geotherm::app
