// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "bench/bench_mesh.h"
#include "bench/measure.h"
#include "geotherm/distance_method.h"
#include "geotherm/mesh.h"

// What the benchmark measures: reading, solving, surfaces that move, the viewer.
namespace geotherm::bench {

/// Reading of one OBJ file. Times are the least of several runs, in turns.
struct LoadRow {
  std::string mesh;
  Index faces = 0;
  double ms = kNotMeasured;
  double tinyobjloader_ms = kNotMeasured;  ///< not measured in a build without tinyobjloader
  std::string failure;                     ///< empty: none

  double ratio() const { return tinyobjloader_ms / ms; }
};

/// Writes the mesh to a temporary OBJ file with six decimals, as modellers export them, and reads
/// it `runs` times with each reader.
LoadRow measure_load(const std::string& name, const TriangleMesh& mesh, int runs);

/// Set-up and one query for each frame of a waving model. Times are means over the frames.
struct MovingRow {
  MethodKind method = MethodKind::kHeat;
  std::string mesh;
  Index faces = 0;
  int frames = 0;
  double fresh_ms = kNotMeasured;    ///< everything is made for each frame
  double moved_ms = kNotMeasured;    ///< build_method_moved() from the frame before
  double query_ms = kNotMeasured;    ///< of `moved_ms`, the query
  double difference = kNotMeasured;  ///< of their distances, over the largest one
  std::string failure = {};          ///< empty: none

  double ratio() const { return fresh_ms / moved_ms; }
};

/// Precondition: frames >= 1. Both ways take turns.
MovingRow measure_moving(MethodKind method, const std::string& name, const TriangleMesh& mesh,
                         int frames, int threads);

/// All contenders on one mesh.
struct SolveGroup {
  std::string mesh;
  Index vertices = 0, faces = 0;
  bool regular = false;          ///< as Case has it
  std::vector<Figures> figures;  ///< the baseline's too, where there is one
  /// Largest difference between the baseline's distances and ours when ours are discretised the
  /// same way, divided by the largest distance: that both do the same work.
  double disagreement = kNotMeasured;
  std::string failure;  ///< the mesh could not be made

  const Figures* baseline() const;
};

/// Called when the figures of a mesh are there; the mesh is handed on as well.
using OnGroup = std::function<void(const SolveGroup&)>;

std::vector<SolveGroup> measure_solves(const SolvePlan& plan, const Say& say,
                                       const OnGroup& on_group);

/// How times grow with the number of vertices: time ~ vertices^exponent.
struct Exponents {
  double setup = kNotMeasured;
  double query = kNotMeasured;
};

struct Growth {
  std::string name;
  Exponents all, regular, irregular;  ///< over all meshes, and over those of one kind
};

/// Slopes of log time over log vertices (least squares), with an offset of its own for each kind of
/// mesh, so that a shape's own pace is no growth. One row for each contender that was measured on
/// two sizes of one kind. What cannot be said is not a number.
std::vector<Growth> measure_growth(const std::vector<SolveGroup>& groups);

/// One view of the gargoyle at 1280x720, or the replacement of its distances ("update"). Times are
/// the least of several frames in memory, the views taking turns.
struct RenderRow {
  std::string view;
  Index triangles = 0;
  int samples = 0;
  double frame_ms = kNotMeasured;
  double form_ms = kNotMeasured;  ///< the same view shaded by its form
  double fill_ms = kNotMeasured;  ///< the same mesh as a bare shaded fill

  double ratio() const { return frame_ms / fill_ms; }
  double form_ratio() const { return form_ms / frame_ms; }
};

struct RenderBench {
  std::string device;  ///< what drew
  double peak_mb = 0;  ///< device memory of the largest mesh at 4 samples, 2^20 bytes
  std::vector<RenderRow> rows;
  std::string failure;  ///< why there are no more rows; empty: all there
};

/// Every view at 69k, 262k and 1.1M triangles, one and four samples a pixel.
RenderBench measure_render(const Say& say);

/// What the viewer does while somebody's hand is on the mouse, at 1280x800 in memory and without
/// the panels. Medians, but for the longest frame of three switches.
struct ExploreRow {
  std::string mesh;
  Index faces = 0;
  // A source is dragged: from one picture with new distances to the next, and what it consists of.
  double drag_ms = kNotMeasured;
  double query_ms = kNotMeasured, upload_ms = kNotMeasured, frame_ms = kNotMeasured;
  // A stroke goes on: pictures with new distances a second, and the set-up on what was moved.
  double stroke_pictures = kNotMeasured, stroke_setup_ms = kNotMeasured;
  // t is switched: the longest frame while the worker factors, and that time.
  double switch_ms = kNotMeasured;
  double longest_frame_ms = kNotMeasured, usual_frame_ms = kNotMeasured;

  double drag_ratio() const { return drag_ms / (query_ms + upload_ms + frame_ms); }
  double turn_pictures = kNotMeasured;  ///< a second, while the model turns
  double full_frame_ms = kNotMeasured;  ///< the first one at rest
  double hover_ms = kNotMeasured;       ///< a frame at rest in which panels alone change
  double frame_ratio() const { return longest_frame_ms / usual_frame_ms; }
};

struct ExploreBench {
  std::vector<ExploreRow> rows;
  std::string failure;  ///< why there are no more rows; empty: all there
};

/// The gargoyle at 69k and 200k triangles.
ExploreBench measure_explore(const Say& say);

}  // namespace geotherm::bench
