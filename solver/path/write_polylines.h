// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string>

#include "solver/core/result.h"
#include "solver/path/surface_path.h"

namespace geotherm {

/// A line for a file, with its number there in the order given.
struct Polyline {
  const SurfacePath* path = nullptr;
  std::optional<double> value;  ///< of an isoline; all lines of a file have one or none has
};

/// Errors: kNotAvailable, with the formats there are, unless write_polylines() knows the ending.
Result<void> check_polyline_path(const std::string& path);

/// Writes lines by the ending of `path`:
/// - .obj: `v` and one `l` a line (`p` for a single point); a closed line ends where it begins.
/// - .csv: polyline_csv().
/// - .vtp: VTK PolyData with the cell data `length`, `closed` and, where there are any, `value`.
/// Errors: kNotAvailable (another ending), kBadFile.
Result<void> write_polylines(const std::string& path, const TriangleMesh& mesh,
                             std::span<const Polyline> lines);

/// One row a point: line,point,x,y,z,face,b0,b1,b2 and, where there are any, value. Faces and
/// weights are those of points_in_faces(). A closed line repeats its first point.
std::string polyline_csv(const TriangleMesh& mesh, std::span<const Polyline> lines);

}  // namespace geotherm
