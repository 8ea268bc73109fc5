// SPDX-License-Identifier: MIT
// What a handle holds: arrays, texts, files.
#include <algorithm>
#include <memory>
#include <utility>

#include "app/c/handles.h"
#include "app/session/outputs.h"
#include "app/session/wording.h"
#include "app/text/text.h"
#include "geotherm/accuracy.h"
#include "geotherm/io.h"
#include "solver/core/text.h"

namespace geotherm::c {
namespace {

using app::Json;
using app::Model;

/// What is inside is handed out to be read.
template <class T>
geotherm_array view_of(std::span<const T> values, std::int64_t columns) {
  geotherm_array out = {};
  out.data = const_cast<void*>(static_cast<const void*>(values.data()));  // NOLINT: see above
  if constexpr (std::is_same_v<T, double>) {
    out.type = GEOTHERM_FLOAT64;
  } else {
    out.type = sizeof(T) == 8 ? GEOTHERM_INT64 : GEOTHERM_INT32;
  }
  out.columns = columns;
  out.rows = std::ssize(values) / columns;
  return out;
}

geotherm_array view_of(const NamedArray& array) {
  return std::visit(
      [&](const auto& values) { return view_of(std::span(std::as_const(values)), array.columns); },
      array.values);
}

Error no_name(const char* what, const std::string& name, const std::vector<std::string>& names) {
  return unknown_name(ErrorCode::kNotAvailable, std::string("there is no ") + what + " '*'", name,
                      names);
}

Result<geotherm_array> array_in(const Model& model, const std::string& name) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double) && sizeof(Face) == 3 * sizeof(Index));
  const auto positions = model.mesh->positions();
  const auto faces = model.mesh->faces();
  if (name == "positions") {
    return view_of(
        std::span(positions.empty() ? nullptr : positions.data()->data(), 3 * positions.size()), 3);
  }
  if (name == "faces") {
    return view_of(std::span(faces.empty() ? nullptr : faces.data()->data(), 3 * faces.size()), 3);
  }
  return no_name("array", name, {"positions", "faces"});
}

/// A field of the answer, computed when it is first asked for.
Result<std::vector<double>> field_in(const app::Answer& answer, QualityField field) {
  std::span<const double> error;
  if (field == QualityField::kError) {
    if (!answer.error || answer.error->values.empty()) {
      return bad_argument(
          "there is no error: " +
          (answer.error ? sentence(*answer.error) : std::string("the distances were not checked")));
    }
    error = answer.error->values;
  }
  if (needs_heat(field) && answer.result.log_heat.empty()) {
    return bad_argument(to_text(field) + " is about the heat, which was not kept",
                        {"ask for the fields"});
  }
  const auto& space = answer.model.space;
  if (space && app::is_of_cells(field)) {
    return app::cell_field(*space, field, answer.result, space->cells_of_faces());
  }
  return quality_field(field, *answer.model.mesh, answer.result, error).values;
}

Result<geotherm_array> array_in(const Answer& answer, const std::string& name) {
  const std::lock_guard lock(answer.lock);
  const auto kept = std::ranges::find(answer.arrays, name, [](const auto& a) { return a->name; });
  if (kept != answer.arrays.end()) return view_of(**kept);
  std::vector<std::string> names;
  for (const auto& array : answer.arrays) names.push_back(array->name);
  if (!answer.solved) return no_name("array", name, names);
  const DistanceResult& result = answer.solved->result;
  if (name == "distances") return view_of(std::span(result.distances), 1);
  if (name == "nearest_source" && !result.nearest_source.empty()) {
    return view_of(std::span(result.nearest_source), 1);
  }
  if (name == "heat" && !result.heat.empty()) return view_of(std::span(result.heat), 1);
  if (name == "log_heat" && !result.log_heat.empty()) return view_of(std::span(result.log_heat), 1);
  const auto field = parse<QualityField>(name);
  if (!field) {
    names = {"distances"};
    if (!result.nearest_source.empty()) names.emplace_back("nearest_source");
    if (!result.heat.empty()) names.insert(names.end(), {"heat", "log_heat"});
    for (std::string& each : all_names<QualityField>()) names.push_back(std::move(each));
    return no_name("array", name, names);
  }
  auto values = field_in(*answer.solved, *field);
  if (!values) return values.error();
  answer.arrays.push_back(
      std::make_unique<const NamedArray>(NamedArray{name, *std::move(values), 1}));
  return view_of(*answer.arrays.back());
}

Json summary_json(const Model& model) {
  return {{"name", model.name},
          {"domain", app::domain_name(model)},
          {"vertices", model.mesh->vertex_count()},
          {"faces", model.mesh->face_count()},
          {"size", app::size_in_words(model)}};
}

Result<std::string> text_in(const Model& model, const std::string& name) {
  if (name == "name") return model.name;
  if (name == "domain") return std::string(app::domain_name(model));
  if (name == "summary") return app::to_text(summary_json(model));
  if (name != "json" && name != "table") {
    return no_name("text", name, {"json", "table", "name", "domain", "summary"});
  }
  MeshReport mesh = inspect_mesh(*model.mesh);
  app::describe_space(model, mesh);
  if (name == "table") return app::info_table(model, mesh);
  std::vector<Warning> warnings = model.notes;
  if (model.is_mesh()) {
    for (Warning& warning : app::mesh_warnings(mesh)) warnings.push_back(std::move(warning));
  }
  return app::to_text(
      Json{{"model", app::full_model_json(model, mesh)}, {"warnings", app::to_text(warnings)}});
}

