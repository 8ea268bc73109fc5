// SPDX-License-Identifier: MIT
// Options, what the build has, and models.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>

#include "app/c/handles.h"
#include "app/session/length_space.h"
#include "app/session/model.h"
#include "app/session/settings.h"
#include "app/text/text.h"
#include "geotherm/accuracy.h"
#include "geotherm/backend.h"
#include "geotherm/domains.h"
#include "geotherm/io.h"

namespace geotherm::c {
namespace {

using app::Model;
using app::Setting;
using app::SettingGroup;

bool is_option(const Setting& setting) { return !setting.of_picture(); }

Result<const Setting*> find_option(const char* name) {
  const Setting* const setting = app::find_setting(name);
  if (setting != nullptr && is_option(*setting)) return setting;
  std::vector<std::string> names;
  for (const Setting& each : app::settings()) {
    if (is_option(each)) names.emplace_back(each.name);
  }
  return unknown_name(ErrorCode::kNotAvailable, "there is no option '*'", name, names);
}

std::string_view group_name(SettingGroup group) {
  switch (group) {
    case SettingGroup::kModel:
      return "model";
    case SettingGroup::kMethod:
      return "method";
    case SettingGroup::kCheck:
      return "check";
    case SettingGroup::kPicture:
    case SettingGroup::kFigure:
    case SettingGroup::kCamera:
      break;
  }
  return "picture";
}

app::Json settings_json() {
  const ViewerState initial = app::initial_state();
  app::Json all = app::Json::array();
  for (const Setting& setting : app::settings()) {
    if (!is_option(setting)) continue;
    all.push_back({{"name", setting.name},
                   {"group", group_name(setting.group)},
                   {"help", setting.help},
                   {"default", setting.get(initial)},
                   {"values", setting.values ? setting.values() : std::vector<std::string>()}});
  }
  return all;
}

app::Json features_json() {
  app::Json models = app::Json::array();
  for (const app::BundledModel& model : app::bundled_models()) models.push_back(model.name);
  return {{"version", GEOTHERM_VERSION},        {"interface", GEOTHERM_INTERFACE},
          {"methods", all_names<MethodKind>()}, {"backends", backend_names()},
          {"mesh_formats", mesh_formats()},     {"point_formats", point_formats()},
          {"tet_formats", tet_formats()},       {"grid_formats", grid_formats()},
          {"models", std::move(models)},        {"fields", all_names<QualityField>()},
          {"settings", settings_json()}};
}

template <std::size_t N>
std::vector<std::array<Index, N>> grouped_by(const std::vector<Index>& numbers) {
  std::vector<std::array<Index, N>> out(numbers.size() / N);
  for (std::size_t i = 0; i < numbers.size(); ++i) out[i / N][i % N] = numbers[i];
  return out;
}

Result<Model> build_triangles(const geotherm_shape& shape) {
  auto positions = places_in(shape.positions, "positions");
  if (!positions) return positions.error();
  const auto corners = indices_in(shape.cells, 3, "faces");
  if (!corners) return corners.error();
  const auto marks = numbers_in(shape.values, 1, "mask");
  if (!marks) return marks.error();
  auto mesh = TriangleMesh::build(*std::move(positions), grouped_by<3>(*corners));
  if (!mesh) return mesh.error();
  if (marks->empty()) return app::model_of(*std::move(mesh));
  Mask mask;
  const bool of_faces =
      std::ssize(*marks) == mesh->face_count() && std::ssize(*marks) != mesh->vertex_count();
  auto& list = of_faces ? mask.faces : mask.vertices;
  for (const double mark : *marks) {
    if (std::isnan(mark)) {
      return bad_argument("mask: number " + std::to_string(list.size()) + " is nan",
                          {"give 0 where something stays and 1 where it is left out"});
    }
    list.push_back(mark != 0 ? 1 : 0);
  }
  auto left = masked(*mesh, mask);
  if (!left) return left.error();
  return app::model_of(*std::move(left));
}

Result<Model> build_polygons(const geotherm_shape& shape) {
  auto positions = places_in(shape.positions, "positions");
  if (!positions) return positions.error();
  auto corners = indices_in(shape.cells, 1, "corners");
  if (!corners) return corners.error();
  const auto starts = indices_in(shape.starts, 1, "starts");
  if (!starts) return starts.error();
  const auto wrong_start = [&](std::size_t number, const std::string& cure) {
    return bad_argument(
        "starts: number " + std::to_string(number) + " is " + std::to_string((*starts)[number]),
        {cure});
  };
  if (starts->size() < 2) {
    return bad_argument(
        "there is no face: starts has " + app::counted(std::ssize(*starts), "number", "numbers"),
        {"give one more than there are faces"});
  }
  if (starts->front() != 0) return wrong_start(0, "begin with 0");
  const auto falls = std::ranges::adjacent_find(*starts, std::ranges::greater());
  if (falls != starts->end()) {
    return wrong_start(static_cast<std::size_t>(falls - starts->begin()) + 1,
                       "give numbers that ascend");
  }
  if (starts->back() != std::ssize(*corners)) {
    return wrong_start(starts->size() - 1,
                       "end with the number of corners, " + std::to_string(corners->size()));
  }
  return app::model_of(
      PolygonMesh{*std::move(positions), {starts->begin(), starts->end()}, *std::move(corners)});
}

Result<Model> build_tets(const geotherm_shape& shape) {
  auto positions = places_in(shape.positions, "positions");
  if (!positions) return positions.error();
  const auto corners = indices_in(shape.cells, 4, "tets");
  if (!corners) return corners.error();
  auto mesh = TetMesh::build(*std::move(positions), grouped_by<4>(*corners));
  if (!mesh) return mesh.error();
  return app::model_of(*std::move(mesh));
}

Result<Model> build_points(const geotherm_shape& shape, const Progress& progress) {
  auto positions = places_in(shape.positions, "positions");
  if (!positions) return positions.error();
  auto normals = places_in(shape.values, "normals");
  if (!normals) return normals.error();
  for (std::size_t i = 0; i < normals->size(); ++i) {
    if ((*normals)[i].allFinite()) continue;
    return bad_argument("normals: that of point " + std::to_string(i) + " is not finite",
                        {"give 0, 0, 0 where none is known"});
  }
  const auto points = PointCloud::build(*std::move(positions), *std::move(normals));
  if (!points) return points.error();
  return app::model_of(*points, progress);
}

Result<Model> build_grid(const geotherm_shape& shape) {
  constexpr std::int64_t kMaxSamples = 1'000'000'000;  // check_grid() says no to so many
  Grid grid;
  for (std::size_t k = 0; k < 3; ++k) {
    grid.size[k] = static_cast<Index>(std::clamp<std::int64_t>(shape.size[k], -1, kMaxSamples + 1));
    grid.spacing[k] = shape.spacing[k];
    grid.origin[static_cast<Eigen::Index>(k)] = shape.origin[k];
  }
  auto speeds = numbers_in(shape.values, 1, "speeds");
  if (!speeds) return speeds.error();
  grid.speeds = *std::move(speeds);
  grid.three_axes = grid.size[2] > 1;
  if (auto fits = check_grid(grid); !fits) return fits.error();
  return app::model_of(GridFile{std::move(grid), "speeds", {}});
}

Result<Model> build_from_lengths(const geotherm_shape& shape) {
  const auto corners = indices_in(shape.cells, 3, "faces");
  if (!corners) return corners.error();
  const auto lengths = numbers_in(shape.values, 3, "lengths");
  if (!lengths) return lengths.error();
  if (lengths->size() != corners->size()) {
    return bad_argument("lengths has " + std::to_string(lengths->size() / 3) + " rows, and faces " +
                        std::to_string(corners->size() / 3));
  }
  std::vector<std::array<double, 3>> opposite(lengths->size() / 3);
  for (std::size_t i = 0; i < lengths->size(); ++i) opposite[i / 3][i % 3] = (*lengths)[i];
  const auto space = app::LengthSpace::build(grouped_by<3>(*corners), opposite);
  if (!space) return space.error();
  return app::model_of(*space);
}

Result<Model> build(const geotherm_shape& shape, const Progress& progress) {
  switch (shape.kind) {
    case GEOTHERM_TRIANGLES:
      return build_triangles(shape);
    case GEOTHERM_POLYGONS:
      return build_polygons(shape);
    case GEOTHERM_TETS:
      return build_tets(shape);
    case GEOTHERM_POINTS:
      return build_points(shape, progress);
    case GEOTHERM_GRID:
      return build_grid(shape);
    case GEOTHERM_LENGTHS:
      return build_from_lengths(shape);
  }
  return bad_argument("shape.kind is " + std::to_string(static_cast<int>(shape.kind)) +
                      ", which is no geotherm_kind");
}

}  // namespace
}  // namespace geotherm::c

