// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "geotherm/accuracy.h"
#include "geotherm/build_method.h"
#include "geotherm/error.h"
#include "geotherm/heat_method.h"
#include "geotherm/mesh_report.h"
#include "geotherm/options.h"
#include "solver/geometry/clean_faces.h"

// What people are told, in sentences: what the library says, with settings as options of the
// command line; methods and meshes in words.
namespace geotherm::app {

/// "SUBJECT: WHAT; try --backend cg, which needs no factor".
std::string to_text(const Error& error);
std::string to_text(const Warning& warning);
std::vector<std::string> to_text(const std::vector<Warning>& warnings);
std::string to_text(const AccuracyReport& report);

/// What the error says, where the work goes on all the same.
Warning warning_of(Error error);

/// The error with where it happened in front: "WHERE: WHAT".
Error about(const std::string& where, const Error& error);
Error about(const std::string& where, Error error, ErrorCode code);

/// Whether another setting is what cures it: then the command line is wrong, and not the model.
bool is_about_setting(const Error& error);

/// The error with this hint, unless it has one.
Error with_hint(Error error, Hint hint);

/// What does the work, in a word: the backend of the heat method, or the name of another method.
std::string solver_name(const MethodOptions& options);

/// The same of what has given an answer, which may be another backend than the one asked for.
std::string solver_at_work(const DistanceMethod& method, const DistanceResult& result);

/// "t = 0.0123, cholmod", or the name of another method.
std::string method_caption(const DistanceMethod& method);

/// "bunny, 4,000 faces, t = 0.0123, cholmod"; `size`: size_in_words(); `method`: null without a
/// solve.
std::string picture_caption(const std::string& model, const std::string& size,
                            const DistanceMethod* method);

/// "cotan", or what else the Laplacian of a method is that was built.
std::string laplacian_name(const HeatMethod& method);

/// What `--laplacian auto` becomes on a mesh, and because of what.
struct LaplacianChoice {
  LaplacianKind kind;
  std::string why;
};
LaplacianChoice auto_laplacian(const MeshReport& mesh);

/// "31 vertices inserted (4 on the boundary) for 40 large faces and 3 obtuse boundary edges".
/// Precondition: there are some.
std::string refinement_in_words(const RefinementCounts& refinement);

/// "2,002 vertices, 4,000 faces, 1 component, no boundary".
std::string mesh_in_words(const MeshSummary& mesh);

/// "799,840 faces, about 436 MB": a mesh whose faces are cut into four so often.
std::string refined_in_words(Index faces, int times);

/// What closes the cracks. Precondition: there are some.
Warning crack_note(const CrackReport& cracks);

/// What a user should know before trusting distances on the mesh, one sentence each.
std::vector<Warning> mesh_warnings(const MeshReport& mesh);

}  // namespace geotherm::app
