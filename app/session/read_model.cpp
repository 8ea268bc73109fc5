// SPDX-License-Identifier: MIT
#include "app/session/read_model.h"

#include <unistd.h>

#include <filesystem>
#include <new>
#include <utility>
#include <vector>

#include "app/session/grid_space.h"
#include "app/session/wording.h"
#include "app/text/text.h"
#include "geotherm/domains.h"
#include "geotherm/io.h"

namespace geotherm::app {
namespace {

void note_polygons_and_welding(const MeshFile& file, std::vector<Warning>& notes) {
  if (file.polygons > 0) {
    notes.push_back({counted(file.polygons, "polygon was", "polygons were") + " triangulated"});
  }
  if (file.welded > 0) {
    notes.push_back({"the file shares no vertices between faces: " +
                     counted(file.welded, "equal corner was", "equal corners were") +
                     " welded, and vertices are numbered by first appearance"});
  }
}

Result<Model> model_of(MeshFile file, std::string name, const std::string& path) {
  Model model{std::move(name), path, nullptr, 0, {}};
  constexpr UpAxis kAxes[] = {UpAxis::kX, UpAxis::kY, UpAxis::kZ};
  if (file.up_axis) model.up = kAxes[*file.up_axis];
  note_polygons_and_welding(file, model.notes);
  for (std::string& note : file.notes) model.notes.push_back({std::move(note)});
  model.mesh = std::make_shared<const TriangleMesh>(std::move(file.mesh));
  return model;
}

/// The border of a volume has all its vertices, so that their numbers stay.
Result<Model> model_of_volume(TetFile file, std::string name, const std::string& path) {
  auto space = TetSpace::build(std::move(file.mesh));
  if (!space) return space.error();
  const auto positions = (*space)->tets()->positions();
  auto mesh = TriangleMesh::build({positions.begin(), positions.end()}, (*space)->border().faces);
  if (!mesh) return mesh.error();
  Model model{std::move(name), path, std::make_shared<const TriangleMesh>(*std::move(mesh)), 0, {}};
  for (std::string& note : file.notes) model.notes.push_back({std::move(note)});
  model.space = *std::move(space);
  return model;
}

Result<Model> model_of_polygons(const ModelInput& input, std::string name,
                                const std::string& path) {
  auto file = read_polygons(input);
  if (!file) return file.error();
  auto space = PolygonSpace::build(std::move(file->mesh));
  if (!space) return about(one_line(path), space.error());
  Model model{std::move(name), path, (*space)->drawn(), 0, {}};
  for (std::string& note : file->notes) model.notes.push_back({std::move(note)});
  model.space = *std::move(space);
  return model;
}

Result<Model> model_of_points(PointFile file, std::string name, const std::string& path,
                              const Progress& progress) {
  auto surface = surface_of(file.points, {}, progress);
  if (!surface) return surface.error();
  Model model{std::move(name), path, nullptr, 0, {}};
  for (auto* notes : {&file.notes, &surface->notes}) {
    for (std::string& note : *notes) model.notes.push_back({std::move(note)});
  }
  for (Warning& warning : surface->warnings) model.notes.push_back(std::move(warning));
  model.mesh = std::make_shared<const TriangleMesh>(std::move(surface->mesh));
  model.from_points = true;
  return model;
}

Result<Model> model_of_grid(GridFile file, std::string name, const std::string& path) try {
  Model model{std::move(name), path, nullptr, 0, {}};
  for (std::string& note : file.notes) model.notes.push_back({std::move(note)});
  auto space = std::make_shared<const GridSpace>(std::move(file));
  auto mesh = space->drawn();
  if (!mesh) return mesh.error();
  model.mesh = std::make_shared<const TriangleMesh>(*std::move(mesh));
  model.space = std::move(space);
  return model;
} catch (const std::bad_alloc&) {
  return Error{ErrorCode::kOutOfMemory, "the memory ended while cells were made of a grid"};
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
    Result<Model> model = make(*std::move(file), name, path);
    if (!model) return about(one_line(path), model.error());
    return model;
  };
  const auto read_held = [&]() -> Result<Model> {
    if (holds == ModelDomain::kGrid) return with(read_grid(*input, reading.grid), model_of_grid);
    auto tets = read_tets(*input);
    const bool surface = !tets && tets.error().code == ErrorCode::kNotAvailable;
    return surface ? with(read_mesh(*input), model_of) : with(std::move(tets), model_of_volume);
  };
  switch (domain) {
    case ModelDomain::kTets:
      return reading.domain == ModelDomain::kAuto ? read_held()
                                                  : with(read_tets(*input), model_of_volume);
    case ModelDomain::kGrid:
      return with(read_grid(*input, reading.grid), model_of_grid);
    case ModelDomain::kPoints:
      return with(read_points(*input),
                  [&progress](PointFile file, const std::string& stem, const std::string& of) {
                    return model_of_points(std::move(file), stem, of, progress);
                  });
    case ModelDomain::kPolygons:
      return model_of_polygons(*input, name, path);
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
  if (file || file.error().code != ErrorCode::kNotAvailable) return with(std::move(file), model_of);
  return unknown_format(file.error().message, !input->format().empty());
}

}  // namespace geotherm::app
