// SPDX-License-Identifier: MIT
#include <unistd.h>

#include <filesystem>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

#include "app/session/grid_space.h"
#include "app/session/model.h"
#include "app/session/wording.h"
#include "app/text/text.h"
#include "geotherm/domains.h"
#include "geotherm/io.h"

namespace geotherm::app {
namespace {

/// What reading had to do.
template <class File>
std::vector<Warning> notes_in(const File& file) {
  std::vector<Warning> notes;
  if constexpr (std::is_same_v<File, MeshFile>) {
    if (file.polygons > 0) {
      notes.push_back({counted(file.polygons, "polygon was", "polygons were") + " triangulated"});
    }
    if (file.welded > 0) {
      notes.push_back({"the file shares no vertices between faces: " +
                       counted(file.welded, "equal corner was", "equal corners were") +
                       " welded, and vertices are numbered by first appearance"});
    }
  }
  for (const std::string& note : file.notes) notes.push_back({note});
  return notes;
}

/// What a file holds, as far as its beginning tells: where it has elements these may be faces.
ModelDomain find_domain(const ModelInput& input) {
  if (holds_tets(input)) return ModelDomain::kTets;
  if (holds_grid(input)) return ModelDomain::kGrid;
  const auto points = is_point_file(input);
  return points && *points ? ModelDomain::kPoints : ModelDomain::kTriangles;
}

/// The options that only files of some domains have.
Result<void> check_reading(const ModelReading& reading, ModelDomain domain, ModelDomain holds) {
  if (reading.grid != GridValues::kAuto && domain != ModelDomain::kGrid &&
      holds != ModelDomain::kGrid) {
    return Error{
        ErrorCode::kBadInput,
        "what values mean is asked of grids, and the model is read as " + geotherm::to_text(domain),
        {"leave ", SettingHint{"grid"}, " out"}};
  }
  return {};
}

/// Where neither path nor bytes say what it is.
Error unknown_format(const std::string& message, bool extension) {
  const auto names = [](const std::vector<std::string>& formats) { return joined(formats, " "); };
  const std::string known = names(mesh_formats()) + ", for points " + names(point_formats()) +
                            ", for tets " + names(tet_formats()) + ", for grids " +
                            names(grid_formats());
  if (extension) return {ErrorCode::kNotAvailable, message, {"there are " + known}};
  return {ErrorCode::kNotAvailable,
          message,
          {"say its format with ", SettingHint{"format"}, ": there are " + known}};
}

/// "bunny" of "a/bunny.ply.gz".
std::string name_of(const std::string& path) {
  if (path == kStandardInput) return "standard input";
  const std::filesystem::path file(path);
  return (file.extension() == ".gz" ? file.stem() : file).stem().string();
}

}  // namespace

Model model_of(TriangleMesh mesh) {
  Model model;
  model.mesh = std::make_shared<const TriangleMesh>(std::move(mesh));
  return model;
}

Model model_of(const std::shared_ptr<const CellSpace>& space) {
  Model model;
  model.mesh = space->drawn();
  model.space = space;
  return model;
}

Result<Model> model_of(const PolygonMesh& mesh) {
  const auto space = PolygonSpace::build(mesh);
  if (!space) return space.error();
  return model_of(*space);
}

/// The border of a volume has all its vertices, so that their numbers stay.
Result<Model> model_of(TetMesh volume) {
  auto space = TetSpace::build(std::move(volume));
  if (!space) return space.error();
  if ((*space)->border().faces.empty()) {
    return Error{
        ErrorCode::kBadInput,
        "the volume of " + counted((*space)->cell_count(), "tet", "tets") + " has no border",
        {"give tets whose outer faces belong to one tet each"}};
  }
  const auto positions = (*space)->tets()->positions();
  auto mesh = TriangleMesh::build({positions.begin(), positions.end()}, (*space)->border().faces);
  if (!mesh) return mesh.error();
  Model model = model_of(*std::move(mesh));
  model.space = *std::move(space);
  return model;
}

Result<Model> model_of(GridFile grid) try {
  auto space = std::make_shared<const GridSpace>(std::move(grid));
  auto mesh = space->drawn();
  if (!mesh) return mesh.error();
  Model model = model_of(*std::move(mesh));
  model.space = std::move(space);
  return model;
} catch (const std::bad_alloc&) {
  return Error{ErrorCode::kOutOfMemory, "the memory ended while cells were made of a grid"};
}

Result<Model> model_of(const PointCloud& points, const Progress& progress) {
  auto surface = surface_of(points, {}, progress);
  if (!surface) return surface.error();
  Model model = model_of(std::move(surface->mesh));
  for (std::string& note : surface->notes) model.notes.push_back({std::move(note)});
  for (Warning& warning : surface->warnings) model.notes.push_back(std::move(warning));
  model.from_points = true;
  return model;
}

Result<Model> read_model(const std::string& path, const ModelReading& reading,
                         const Progress& progress) {
  const std::string name = name_of(path);
  const auto input = path == kStandardInput ? ModelInput::stream(STDIN_FILENO, name, reading.format)
                                            : ModelInput::open(path, reading.format);
  if (!input) return input.error();
  const ModelDomain holds = find_domain(*input);
  const ModelDomain domain = reading.domain == ModelDomain::kAuto ? holds : reading.domain;
  if (auto fits = check_reading(reading, domain, holds); !fits) return fits.error();
  const auto with = [&](auto file, auto make) -> Result<Model> {
    if (!file) return file.error();
    const std::vector<Warning> notes = notes_in(*file);
    Result<Model> model = make(*std::move(file));
    if (!model) return about(one_line(path), model.error());
    model->name = name;
    model->path = path;
    model->notes.insert(model->notes.begin(), notes.begin(), notes.end());
    return model;
  };
  const auto surface = [](MeshFile file) {
    Model model = model_of(std::move(file.mesh));
    constexpr UpAxis kAxes[] = {UpAxis::kX, UpAxis::kY, UpAxis::kZ};
    if (file.up_axis) model.up = kAxes[*file.up_axis];
    return model;
  };
  const auto space = [](auto file) { return model_of(std::move(file.mesh)); };
  const auto grid = [](GridFile file) { return model_of(std::move(file)); };
  const auto read_held = [&]() -> Result<Model> {
    if (holds == ModelDomain::kGrid) return with(read_grid(*input, reading.grid), grid);
    auto tets = read_tets(*input);
    const bool is_surface = !tets && tets.error().code == ErrorCode::kNotAvailable;
    return is_surface ? with(read_mesh(*input), surface) : with(std::move(tets), space);
  };
  switch (domain) {
    case ModelDomain::kTets:
      return reading.domain == ModelDomain::kAuto ? read_held() : with(read_tets(*input), space);
    case ModelDomain::kGrid:
      return with(read_grid(*input, reading.grid), grid);
    case ModelDomain::kPoints:
      return with(read_points(*input),
                  [&](const PointFile& file) { return model_of(file.points, progress); });
    case ModelDomain::kPolygons:
      return with(read_polygons(*input), space);
    case ModelDomain::kAuto:
    case ModelDomain::kTriangles:
      break;
  }
  if (holds == ModelDomain::kTets || holds == ModelDomain::kGrid) {
    auto model = read_held();
    if (model) model->space = nullptr;  // what is drawn of it is the surface
    return model;
  }
  auto file = read_mesh(*input);
  if (file || file.error().code != ErrorCode::kNotAvailable) return with(std::move(file), surface);
  return unknown_format(file.error().message, !input->format().empty());
}

}  // namespace geotherm::app
