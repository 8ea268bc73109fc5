// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/picture/picture_data.h"
#include "app/picture/picture_settings.h"
#include "app/picture/target_paths.h"
#include "app/session/answer.h"
#include "app/session/model.h"
#include "app/session/source_centre.h"
#include "app/session/state.h"
#include "app/session/vertex_field.h"
#include "geotherm/heat_method.h"
#include "solver/mesh/ray_tree.h"

// What the session has worked out; immutable, shared by threads.
namespace geotherm::app {

/// A model made ready for exploring.
struct ExploredModel {
  Model model;
  std::optional<MeshReport> mesh;           ///< none: it is not described yet, nor are the next two
  std::vector<Warning> warnings;            ///< about file and mesh, one sentence each
  std::vector<SpaceFigure> figures;         ///< of a space
  std::shared_ptr<const PictureData> base;  ///< without a solve
  std::shared_ptr<const RayTree> rays;      ///< null: not made yet
  int frames = 0;                           ///< of the sequence; 0: there is none
};

/// A place on the model under one entry of the list of sources.
struct SourcePlace {
  int entry = 0;                 ///< of ViewerState::sources
  SurfacePoint point;            ///< none of a point inside a tet
  Vec3 position = Vec3::Zero();  ///< model units
  bool alone = false;            ///< the entry is this point and nothing else
};

/// What is shown: answers and the sources and settings they belong to.
struct Explored {
  std::shared_ptr<const ExploredModel> model;  ///< null: none is open
  std::vector<SourceSpec> sources;             ///< as in ViewerState
  SourceSet set;
  std::vector<SourcePlace> places;
  std::shared_ptr<const Answer> a, b;  ///< null: no source, or nothing kept
  /// d_A - d_B where both are.
  struct Difference {
    std::vector<double> values;  ///< V; infinite where either is
    double most = 0, mean = 0;   ///< of |d_A - d_B|, model units
    double largest = 0;          ///< distance of A
  };
  std::shared_ptr<const Difference> difference;
  std::shared_ptr<const VertexField> field;    ///< shown in place of answers; null: none
  std::vector<TargetPath> paths;               ///< to ViewerState::target
  std::shared_ptr<const SourceCentre> centre;  ///< of the sources; null: none is wanted, or not yet
  std::optional<Warning> centre_failure;       ///< why there is none although one is wanted
  std::optional<Warning> path_failure;         ///< why there are none although there is a target
  std::optional<Error> b_failure;              ///< why there is no B although settings are kept
  bool shown = false;  ///< true if these answers were before, without light, errors and centre
  std::uint64_t version = 0;  ///< incremented with every change
};

/// The t that a time step means on a mesh, model units squared. Preconditions: it has one component
/// (of several each has its own), and its grading is 1.
double time_on_mesh(const TimeStep& step, const MeshReport& mesh);

/// The same in a space, whose edges a method alone has measured: by the mean edge and the mean cell
/// of `heat`. None where that is null or does not tell.
std::optional<double> time_in_space(const TimeStep& step, const HeatMethod* heat);

/// A or B (for the difference: A); null while there is none.
const Answer* shown_answer(const Explored& explored, Shown shown);

/// Figures of a point of the surface.
struct PointFigures {
  SurfacePoint point;
  Index nearest_vertex = kNoIndex;
  Vec3 position = Vec3::Zero();
  /// Interpolated, and at most the straight line to a source of the same face; infinite: not
  /// reached.
  std::optional<double> distance;
  std::optional<double> heat;  ///< u where the answer holds it
  std::optional<double> difference;
};
/// Precondition: the point lies on the model.
PointFigures figures_at(const Explored& explored, Shown shown, const SurfacePoint& point);

/// The number that the picture shows there: the distance of A or B, or their difference.
std::optional<double> value_shown(const PointFigures& figures, Shown shown);

/// set_face_values() of a model: those of its cells where it is a space.
void set_view_values(PictureData& data, const Model& model, View view,
                     const DistanceResult* answer);

/// Sets everything of a picture but the mesh: values, sources, fields, caption. `data` holds the
/// model's base or has been set before.
void set_explored(PictureData& data, const Explored& explored, Shown shown, View view);

/// The whole picture. Precondition: a model is open.
PictureData picture_of(const Explored& explored, Shown shown, View view);

}  // namespace geotherm::app
