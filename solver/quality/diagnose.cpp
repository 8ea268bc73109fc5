// SPDX-License-Identifier: MIT
#include "solver/quality/diagnose.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "solver/core/number_text.h"
#include "solver/geometry/mesh_report.h"
#include "solver/heat/auto_laplacian.h"
#include "solver/heat/option_text.h"
#include "solver/linear/backend.h"
#include "solver/method/distance_error.h"

namespace geotherm {
namespace {

/// What leaves more of the error than this explains nothing.
constexpr double kMostLeft = 0.8;

/// What an option leaves is better than what four times as many faces leave, unless they halve it.
constexpr double kWorthFaces = 0.5;

struct Change {
  std::string option, value, because;
  MethodOptions options;
};

class Changes {
 public:
  Changes(const MethodOptions& options, const MeshReport& mesh, double relative_t)
      : options_(options), mesh_(mesh), relative_t_(relative_t) {
    add_time_steps();
    add_laplacian();
    if (mesh.boundary_edges > 0) {
      add("boundary", options.boundary, &MethodOptions::boundary,
          "the rule of the border is " + to_text(options.boundary));
    }
    add("heat", options.heat, &MethodOptions::heat, "the heat mode is " + to_text(options.heat));
    add("variant", options.variant, &MethodOptions::variant,
        "the variant is " + to_text(options.variant));
    if (options.constraint.mode != ConstraintMode::kPinSources) {
      Change& change = add("constraint", to_text(Constraint{}),
                           "the constraint is " + to_text(options.constraint) +
                               ", which does not hold every source at 0");
      change.options.constraint = {};
    }
    add_backend();
  }

  std::vector<Change> take() { return std::move(changes_); }

 private:
  Change& add(const char* option, const std::string& value, const std::string& because) {
    return changes_.emplace_back(Change{option, value, because, options_});
  }

  /// An option whose recommended value is that of HeatOptions.
  template <class Value>
  void add(const char* option, Value value, Value HeatOptions::*member,
           const std::string& because) {
    const Value usual = HeatOptions().*member;
    if (value != usual) add(option, to_text(usual), because).options.*member = usual;
  }

  void add_time_steps() {
    const TimeStep& step = options_.time_step;
    const double edges = std::sqrt(relative_t_);
    const std::string because = std::string("t is too ") + (edges > 1 ? "large" : "small") + " (";
    const std::string measured = "sqrt(t) = " + rounded_text(edges) + " mean edges)";
    if (step.rule != TimeRule::kAbsolute && step.factor != 1) {
      add("time-factor", "1", because + "m = " + rounded_text(step.factor) + ", " + measured)
          .options.time_step.factor = 1;
    }
    if (step.rule != TimeRule::kMeanEdge) {
      add("time-step", "mean-edge", because + "--time-step " + to_text(step) + ", " + measured)
          .options.time_step.rule = TimeRule::kMeanEdge;
    }
  }

  void add_laplacian() {
    if (options_.laplacian == LaplacianKind::kAuto) return;
    const LaplacianKind usual = auto_kind(mesh_);
    if (options_.laplacian == usual) return;
    add("laplacian", to_text(LaplacianKind::kAuto),
        "the Laplacian is " + to_text(options_.laplacian) + fault_of_laplacian(usual))
        .options.laplacian = LaplacianKind::kAuto;
  }

  std::string fault_of_laplacian(LaplacianKind usual) const {
    if (options_.laplacian == LaplacianKind::kCotan && mesh_.non_delaunay_edges > 0) {
      const auto edges = static_cast<std::size_t>(mesh_.non_delaunay_edges);
      return " and " + counted_text(edges, "edge has", "edges have") +
             " a negative weight (smallest angle " + rounded_text(mesh_.smallest_angle) +
             " degrees)";
    }
    if (usual == LaplacianKind::kTufted) {
      const auto components = static_cast<std::size_t>(mesh_.tufted_components);
      return " and " + counted_text(components, "component is", "components are") +
             " no oriented manifold";
    }
    return " where auto takes " + to_text(usual);
  }

