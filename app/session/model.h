// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/picture/picture_settings.h"
#include "app/session/space.h"
#include "geotherm/error.h"
#include "geotherm/mesh.h"
#include "geotherm/names.h"
#include "geotherm/progress.h"
#include "geotherm/types.h"

// How a model is read, beside its name.
namespace geotherm::app {

/// What a file is taken for, and distance computed in.
enum class ModelDomain {
  kAuto,       ///< what the file holds: tets, a grid, points without faces, else triangles
  kTriangles,  ///< polygons are triangulated; of tets and grids what is drawn of them is taken
  kPolygons,   ///< faces as they are
  kPoints,     ///< faces are left out
  kTets,
  kGrid,
};
inline NamedValues<ModelDomain> named_values(ModelDomain) {
  using enum ModelDomain;
  return {"'*' is no domain",
          {{kAuto, "auto"},
           {kTriangles, "triangles"},
           {kPolygons, "polygons"},
           {kPoints, "points"},
           {kTets, "tets"},
           {kGrid, "grid"}}};
}

struct ModelReading {
  ModelDomain domain = ModelDomain::kAuto;
  std::string format;          ///< one of model_formats(); empty: what name or bytes say
  std::optional<double> weld;  ///< vertices this near are one, model units; none: as in the file
  GridValues grid = GridValues::kAuto;
  std::string mask;  ///< what leaves vertices or faces out, as read_mask() takes it; empty: nothing

  bool operator==(const ModelReading&) const = default;
};

/// The name that is standard input.
inline constexpr std::string_view kStandardInput = "-";

/// "auto", and empty, are the extension's.
Result<std::string> parse_format(const std::string& text);
/// "off", and empty, are none.
Result<std::optional<double>> parse_weld(const std::string& text);

struct Model {
  std::string name;  ///< the file's name without folder and extension, or the bundled name
  std::string path;  ///< empty for a bundled model, - for standard input
  /// What is drawn, and where points are picked. Of a volume its border, of a grid its squares or
  /// the outsides of its cubes, of a point cloud the triangles between the points; either way all
  /// vertices of the file are among its vertices.
  std::shared_ptr<const TriangleMesh> mesh;
  double load_ms = 0;          ///< reading
  std::vector<Warning> notes;  ///< what reading had to do, one sentence each
  /// What distance is computed in, where that is not `mesh` itself.
  std::shared_ptr<const Space> space = {};
  UpAxis up = UpAxis::kAuto;  ///< what the file says; kAuto: nothing
  bool from_points = false;   ///< `mesh` was made of points without faces

  /// Whether the file holds the faces of `mesh`.
  bool is_mesh() const { return !space && !from_points; }
};

/// The same model for work whose errors stand beside its name, or in its row.
inline Model unnamed(Model model) {
  model.name.clear();
  return model;
}

/// `text`: a bundled model's name, kStandardInput, else a path. Errors: kBadInput (a format or a
/// distance that does not go with the model), kBadFile, kOutOfMemory, kCancelled.
Result<Model> load_model(const std::string& text, const ModelReading& reading = {},
                         const Progress& progress = {});

/// Makes one of the vertices that are at most this far apart, and notes how many there were. Errors
/// (kBadInput): a model that is no triangle mesh, those of weld().
Result<void> weld_model(double distance, Model& model);

/// The model in a file, a pipe or standard input (kStandardInput) by what it holds, or is taken
/// for. It is opened once. Errors: those of load_model().
Result<Model> read_model(const std::string& path, const ModelReading& reading,
                         const Progress& progress);

// Models without a name. Errors: those of the space, and of what is drawn of it.
Model model_of(TriangleMesh mesh);
Model model_of(const std::shared_ptr<const CellSpace>& space);
Result<Model> model_of(const PolygonMesh& mesh);
Result<Model> model_of(TetMesh volume);
Result<Model> model_of(GridFile grid);
Result<Model> model_of(const PointCloud& points, const Progress& progress);

/// A model that comes with the program, as the file NAME.ply.
struct BundledModel {
  std::string_view name;
  Index faces;  ///< about
  std::string_view description;
  std::string_view feature;  ///< what menus say beside the name
};

/// "triangles", "points" or what its space is called: what a model's file holds.
std::string_view domain_name(const Model& model);

/// The extensions of all models, with their points, and ".gz" for those that are packed.
std::span<const std::string_view> model_extensions();

/// What help says of them: ".obj .ply ...; points: ...; tets: ...; grids: ...; any as .gz".
std::string model_extensions_text();

/// What it consists of: "4,000 faces", "2,500 tets", "800 points".
std::string size_in_words(const Model& model);

/// Whether its answers are travel times.
inline bool measures_time(const Model& model) {
  return model.space && model.space->measures_time();
}

/// From where a grid of one layer is seen head-on, azimuth and elevation in degrees; nothing for
/// other models.
std::optional<std::array<double, 2>> head_on(const Model& model);

/// Where the sources in cells of its space are, model units.
std::vector<Vec3> places_in_cells(const Model& model, const SourceSet& sources);

/// The tets that slices cut; null where there are none.
std::shared_ptr<const TetMesh> tets_of(const Model& model);

/// Refuses what is done on triangle meshes alone. `what`: "paths are". Errors: kBadInput, where the
/// model is another space.
Result<void> refuse_space(const Model& model, std::string_view what);

/// All of them: terrain, sleeve, cube, gargoyle, bunny.
std::span<const BundledModel> bundled_models();

bool is_bundled(std::string_view name);

/// The path of a bundled model's file: in the folder that the variable GEOTHERM_MODELS of the
/// environment names; without it, in the data folder of the installed program, else in the source
/// tree that the program was built from. Errors: kBadFile, with the folders that were looked in.
Result<std::string> bundled_file(std::string_view name);

}  // namespace geotherm::app