using namespace geotherm;     // NOLINT: the functions below are C
using namespace geotherm::c;  // NOLINT

geotherm_status geotherm_features(const char** json) {
  return guarded([&]() -> Result<void> {
    if (auto there = require(json, "json"); !there) return there;
    *json = keep_text(app::to_text(features_json()));
    return {};
  });
}

geotherm_status geotherm_options_new(geotherm_options** options) {
  return guarded([&]() -> Result<void> {
    if (auto there = require(options, "options"); !there) return there;
    hand_out(std::make_shared<Options>(), options);
    return {};
  });
}

geotherm_status geotherm_options_set(geotherm_options* options, const char* name,
                                     const char* value) {
  return guarded([&]() -> Result<void> {
    const auto object = object_of<Options>(options, "options");
    if (!object) return object.error();
    if (auto there = require(name, "name"); !there) return there;
    if (auto there = require(value, "value"); !there) return there;
    const auto setting = find_option(name);
    if (!setting) return setting.error();
    const std::lock_guard lock((*object)->lock);
    auto done = (*setting)->set((*object)->state, value);
    if (done) return done;
    Error error = done.error();
    error.message = std::string(name) + ": " + error.message;
    return error;
  });
}

geotherm_status geotherm_options_get(const geotherm_options* options, const char* name,
                                     const char** value) {
  return guarded([&]() -> Result<void> {
    const auto object = object_of<Options>(options, "options");
    if (!object) return object.error();
    if (auto there = require(name, "name"); !there) return there;
    if (auto there = require(value, "value"); !there) return there;
    const auto setting = find_option(name);
    if (!setting) return setting.error();
    const std::lock_guard lock((*object)->lock);
    *value = keep_text((*setting)->get((*object)->state));
    return {};
  });
}

