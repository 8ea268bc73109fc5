// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "app/picture/picture_data.h"
#include "geotherm/path.h"

// What pictures show of directions: log maps as lines, vectors as arrows.
namespace geotherm::app {

/// Lines on which x cos(a) + y sin(a) has each of the levels, for each of the angles: of the map's
/// coordinates x and y (V, no numbers where it has none). Where the map is torn there are none.
/// Errors: kOutOfMemory.
Result<std::vector<Isoline>> map_lines(const TriangleMesh& mesh, std::vector<double> x,
                                       std::vector<double> y, std::span<const double> angles,
                                       std::span<const double> levels);

/// Shows a log map instead: its distances, and lines of equal direction every 15 degrees. All V.
/// Errors: kOutOfMemory.
Result<void> add_log_map(PictureData& data, const TriangleMesh& mesh,
                         std::span<const double> distances, std::vector<double> x,
                         std::vector<double> y);

/// Shows vectors of vertices instead (V): their lengths in colour, and arrows as long as the
/// vectors on the faces. What is not finite has none.
void add_vectors(PictureData& data, const TriangleMesh& mesh, std::span<const Vec3> vectors);

}  // namespace geotherm::app
