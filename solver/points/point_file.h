// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "geotherm/error.h"
#include "solver/points/point_cloud.h"

// Point clouds from files.
namespace geotherm {

/// Points as read from a file, and what the reader left out.
struct PointFile {
  PointCloud points;
  std::vector<std::string> notes;  ///< one sentence each, for people
};

/// Reads points, numbered from 0 in the order of the file; the extension decides, in any case:
///
/// - `.ply` (ASCII, little and big endian): the element `vertex`, with normals where it has `nx`,
///   `ny`, `nz`. Faces are left out.
/// - `.xyz`: a point a line, x y z and what else there is, separated by blanks or commas. Columns 4
///   to 6 are normals where they are vectors of length 1 (or 0) in all lines. `#` and `//` begin
///   comments.
/// - `.pts`: a line with the number of points and then as many, x y z and what else there is; and
///   again.
/// - `.pcd` (version 0.7: `ascii`, `binary`, `binary_compressed`): the fields x, y, z, and
///   normal_x, normal_y, normal_z where there are such. Points whose coordinates are not finite
///   stand for nothing in this format: they are left out and have no number.
///
/// Errors: one sentence, "PATH: line N: ..." or "PATH: byte N: ..." with the cause (kBadFile); an
/// unknown extension (kNotAvailable); kOutOfMemory. Never throws. What a file announces is held
/// against its size before memory is asked for. A file that others change while it is read is an
/// error (kBadFile). Independent of the locale. Cost: a copy of the file in memory, and one pass
/// over it.
Result<PointFile> read_points(const std::string& path);

/// The names of the formats: ply, xyz, pts, pcd.
std::vector<std::string> point_formats();

/// Whether the file holds points without faces: by its extension, of a `.ply` by its header. A
/// `.ply` whose header cannot be read is none. Errors (kBadFile): a `.ply` that cannot be opened.
/// Cost: the header.
Result<bool> is_point_file(const std::string& path);

}  // namespace geotherm