geotherm_status geotherm_model_read(const char* path, const geotherm_options* options,
                                    const geotherm_watch* watch, geotherm_model** model) {
  return guarded([&]() -> Result<void> {
    if (auto there = require(path, "path"); !there) return there;
    if (auto there = require(model, "model"); !there) return there;
    const auto asked = state_of(options);
    if (!asked) return asked.error();
    const Watched watched(watch);
    auto read = app::load_model(path, asked->reading, watched.progress());
    if (!read) return read.error();
    hand_out(std::make_shared<const HeldModel>(*std::move(read)), model);
    return {};
  });
}

geotherm_status geotherm_model_build(const geotherm_shape* shape, const geotherm_options* options,
                                     const geotherm_watch* watch, geotherm_model** model) {
  return guarded([&]() -> Result<void> {
    if (auto there = require(shape, "shape"); !there) return there;
    if (auto there = require(model, "model"); !there) return there;
    const auto asked = state_of(options);
    if (!asked) return asked.error();
    const Watched watched(watch);
    auto built = build(*shape, watched.progress());
    if (!built) return built.error();
    built->name = "model";
    if (const auto eps = asked->reading.weld) {
      if (auto done = app::weld_model(*eps, *built); !done) return done;
    }
    hand_out(std::make_shared<const HeldModel>(*std::move(built)), model);
    return {};
  });
}