Result<std::string> text_in(const Solver& solver, const std::string& name) {
  if (name != "json") return no_name("text", name, {"json"});
  const DistanceMethod& method = *solver.ready.method;
  DistanceResult answer;
  if (method.heat() != nullptr) answer.backend = method.heat()->options().backend;
  return app::to_text(Json{{"options", app::options_json(method, solver.options, answer)},
                           {"timing_ms", {{"setup", solver.ready.setup_ms}}},
                           {"memory_mb", {{"factor", method.memory_mb()}}},
                           {"warnings", app::to_text(method.warnings())}});
}

Result<std::string> text_in(const Answer& answer, const std::string& name) {
  if (!answer.solved) {
    if (name == "warnings") return app::to_text(Json(app::to_text(answer.warnings)));
    std::vector<std::string> names = {"warnings"};
    for (const auto& [called, text] : answer.texts) {
      if (called == name) return text;
      names.push_back(called);
    }
    return no_name("text", name, names);
  }
  if (name == "json") return app::to_text(app::solve_json(*answer.solved));
  if (name == "table") return app::solve_table(*answer.solved);
  return no_name("text", name, {"json", "table"});
}

constexpr const char* kAsNumbers = "write distances as .npy or .csv";

Result<void> write(const Model& model, const std::string& path) {
  if (auto there = require_places(model, {kAsNumbers}); !there) return there;
  const auto tets = app::tets_of(model);
  if (tets && check_tets_path(path)) return write_tets(path, *tets);
  return write_mesh(path, *model.mesh);
}

Result<void> write(const Answer& answer, const std::string& path) {
  if (answer.lines) {
    std::vector<Polyline> lines;
    for (const Isoline& line : answer.lines->all) {
      lines.push_back(
          {&line.path, answer.lines->have_values ? std::optional(line.value) : std::nullopt});
    }
    return write_polylines(path, *answer.lines->mesh, lines);
  }
  if (!answer.solved) return bad_argument("this answer is not written: it is arrays");
  const app::Answer& solved = *answer.solved;
  if (auto fits = app::check_answer_path(solved.model, path); !fits) return fits;
  if (app::holds_mesh(path)) {
    if (auto there = require_places(solved.model, {kAsNumbers}); !there) return there;
  }
  return app::write_answer(path, solved.model, solved.result.distances,
                           solved.result.nearest_source, {});
}

/// What is behind a handle that may be of any kind. Errors: kBadInput.
Result<Object> any_object(const void* handle) {
  if (auto there = require(handle, "handle"); !there) return there.error();
  auto found = find_handle(handle);
  if (!found) return bad_argument("handle is no handle, or was freed");
  return *std::move(found);
}

Error no_such_kind(const char* what) { return bad_argument(std::string("handle has no ") + what); }

}  // namespace

Result<void> require_places(const Model& model, Hint cure) {
  if (!model.space || model.space->has_places()) return {};
  return bad_argument(model.name + " is a surface of edge lengths, whose vertices have no places",
                      std::move(cure));
}
}  // namespace geotherm::c

using namespace geotherm;     // NOLINT: the functions below are C
using namespace geotherm::c;  // NOLINT

geotherm_status geotherm_array_of(const void* handle, const char* name, geotherm_array* array) {
  return guarded([&]() -> Result<void> {
    const auto object = any_object(handle);
    if (!object) return object.error();
    if (auto there = require(name, "name"); !there) return there;
    if (auto there = require(array, "array"); !there) return there;
    Result<geotherm_array> found = no_such_kind("arrays");
    if (const auto* const model = std::get_if<std::shared_ptr<const HeldModel>>(&*object)) {
      found = array_in(**model, name);
    } else if (const auto* const answer = std::get_if<std::shared_ptr<const Answer>>(&*object)) {
      found = array_in(**answer, name);
    }
    if (!found) return found.error();
    *array = *found;
    return {};
  });
}

geotherm_status geotherm_text_of(const void* handle, const char* name, const char** text) {
  return guarded([&]() -> Result<void> {
    const auto object = any_object(handle);
    if (!object) return object.error();
    if (auto there = require(name, "name"); !there) return there;
    if (auto there = require(text, "text"); !there) return there;
    Result<std::string> found = std::visit(
        [&]<class T>(const std::shared_ptr<T>& held) -> Result<std::string> {
          if constexpr (std::is_same_v<T, Options>) {
            return no_such_kind("texts");
          } else {
            return text_in(*held, name);
          }
        },
        *object);
    if (!found) return found.error();
    *text = keep_text(*std::move(found));
    return {};
  });
}

geotherm_status geotherm_write(const void* handle, const char* path) {
  return guarded([&]() -> Result<void> {
    const auto object = any_object(handle);
    if (!object) return object.error();
    if (auto there = require(path, "path"); !there) return there;
    if (std::string_view(path) == "-") return bad_argument("path is -, which is no file");
    if (const auto* const model = std::get_if<std::shared_ptr<const HeldModel>>(&*object)) {
      return write(**model, path);
    }
    if (const auto* const answer = std::get_if<std::shared_ptr<const Answer>>(&*object)) {
      return write(**answer, path);
    }
    return no_such_kind("files");
  });
}
