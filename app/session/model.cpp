// SPDX-License-Identifier: MIT
#include "app/session/model.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <utility>
#include <vector>

#include "app/session/progress.h"
#include "app/session/wording.h"
#include "app/text/text.h"
#include "geotherm/domains.h"
#include "geotherm/io.h"
#include "geotherm/mesh.h"
#include "solver/core/stopwatch.h"
#include "solver/core/text.h"

namespace geotherm::app {

Result<std::string> parse_format(const std::string& text) {
  if (text.empty() || text == "auto") return std::string();
  const auto known = check_model_format(text);
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
  auto model = read_model(text, reading, progress);
  if (!model) {
    Error error = model.error();
    if (error.code == ErrorCode::kCancelled) return error;
    const bool memory = error.code == ErrorCode::kOutOfMemory;
    const bool there = std::filesystem::exists(path, unknown);
    if (!memory && !is_about_setting(error)) error.code = ErrorCode::kBadFile;
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
  if (!model) return model;
  model->path.clear();
  if (std::error_code unknown; std::filesystem::is_regular_file(name, unknown)) {
    model->notes.push_back({"the bundled model " + name + " was taken, not the file of this name",
                            {"write ./" + name + " for the file"}});
  }
  return model;
}

Result<Model> from_standard_input(const ModelReading& reading, const Progress& progress) {
  if (!report(progress, "reading standard input", -1)) return cancelled_error();
  const Stopwatch watch;
  auto model = read_model(std::string(kStandardInput), reading, progress);
  if (!model) {
    return with_hint(model.error(), {"check what writes it, and that it is " +
                                     (reading.format.empty() ? "a model" : reading.format)});
  }
  model->load_ms = watch.milliseconds();
  return model;
}

/// Applies a mask to a model that was read.
Result<void> leave_out(const std::string& text, Model& model) {
  if (auto surface = refuse_space(model, "masks are"); !surface) return surface;
  const auto mask = read_mask(text, *model.mesh);
  if (!mask) return mask.error();
  auto left = masked(*model.mesh, *mask);
  if (!left) return about(one_line(text), left.error());
  Index faces = 0;
  for (const Face& face : left->faces()) faces += face[0] == face[1] && face[1] == face[2] ? 1 : 0;
  const auto vertices = std::ranges::count_if(mask->vertices, [](char out) { return out != 0; });
  model.notes.push_back({"the mask leaves out " + counted(vertices, "vertex", "vertices") +
                         " and " + counted(faces, "face", "faces")});
  model.mesh = std::make_shared<const TriangleMesh>(*std::move(left));
  return {};
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
  if (model && !reading.mask.empty()) {
    if (auto done = leave_out(reading.mask, *model); !done) return done.error();
  }
  if (!model || !reading.weld) return model;
  if (!report(progress, "welding", -1)) return cancelled_error();
  if (auto done = weld_model(*reading.weld, *model); !done) {
    return about(one_line(text), done.error());
  }
  return model;
}

Result<void> weld_model(double distance, Model& model) {
  if (auto surface = refuse_space(model, "welded vertices are"); !surface) return surface;
  auto welded = weld(*model.mesh, distance);
  if (!welded) return welded.error();
  model.notes.push_back({weld_note(welded->merged, distance)});
  model.mesh = std::make_shared<const TriangleMesh>(std::move(welded->mesh));
  return {};
}

namespace {

constexpr BundledModel kModels[] = {
    {"terrain", 33'000, "mountains cut by rivers, a height field with an open boundary",
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

std::span<const std::string_view> model_extensions() {
  static const std::vector<std::string> kAll = [] {
    std::vector<std::string> all = model_formats();
    all.emplace_back("gz");
    for (std::string& name : all) name.insert(0, ".");
    return all;
  }();
  static const std::vector<std::string_view> kViews(kAll.begin(), kAll.end());
  return kViews;
}

std::string model_extensions_text() {
  const auto listed = [](const std::vector<std::string>& names) {
    return "." + joined(names, " .");
  };
  return listed(mesh_formats()) + "; points: " + listed(point_formats()) +
         "; tets: " + listed(tet_formats()) + "; grids: " + listed(grid_formats()) +
         "; any of them packed, as .gz";
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
  const std::string drawn(words.drawn);
  Hint hint;
  if (drawn != "nothing") {
    hint = {"with ", SettingHint{"domain", {"triangles"}}, " its " + drawn + " is one"};
  }
  return Error{ErrorCode::kBadInput,
               std::string(what) + " of triangle meshes, and " + one_line(model.name) + " is a " +
                   words.body + " of " +
                   counted(model.space->cell_count(), words.cell, words.cells),
               std::move(hint)};
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
