// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>

#include <string>

#include "app/session/answer.h"
#include "app/session/settings.h"

namespace geotherm::app {

/// Keeps the keys in the order in which they are written.
using Json = nlohmann::ordered_json;

/// A setting as its kind is written, and its key.
Json setting_json(const Setting& setting, const ViewerState& state);
std::string key_of(const Setting& setting);

/// The keys of `model` that every report has. "path" is null where the model is no file.
Json model_json(const Model& model, const MeshSummary& mesh);

/// The model of commands that say no more of it: its name and size.
Json brief_model_json(const Model& model);
std::string brief_model_text(const Model& model);

/// Says what the model holds where that is no surface: "domain", and of a volume "tets". Faces and
/// edges of a solve are those of its border, or of the triangles between points.
void add_domain(const Model& model, Json& json);

/// Those and all others of the mesh report; of a space its own.
Json full_model_json(const Model& model, const MeshReport& mesh);

/// [x, y, z].
inline Json vector_json(const Vec3& v) { return Json::array({v[0], v[1], v[2]}); }
/// "x, y, z".
std::string vector_text(const Vec3& v);

/// A vertex id, {"face", "weights"}, or {"cell", "weights"}.
Json point_json(const SurfacePoint& point);
Json point_json(const CellPoint& point);

/// Vertices as ids (ascending, ends of edges included), points in faces as {"face", "weights"}.
Json sources_json(const SourceSet& sources);

/// The key `options` of every report of a solve: the method as it is, `options` as they were asked
/// for. `answer`: one of its answers, for the backend that gave it and those that failed.
Json options_json(const DistanceMethod& method, const MethodOptions& options,
                  const DistanceResult& answer);

/// The key `error` of every report of distances. Figures of what was not measured are null.
Json error_json(const AccuracyReport& report);
/// The same of some of many source sets.
Json error_json(const SampleCheck& check);

/// The key `distance`.
Json distance_json(const DistanceSummary& distance);
/// "0 to 1.52, mean 0.7".
std::string distances_in_words(const DistanceSummary& distance);

/// The key `quality`. `heat`: of the heat method; what others have not is null.
Json quality_json(const Quality& quality, bool heat);

Json solve_json(const Answer& figures);

/// Text with a line end. Objects are indented down to the second level, what is deeper stands on
/// one line. Numbers have the digits that read back as the same double; what is not finite is null.
std::string to_text(const Json& json);

/// The text of a whole report: "program" (version, schema, command), then the figures.
std::string report_text(Json figures);

/// What was typed to start this process, as one line for a shell; empty until it is remembered.
/// remember_command() is called once, before there are other threads.
void remember_command(std::string command);
const std::string& typed_command();

/// What `solve` shows to people.
std::string solve_table(const Answer& figures);

/// What `info` shows to people.
std::string info_table(const Model& model, const MeshReport& mesh);

}  // namespace geotherm::app
