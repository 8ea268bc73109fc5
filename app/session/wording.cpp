// SPDX-License-Identifier: MIT
#include "app/session/wording.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "app/session/progress.h"
#include "app/text/text.h"
#include "geotherm/accuracy.h"
#include "geotherm/heat_method.h"
#include "geotherm/options.h"
#include "solver/core/text.h"
#include "solver/heat/factor_memory.h"

namespace geotherm::app {
namespace {

constexpr const char* kBeforeOption = "--";

}  // namespace

std::string to_text(const Error& error) { return sentence(error, kBeforeOption); }

std::string to_text(const Warning& warning) { return sentence(warning, kBeforeOption); }

std::vector<std::string> to_text(const std::vector<Warning>& warnings) {
  std::vector<std::string> sentences;
  for (const Warning& warning : warnings) sentences.push_back(to_text(warning));
  return sentences;
}

std::string to_text(const AccuracyReport& report) { return sentence(report, kBeforeOption); }

Warning warning_of(Error error) {
  Hint hint = std::exchange(error.hint, {});
  return {sentence(error), std::move(hint)};
}

Error about(const std::string& where, const Error& error) {
  Warning said = warning_of(error);
  return {error.code, where + ": " + said.message, std::move(said.hint)};
}

Error about(const std::string& where, Error error, ErrorCode code) {
  error.code = code;
  return about(where, error);
}

bool is_about_setting(const Error& error) {
  const auto names_one = [](const auto& part) { return std::holds_alternative<SettingHint>(part); };
  return error.code == ErrorCode::kBadInput && std::ranges::any_of(error.hint, names_one);
}

Error with_hint(Error error, Hint hint) {
  if (error.hint.empty()) error.hint = std::move(hint);
  return error;
}

std::string solver_name(const MethodOptions& options) {
  return options.method == MethodKind::kHeat ? options.backend : to_text(options.method);
}

std::string solver_at_work(const DistanceMethod& method, const DistanceResult& result) {
  return method.heat() != nullptr ? result.backend : to_text(method.kind());
}

std::string method_caption(const DistanceMethod& method) {
  const HeatMethod* heat = method.heat();
  if (heat == nullptr) return to_text(method.kind());
  const double t = heat->t();
  const bool is_double = std::isnormal(t);  // a model of size 1e200 or 1e-200 has another t
  return (is_double ? "t = " + significant(t) + ", " : "") + heat->options().backend;
}

std::string picture_caption(const std::string& model, const std::string& size,
                            const DistanceMethod* method) {
  const std::string text = one_line(model) + ", " + size;
  return method == nullptr ? text : text + ", " + method_caption(*method);
}

std::string laplacian_name(const HeatMethod& method) { return to_text(method.laplacian()); }

namespace {

/// A needle below this angle (degrees) costs accuracy nearby even after edge flips.
constexpr double kNeedle = 0.01;

}  // namespace

LaplacianChoice auto_laplacian(const MeshReport& mesh) {
  const LaplacianKind kind = auto_kind(mesh);
  if (kind == LaplacianKind::kRefined) return {kind, refinement_in_words(mesh.refinement)};
  if (kind == LaplacianKind::kTufted) {
    return {kind, grouped(mesh.tufted_components) + " of " +
                      counted(mesh.components, "component is", "components are") +
                      " no oriented manifold along all edges"};
  }
  if (kind == LaplacianKind::kIntrinsicDelaunay) {
    return {kind, counted(mesh.non_delaunay_edges, "edge is", "edges are") + " not Delaunay"};
  }
  return {kind, "every inner edge is Delaunay"};
}

std::string refinement_in_words(const RefinementCounts& refinement) {
  std::string text = counted(refinement.points, "vertex", "vertices") + " inserted";
  if (refinement.boundary_splits > 0) {
    text += " (" + grouped(refinement.boundary_splits) + " on the boundary)";
  }
  std::vector<std::string> reasons;
  if (refinement.large_faces > 0) {
    reasons.push_back(counted(refinement.large_faces, "large face", "large faces"));
  }
  if (refinement.obtuse_boundary > 0) {
    reasons.push_back(
        counted(refinement.obtuse_boundary, "obtuse boundary edge", "obtuse boundary edges"));
  }
  return text + " for " + joined(reasons, " and ");
}

std::string mesh_in_words(const MeshSummary& mesh) {
  return counted(mesh.vertices, "vertex", "vertices") + ", " +
         counted(mesh.faces, "face", "faces") + ", " +
         counted(mesh.components, "component", "components") + ", " +
         (mesh.boundary_edges == 0
              ? "no boundary"
              : counted(mesh.boundary_edges, "boundary edge", "boundary edges"));
}

std::string refined_in_words(Index faces, int times) {
  const std::int64_t all = refined_faces(faces, times);
  return grouped(all) + " faces, about " + bytes_in_words(refined_bytes(all));
}

Warning crack_note(const CrackReport& cracks) {
  const std::string distance = number_text(cracks.distance);
  return {counted(cracks.vertices, "vertex lies", "vertices lie") +
              (cracks.distance > 0 ? " within " + distance + " of another"
                                   : " exactly where another one does") +
              ": the surface is cracked",
          {SettingHint{"weld", {distance}},
           " closes " + grouped(cracks.closed_edges) + " of " +
               counted(cracks.boundary_edges, "boundary edge", "boundary edges")}};
}

std::vector<Warning> mesh_warnings(const MeshReport& mesh) {
  std::vector<Warning> out;
  if (mesh.components == 0)
    out.push_back({"no face can carry distances", {"check how the file was exported"}});
  if (mesh.components > 1) {
    out.push_back({grouped(mesh.components) +
                   " components: distances are infinite on those without a source"});
  }
  if (mesh.unreferenced_vertices > 0) {
    out.push_back({counted(mesh.unreferenced_vertices, "vertex belongs", "vertices belong") +
                   " to no face; the distance there is infinite"});
  }
  if (mesh.nonmanifold_edges > 0) {
    out.push_back({counted(mesh.nonmanifold_edges, "edge has", "edges have") +
                   " more than two faces; distances pass through all of them"});
  }
  if (mesh.nonmanifold_vertices > 0) {
    out.push_back({counted(mesh.nonmanifold_vertices, "vertex joins", "vertices join") +
                   " parts of the surface that share no edge there"});
  }
  if (const Index repeated = mesh.repeated_corner_faces - mesh.one_vertex_faces; repeated > 0) {
    out.push_back(
        {counted(repeated, "face repeats", "faces repeat") + " a corner and will be left out"});
  }
  const Mollification& mollified = mesh.mollified;
  if (mollified.most > 0) {
    out.push_back({counted(mollified.faces, "face has", "faces have") +
                   " no or nearly no area: " + counted(mollified.edges, "edge", "edges") + " in " +
                   counted(mollified.components, "component", "components") +
                   " will be lengthened, by up to " + significant(mollified.most) + ", which is " +
                   significant(mollified.most / mesh.mean_edge_length, 2) + " mean edges"});
  } else if (mesh.components > 0 && mesh.smallest_angle < kNeedle) {
    out.push_back({"there are needles: the smallest angle is " +
                   significant(mesh.smallest_angle, 2) + " degrees"});
  }
  if (mesh.duplicate_faces > 0) {
    out.push_back(
        {counted(mesh.duplicate_faces, "duplicate face", "duplicate faces") + " will be left out"});
  }
  if (mesh.inconsistent_faces > 0) {
    out.push_back({counted(mesh.inconsistent_faces, "face is", "faces are") +
                   " turned against the neighbours; distances do not depend on it"});
  }
  if (!mesh.orientable)
    out.push_back({"the surface cannot be oriented; distances are right all the same"});
  if (mesh.duplicate_positions > 0) {
    out.push_back(
        {counted(mesh.duplicate_positions, "vertex lies", "vertices lie") +
         " exactly where another one does; where they should be one, the surface is cut"});
  }
  return out;
}

}  // namespace geotherm::app