  void add_backend() {
    const auto backend = find_backend(options_.backend);
    if (options_.backend.empty() || !backend || !(*backend)->iterative()) return;
    const std::string usual = backend_names().front();
    add("backend", usual, "the iterative backend " + options_.backend + " has ended too early")
        .options.backend = usual;
  }

  const MethodOptions& options_;
  const MeshReport& mesh_;
  double relative_t_;
  std::vector<Change> changes_;
};

Change refined(const MethodOptions& options) {
  Change change{"refine", std::to_string(options.refine + 1),
                "the mesh is too coarse for the heat method", options};
  ++change.options.refine;
  return change;
}

/// Whether four times as many faces as are solved now are within the bound.
bool can_refine(Index faces, int refine) {
  double refined_faces = faces;
  for (int i = 0; i <= refine; ++i) refined_faces *= 4;
  return refined_faces <= kMostFacesDiagnosed;
}

/// The question, and the best answer to it so far.
class Search {
 public:
  Search(std::shared_ptr<const TriangleMesh> mesh, const SourceSet& sources,
         std::span<const double> better, double before)
      : mesh_(std::move(mesh)), sources_(sources), better_(better), before_(before) {}

  /// Takes a change for the cause if it leaves less error than `most`. A solve that fails explains
  /// nothing. Errors: kCancelled.
  Result<void> look_at(const Change& change, double most, const Progress& progress) {
    const auto method = build_method(mesh_, change.options, part_of(progress, 0.0, 0.7));
    if (!method) return unless_cancelled(method.error());
    const auto answer = (*method)->solve(sources_, {.quality = false}, part_of(progress, 0.7, 1.0));
    if (!answer) return unless_cancelled(answer.error());
    const DistanceError error = distance_error(answer->distances, better_);
    if (error.worst == kNoIndex || error.differently_reached > 0) return {};
    if (!(error.mean_relative < most)) return {};
    cause = ErrorCause{change.option, change.value, change.because, before_, error.mean_relative};
    return {};
  }

  double left() const { return cause ? cause->mean_relative_after : before_; }

  std::optional<ErrorCause> cause;

 private:
  static Result<void> unless_cancelled(const Error& error) {
    if (error.code == ErrorCode::kCancelled) return error;
    return {};
  }

  std::shared_ptr<const TriangleMesh> mesh_;
  const SourceSet& sources_;
  std::span<const double> better_;
  double before_;
};

}  // namespace

Result<Diagnosis> diagnose(const std::shared_ptr<const TriangleMesh>& mesh,
                           const MethodOptions& options, double relative_t,
                           const SourceSet& sources, std::span<const double> distances,
                           std::span<const double> better, const Progress& progress) {
  const double before = distance_error(distances, better).mean_relative;
  if (!(before > 0)) return Diagnosis{};
  if (mesh->face_count() > kMostFacesDiagnosed) return Diagnosis{.cause = {}, .skipped = true};
  const MeshReport report = inspect_mesh(*mesh);
  const std::vector<Change> changes = Changes(options, report, relative_t).take();
  Search search(mesh, sources, better, before);
  double done = 0;
  for (const Change& change : changes) {
    const double next = done + 0.5 / static_cast<double>(changes.size());
    const double most = std::min(search.left(), kMostLeft * before);
    const auto looked = search.look_at(change, most, part_of(progress, done, next));
    if (!looked) return looked.error();
    done = next;
  }
  const bool is_cured = search.cause && search.left() <= kGoodError;
  const bool refine = !is_cured && can_refine(mesh->face_count(), options.refine);
  if (refine) {
    const double most = search.cause ? kWorthFaces * search.left() : kMostLeft * before;
    const auto looked = search.look_at(refined(options), most, part_of(progress, done, 1.0));
    if (!looked) return looked.error();
  }
  return Diagnosis{.cause = std::move(search.cause), .skipped = false, .refined = refine};
}

}  // namespace geotherm
