// SPDX-License-Identifier: MIT
// One reader of points per format. Each takes the bytes of FileBytes (with its padding) and throws
// ReadFailure or std::bad_alloc.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "geotherm/types.h"

namespace geotherm::io {

/// What a reader hands over; every coordinate is finite.
struct RawPoints {
  std::vector<Vec3> positions;
  std::vector<Vec3> normals;  ///< as many, or none
  std::vector<std::string> notes;
};

RawPoints read_ply_points(std::string_view bytes);
RawPoints read_xyz_points(std::string_view text);
RawPoints read_pts_points(std::string_view text);
RawPoints read_pcd_points(std::string_view bytes);

}  // namespace geotherm::io
