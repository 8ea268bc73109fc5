// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/session/model.h"
#include "app/session/report.h"
#include "geotherm/accuracy.h"
#include "geotherm/build_method.h"
#include "geotherm/path.h"

// What `path` says of its paths.
namespace geotherm::app {

/// A path with the points it was asked to go through.
struct FoundLine {
  std::vector<SurfacePoint> stops;
  SurfacePath path;
};

/// All there is to say about the paths of one command; one at least.
struct PathFigures {
  Model model;
  MethodOptions method;
  PathOptions options;
  std::vector<FoundLine> paths;
  double setup_ms = 0, path_ms = 0;
  std::vector<Warning> warnings;
  std::optional<AccuracyReport> error;  ///< of the distances from the start that lead the way
};

/// Where a path runs: "points" in space, and the same as "faces" with their "barycentric" weights.
Json points_json(const TriangleMesh& mesh, const SurfacePath& path);

/// The first path's keys, then those of the work; with several paths each is in `paths`. points[i]
/// has the weights barycentric[i] in faces[i], which also holds the piece up to points[i + 1].
Json path_json(const PathFigures& figures);

/// What is shown to people.
std::string path_table(const PathFigures& figures);

/// A table of the lengths, as CSV.
std::string lengths_csv(const PathFigures& figures);

}  // namespace geotherm::app
