// SPDX-License-Identifier: MIT
#include "app/load_model.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "app/cure.h"
#include "app/progress_bar.h"
#include "app/text.h"
#include "solver/core/stopwatch.h"
#include "solver/mesh/generate.h"
#include "solver/mesh/read_mesh.h"

namespace geotherm::app {
namespace {

Result<Model> generated(const std::string& name, const Progress& progress) {
  const Stopwatch watch;
  auto mesh = generate_model(name, 0, with_prefix(progress, "making " + name + ": "));
  if (!mesh) return mesh.error();
  return Model{
      name, "", std::make_shared<const TriangleMesh>(*std::move(mesh)), watch.milliseconds(), {}};
}

void note_polygons_and_welding(const MeshFile& file, std::vector<std::string>& notes) {
  if (file.polygons > 0) {
    notes.push_back(counted(file.polygons, "polygon was", "polygons were") + " triangulated");
  }
  if (file.welded > 0) {
    notes.push_back("the file shares no vertices between faces: " +
                    counted(file.welded, "equal corner was", "equal corners were") +
                    " welded, and vertices are numbered by first appearance");
  }
}

}  // namespace

bool is_bundled(std::string_view name) {
  const auto models = bundled_models();
  return std::any_of(models.begin(), models.end(),
                     [name](const BundledModel& model) { return model.name == name; });
}

Result<Model> load_model(const std::string& text, const Progress& progress) {
  if (is_bundled(text)) return generated(text, progress);
  const std::filesystem::path path(text);
  std::error_code unknown;
  if (!path.has_extension() && !std::filesystem::exists(path, unknown)) {
    std::vector<std::string_view> names;
    for (const BundledModel& model : bundled_models()) names.push_back(model.name);
    return Error{ErrorCode::kBadFile, "'" + one_line(text) +
                                          "' is neither a file nor a bundled model; bundled are " +
                                          joined(names)};
  }
  if (!report(progress, "reading " + path.filename().string(), -1)) {
    return Error{ErrorCode::kCancelled, "the work was cancelled"};
  }
  const Stopwatch watch;
  auto file = read_mesh(text);
  if (!file) {
    const bool memory = file.error().code == ErrorCode::kOutOfMemory;
    const bool there = std::filesystem::exists(path, unknown);
    return with_cure({memory ? ErrorCode::kOutOfMemory : ErrorCode::kBadFile, file.error().message},
                     one_line(text),
                     memory  ? "take a mesh with fewer faces"
                     : there ? "choose another file, or export this one again"
                             : "check the path");
  }
  Model model{path.stem().string(), text, nullptr, watch.milliseconds(), {}};
  note_polygons_and_welding(*file, model.notes);
  model.notes.insert(model.notes.end(), file->notes.begin(), file->notes.end());
  model.mesh = std::make_shared<const TriangleMesh>(std::move(file->mesh));
  return model;
}

}  // namespace geotherm::app
