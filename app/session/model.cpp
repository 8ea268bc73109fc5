// SPDX-License-Identifier: MIT
#include "app/session/model.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <new>
#include <system_error>
#include <utility>
#include <vector>

#include "app/session/grid_space.h"
#include "app/session/progress.h"
#include "app/session/wording.h"
#include "app/text/text.h"
#include "geotherm/io.h"
#include "geotherm/mesh.h"
#include "solver/core/stopwatch.h"
#include "solver/core/text.h"

namespace geotherm::app {

Result<std::string> parse_format(const std::string& text) {
  if (text.empty() || text == "auto") return std::string();
  const auto known = check_mesh_format(text);
  if (!known) return known.error();
  return text;
}

Result<std::optional<double>> parse_weld(const std::string& text) {
  if (text.empty() || text == "off") return std::optional<double>();
  const auto distance = number_in<double>(text);
  if (distance && *distance >= 0 && std::isfinite(*distance)) return std::optional(*distance);
  return bad_value(text, "is no distance",
                   "give a length in model units, or 0 for vertices that are equal");
}

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

Model model_of(MeshFile file, std::string name, const std::string& path, double load_ms) {
  Model model{std::move(name), path, nullptr, load_ms, {}};
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

Result<Model> model_of_polygons(const std::string& path, const std::string& format,
                                std::string name) {
  std::vector<std::string> notes;
  auto polygons = read_polygons(path, format, &notes);
  if (!polygons) return polygons.error();
  auto space = PolygonSpace::build(*std::move(polygons));
  if (!space) return about(one_line(path), space.error());
  Model model{std::move(name), path, (*space)->triangles(), 0, {}};
  for (std::string& note : notes) model.notes.push_back({std::move(note)});
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

/// What a file holds.
ModelDomain find_domain(const std::string& path, const ModelReading& reading) {
  if (!reading.format.empty()) return ModelDomain::kTriangles;
  if (holds_tets(path)) return ModelDomain::kTets;
  if (holds_grid(path)) return ModelDomain::kGrid;
  const auto points = is_point_file(path);
  return points && *points ? ModelDomain::kPoints : ModelDomain::kTriangles;
}

/// The options that only files of some domains have.
Result<void> check_reading(const ModelReading& reading, ModelDomain domain, ModelDomain holds) {
  const auto refused = [&](const char* option, const std::string& is_of) {
    return Error{ErrorCode::kBadInput,
                 is_of + ", and the model is read as " + to_text(domain),
                 {"leave ", SettingHint{option}, " out"}};
  };
  const bool of_faces = domain == ModelDomain::kTriangles || domain == ModelDomain::kPolygons;
  if (!reading.format.empty() && !of_faces) {
    return refused("format", "the format " + reading.format + " is of faces");
  }
  if (reading.grid != GridValues::kAuto && domain != ModelDomain::kGrid &&
      holds != ModelDomain::kGrid) {
    return refused("grid", "what values mean is asked of grids");
  }
  return {};
}

/// The model of a file by what it holds, or is taken for.
Result<Model> read_model(const std::string& path, const std::string& name,
                         const ModelReading& reading, const Progress& progress) {
  const ModelDomain holds = find_domain(path, reading);
  const ModelDomain domain = reading.domain == ModelDomain::kAuto ? holds : reading.domain;
  if (auto fits = check_reading(reading, domain, holds); !fits) return fits.error();
  const auto with = [&](auto file, auto make) -> Result<Model> {
    if (!file) return file.error();
    Result<Model> model = make(*std::move(file), name, path);
    if (!model) return about(one_line(path), model.error());
    return model;
  };
  switch (domain) {
    case ModelDomain::kTets:
      return with(read_tets(path), model_of_volume);
    case ModelDomain::kGrid:
      return with(read_grid(path, reading.grid), model_of_grid);
    case ModelDomain::kPoints:
      return with(read_points(path),
                  [&progress](PointFile file, const std::string& stem, const std::string& of) {
                    return model_of_points(std::move(file), stem, of, progress);
                  });
    case ModelDomain::kPolygons:
      return model_of_polygons(path, reading.format, name);
    case ModelDomain::kAuto:
    case ModelDomain::kTriangles:
      break;
  }
  if (holds == ModelDomain::kTets || holds == ModelDomain::kGrid) {
    auto model = holds == ModelDomain::kTets ? with(read_tets(path), model_of_volume)
                                             : with(read_grid(path, reading.grid), model_of_grid);
    if (model) model->space = nullptr;  // what is drawn of it is the surface
    return model;
  }
  auto file = reading.format.empty() ? read_mesh(path) : read_mesh(path, reading.format);
  if (file) return model_of(*std::move(file), name, path, 0);
  if (file.error().code != ErrorCode::kNotAvailable || !reading.format.empty()) return file.error();
  // One of tets after all, or the reader of these says what else it holds.
  auto tets = read_tets(path);
  if (tets || tets.error().code != ErrorCode::kNotAvailable) {
    return with(std::move(tets), model_of_volume);
  }
  return Error{
      ErrorCode::kNotAvailable,
      file.error().message,
      {"there are " + joined(mesh_formats(), " ") + ", for points " + joined(point_formats(), " ") +
       ", for tets " + joined(tet_formats(), " ") + ", for grids " + joined(grid_formats(), " ")}};
}

Result<Model> from_file(const std::string& text, const ModelReading& reading,
                        const Progress& progress) {
  const std::filesystem::path path(text);
  std::error_code unknown;
  if (!path.has_extension() && !std::filesystem::exists(path, unknown)) {
    std::vector<std::string> names;
    for (const BundledModel& model : bundled_models()) names.emplace_back(model.name);
    const std::string near = nearest_word(text, names);
    return Error{
        ErrorCode::kBadFile,
        "'" + one_line(text) + "' is neither a file nor a bundled model",
        {(near.empty() ? "" : "did you mean " + near + "? ") + ("bundled are " + joined(names))}};
  }
  if (!report(progress, "reading " + path.filename().string(), -1)) return cancelled_error();
  const Stopwatch watch;
  auto model = read_model(text, path.stem().string(), reading, progress);
  if (!model) {
    Error error = model.error();
    if (error.code == ErrorCode::kCancelled) return error;
    const bool memory = error.code == ErrorCode::kOutOfMemory;
    const bool there = std::filesystem::exists(path, unknown);
    if (!memory) error.code = ErrorCode::kBadFile;
    return with_hint(std::move(error), {memory  ? "take a mesh with fewer faces"
                                        : there ? "choose another file, or export this one again"
                                                : "check the path"});
  }
  model->load_ms = watch.milliseconds();
  return model;
}

Result<Model> bundled(const std::string& name, const ModelReading& reading,
                      const Progress& progress) {
  if (!reading.format.empty()) {
    return Error{ErrorCode::kBadInput,
                 name + " is a bundled model and no file",
                 {"leave ", SettingHint{"format"}, " out"}};
  }
  const auto file = bundled_file(name);
  if (!file) return file.error();
  auto model = from_file(*file, reading, progress);
  if (model) model->path.clear();
  return model;
}

Result<Model> from_standard_input(const ModelReading& reading, const Progress& progress) {
  const std::string name = "standard input";
  if (auto fits = check_reading(reading, ModelDomain::kTriangles, ModelDomain::kTriangles); !fits)
    return fits.error();
  if (reading.domain != ModelDomain::kAuto && reading.domain != ModelDomain::kTriangles) {
    return Error{ErrorCode::kBadInput,
                 "standard input holds triangles alone",
                 {"leave ", SettingHint{"domain"}, " out"}};
  }
  if (reading.format.empty()) {
    return Error{ErrorCode::kBadInput,
                 "the model - is standard input, which has no extension",
                 {"add ", SettingHint{"format"}, " with obj, ply, off or stl"}};
  }
  if (reading.domain != ModelDomain::kAuto && reading.domain != ModelDomain::kTriangles) {
    return Error{ErrorCode::kBadInput,
                 "standard input is read as triangles, not as " + geotherm::to_text(reading.domain),
                 {"write it to a file"}};
  }
  if (!report(progress, "reading " + name, -1)) return cancelled_error();
  const Stopwatch watch;
  auto file = read_mesh(STDIN_FILENO, reading.format, name);
  if (!file) {
    return with_hint(file.error(), {"check what writes it, and that it is " + reading.format});
  }
  return model_of(*std::move(file), name, std::string(kStandardInput), watch.milliseconds());
}

std::string weld_note(Index merged, double distance) {
  const std::string where = distance > 0 ? "within " + significant(distance) + " of another"
                                         : "exactly where another one is";
  if (merged == 0) return "no vertex lies " + where + ": none was merged";
  return counted(merged, "vertex", "vertices") + " " + where +
         (merged == 1 ? " was merged with it" : " were merged with them") +
         "; merged vertices share a distance";
}

}  // namespace

Result<Model> load_model(const std::string& text, const ModelReading& reading,
                         const Progress& progress) {
  auto model = text == kStandardInput ? from_standard_input(reading, progress)
               : is_bundled(text)     ? bundled(text, reading, progress)
                                      : from_file(text, reading, progress);
  if (!model || !reading.weld) return model;
  if (auto surface = refuse_space(*model, "welded vertices are"); !surface) {
    return surface.error();
  }
  if (!report(progress, "welding", -1)) return cancelled_error();
  auto welded = weld(*model->mesh, *reading.weld);
  if (!welded) return welded.error();
  model->notes.push_back({weld_note(welded->merged, *reading.weld)});
  model->mesh = std::make_shared<const TriangleMesh>(std::move(welded->mesh));
  return model;
}

namespace {

constexpr BundledModel kModels[] = {
    {"terrain", 33'000, "mountains cut by rivers, a height field with an open border",
     "a landscape with one boundary"},
    {"sleeve", 37'000, "a bent garment sleeve with folds, open at the shoulder and the cuff",
     "a tube with two boundaries"},
    {"cube", 30'000, "a cube with exact edges and corners", "with exact edges"},
    {"gargoyle", 200'000, "a horned, winged creature that crouches on a plinth", "200,000 faces"},
    {"bunny", 4'000, "a sitting rabbit", "4,000 faces"},
};

/// Where files of models are looked for, in this order.
std::vector<std::filesystem::path> folders() {
  const char* const chosen = std::getenv("GEOTHERM_MODELS");
  if (chosen && *chosen) return {chosen};
  std::vector<std::filesystem::path> found;
  std::error_code unknown;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", unknown);
  if (!unknown) {
    found.push_back((program.parent_path() / GEOTHERM_INSTALLED_MODELS).lexically_normal());
  }
  found.emplace_back(GEOTHERM_SOURCE_MODELS);
  return found;
}

}  // namespace

std::string_view domain_name(const Model& model) {
  return model.space ? model.space->words().domain : model.from_points ? "points" : "triangles";
}

std::string size_in_words(const Model& model) {
  if (model.space) {
    const SpaceWords& words = model.space->words();
    return counted(model.space->cell_count(), words.cell, words.cells);
  }
  if (model.from_points) return counted(model.mesh->vertex_count(), "point", "points");
  return counted(model.mesh->face_count(), "face", "faces");
}

std::optional<std::array<double, 2>> head_on(const Model& model) {
  if (!model.space) return std::nullopt;
  const std::array<Index, 3> size = model.space->size();  // zeros where it is no grid
  if (std::ranges::count(size, 1) != 1) return std::nullopt;
  constexpr std::array<std::array<double, 2>, 3> kAlong = {{{90, 0}, {0, 90}, {0, 0}}};
  return kAlong[static_cast<std::size_t>(std::ranges::find(size, 1) - size.begin())];
}

std::vector<Vec3> places_in_cells(const Model& model, const SourceSet& sources) {
  std::vector<Vec3> out;
  for (const CellPoint& point : sources.cell_points) {
    const std::vector<Index> corners = model.space->corners_of(point.cell);
    Vec3& place = out.emplace_back(Vec3::Zero());
    for (std::size_t k = 0; k < corners.size(); ++k) {
      place += point.weights[k] * model.mesh->positions()[corners[k]];
    }
  }
  return out;
}

std::shared_ptr<const TetMesh> tets_of(const Model& model) {
  return model.space ? model.space->tets() : nullptr;
}

Result<void> refuse_space(const Model& model, std::string_view what) {
  if (!model.space) return {};
  const SpaceWords& words = model.space->words();
  return Error{ErrorCode::kBadInput,
               std::string(what) + " of triangle meshes, and " + one_line(model.name) + " is a " +
                   words.body + " of " +
                   counted(model.space->cell_count(), words.cell, words.cells),
               {"with ", SettingHint{"domain", {"triangles"}},
                " its " + std::string(words.drawn) + " is one"}};
}

std::span<const BundledModel> bundled_models() { return kModels; }

bool is_bundled(std::string_view name) {
  return std::ranges::find(kModels, name, &BundledModel::name) != std::end(kModels);
}

Result<std::string> bundled_file(std::string_view name) {
  const std::string file = std::string(name) + ".ply";
  std::vector<std::string> tried;
  for (const std::filesystem::path& folder : folders()) {
    std::error_code unknown;
    if (std::filesystem::exists(folder / file, unknown)) return (folder / file).string();
    tried.push_back(one_line(folder.string()));
  }
  return Error{ErrorCode::kBadFile,
               "the bundled model " + std::string(name) + " has no file " + file + " in " +
                   joined(tried, " or "),
               {"install geotherm again, or set GEOTHERM_MODELS to the folder that holds it"}};
}

}  // namespace geotherm::app
