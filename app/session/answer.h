// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/session/check.h"
#include "app/session/model.h"
#include "geotherm/build_method.h"
#include "geotherm/mesh_report.h"

namespace geotherm::app {

/// Extremes and mean of distances from one source set or from many.
struct DistanceSummary {
  double min = kUnreached, max = 0, mean = 0;  ///< of those that are finite, model units
  std::int64_t unreached = 0;                  ///< how many are not
  double reached = 0;                          ///< how many are

  void add(std::span<const double> row);  ///< those from one more source set
  void add(const DistanceSummary& more);  ///< those of other source sets
};
DistanceSummary summarize(std::span<const double> distances);

/// Distances from one source set, and all there is to say about them: what tables, JSON, files,
/// panels and pictures are made from.
struct Answer {
  Model model;
  MeshSummary mesh;
  std::shared_ptr<const DistanceMethod> method;
  MethodOptions options;  ///< of `method`
  SourceSet sources;
  Reach reach;            ///< how far it goes
  DistanceResult result;  ///< of all vertices, beyond the reach infinite; `vertices`: the targets
  DistanceSummary distance;
  SetupTiming setup;       ///< time of the set-up, with the parts reused from an earlier method
  double setup_ms = 0;     ///< from the question to the method being ready
  double peak_rss_mb = 0;  ///< of set-up and query
  double report_ms = 0;    ///< of `mesh`, where it was timed
  std::vector<Warning> warnings;
  std::shared_ptr<const AccuracyReport> error = {};     ///< null: it was not to be checked
  std::shared_ptr<const AccuracyReport> replaced = {};  ///< of the poor answer before this one
};

/// .vtu holds tets alone, .vti grids; what else check_distance_path() knows holds any model.
/// Errors: kBadInput, kNotAvailable.
Result<void> check_answer_path(const Model& model, const std::string& path);

/// As write_distances(). A space has files of its own; what else there is holds what is drawn of
/// it. Precondition: check_answer_path() accepts the path.
Result<void> write_answer(const std::string& path, const Model& model,
                          std::span<const double> distances, std::span<const Index> nearest,
                          std::span<const DataField> fields);

/// The answer as the library checks it; valid as long as the answer.
CheckedAnswers checked_answers(const Answer& answer);

/// Puts the space's own vertices and components in place of those of what is drawn of it; where its
/// vertices have no places, also its area, and no length of edges.
void describe_space(const Model& model, MeshSummary& mesh);
/// And its box.
void describe_space(const Model& model, MeshReport& mesh);

/// One sentence for each reason why `unreached` vertices of a surface have no distance. `whole`:
/// the mesh, for the hint that welding joins its components; null where that is not looked for.
std::vector<Warning> unreached_notes(const MeshSummary& mesh, Index unreached,
                                     const TriangleMesh* whole = nullptr);

/// Turns kBadInput of the library, which found something wrong with the mesh, into kBadFile, unless
/// it is about a setting; the model's name comes in front where it has one.
Error about_model(const std::string& name, const Error& error);

/// Says how many vertices of faces have no distance, where there are such. `from`: "a source".
void note_unreached(const TriangleMesh& mesh, std::span<const double> distances,
                    const std::string& from, std::vector<Warning>& warnings);

/// One source with the vertices that it is nearest to: a geodesic Voronoi cell.
struct Region {
  Index label = 0;                    ///< the group (source_groups())
  std::optional<SurfacePoint> point;  ///< the first of the group, where it has one
  std::optional<CellPoint> in_cell;   ///< where that is a point in a cell
  Index edges = 0;                    ///< of the group
  Index segments = 0;                 ///< of the group
  Index vertices = 0;                 ///< that it is nearest to
};

/// One for each group, ascending.
std::vector<Region> regions_of(const SourceSet& sources, std::span<const Index> nearest);

}  // namespace geotherm::app
