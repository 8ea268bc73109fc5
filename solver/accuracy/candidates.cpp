// SPDX-License-Identifier: MIT
#include "solver/accuracy/candidates.h"

#include <algorithm>
#include <cmath>

#include "geotherm/backend.h"
#include "geotherm/heat_method.h"
#include "geotherm/options.h"
#include "solver/core/text.h"

namespace geotherm {
namespace {

/// Work of a candidate, in faces of the mesh: one factor of two beside an analysis that is there, a
/// set-up of its own, that of a cover, that of a mesh whose faces are cut into four.
constexpr double kFactor = 1.0 / 3, kSetUp = 1, kCover = 2, kRefined = 4;

class Candidates {
 public:
  Candidates(const MethodOptions& options, const MeshReport& mesh, double relative_t)
      : options_(options), mesh_(mesh), relative_t_(relative_t) {
    // On surfaces the one is the other.
    if (options_.boundary == BoundaryRule::kNeumann) options_.boundary = BoundaryRule::kAuto;
  }

  std::vector<Candidate> take() {
    add_recommended();
    cheapest_first(0);
    const std::size_t usual = candidates_.size();
    add_others();
    cheapest_first(usual);
    return std::move(candidates_);
  }

 private:
  /// Options that are not what is recommended, set to that.
  void add_recommended() {
    add_time_steps();
    add_laplacian();
    if (mesh_.boundary_edges > 0) {
      reset("boundary", options_.boundary, &MethodOptions::boundary, "the boundary rule");
    }
    reset("heat", options_.heat, &MethodOptions::heat, "the heat mode");
    reset("variant", options_.variant, &MethodOptions::variant, "the variant");
    if (options_.constraint.mode != ConstraintMode::kPinSources) {
      Candidate& candidate = add("constraint", to_text(Constraint{}), kFactor,
                                 "the constraint is " + to_text(options_.constraint) +
                                     ", which does not hold every source at 0");
      candidate.options.constraint = {};
    }
    add_backend();
  }

  /// Other values of options, which are right on some meshes.
  void add_others() {
    for (const double factor : {2.0, 4.0}) {
      const TimeStep& step = options_.time_step;
      if (step.rule == TimeRule::kAbsolute || step.factor == factor) continue;
      add("time-factor", rounded_text(factor), kFactor).options.time_step.factor = factor;
    }
    other("variant", &MethodOptions::variant, {Variant::kClassic}, kFactor);
    if (mesh_.boundary_edges > 0) {
      other("boundary", &MethodOptions::boundary,
            {BoundaryRule::kAverage, BoundaryRule::kDirichlet}, kFactor);
    }
    if (auto_kind(mesh_) != LaplacianKind::kTufted) {
      other("laplacian", &MethodOptions::laplacian, {LaplacianKind::kTufted}, kCover);
    }
  }

  Candidate& add(const char* option, const std::string& value, double faces,
                 const std::string& because = {}) {
    return candidates_.emplace_back(Candidate{option, value, because, faces, options_});
  }

  /// An option whose recommended value is that of HeatOptions.
  template <class Value>
  void reset(const char* option, Value value, Value HeatOptions::*member, const char* what) {
    const Value usual = HeatOptions().*member;
    if (value == usual) return;
    add(option, to_text(usual), kFactor, std::string(what) + " is " + to_text(value)).options.*
        member = usual;
  }

  /// Values instead of the recommended one.
  template <class Value>
  void other(const char* option, Value HeatOptions::*member, std::initializer_list<Value> values,
             double faces) {
    if (options_.*member != HeatOptions().*member) return;
    for (const Value value : values) {
      add(option, to_text(value), faces).options.*member = value;
    }
  }

  void add_time_steps() {
    const TimeStep& step = options_.time_step;
    const double edges = std::sqrt(relative_t_);
    const std::string because = std::string("t is too ") + (edges > 1 ? "large" : "small") + " (";
    const std::string measured = "sqrt(t) = " + rounded_text(edges) + " mean edges)";
    if (step.rule != TimeRule::kAbsolute && step.factor != 1) {
      add("time-factor", "1", kFactor,
          because + "m = " + rounded_text(step.factor) + ", " + measured)
          .options.time_step.factor = 1;
    }
    if (step.rule != TimeRule::kMeanEdge) {
      add("time-step", "mean-edge", kFactor,
          because + "time step " + to_text(step) + ", " + measured)
          .options.time_step.rule = TimeRule::kMeanEdge;
    }
  }

  void add_laplacian() {
    if (options_.laplacian == LaplacianKind::kAuto) return;
    const LaplacianKind usual = auto_kind(mesh_);
    if (options_.laplacian == usual) return;
    add("laplacian", to_text(LaplacianKind::kAuto), kSetUp,
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
    add("backend", usual, kSetUp,
        "the iterative backend " + options_.backend + " has ended too early")
        .options.backend = usual;
  }

  void cheapest_first(std::size_t from) {
    std::ranges::stable_sort(candidates_.begin() + static_cast<std::ptrdiff_t>(from),
                             candidates_.end(), {}, &Candidate::faces);
  }

  MethodOptions options_;
  const MeshReport& mesh_;
  double relative_t_;
  std::vector<Candidate> candidates_;
};

}  // namespace

std::vector<Candidate> heat_candidates(const MethodOptions& options, const MeshReport& mesh,
                                       double relative_t) {
  return Candidates(options, mesh, relative_t).take();
}

std::vector<Candidate> space_candidates(const MethodOptions& options, bool has_boundary,
                                        double relative_t) {
  std::vector<Candidate> out = heat_candidates(options, {}, relative_t);
  std::erase_if(out, [](const Candidate& each) { return each.option == "laplacian"; });
  const TimeStep& step = options.time_step;
  if (step.rule != TimeRule::kAbsolute && step.factor != 0.5) {
    out.push_back({"time-factor", "0.5", {}, kFactor, options});
    out.back().options.time_step.factor = 0.5;
  }
  for (const BoundaryRule rule :
       {BoundaryRule::kAuto, BoundaryRule::kAverage, BoundaryRule::kNeumann}) {
    if (!has_boundary || rule == options.boundary) continue;
    out.push_back({"boundary", to_text(rule), {}, kFactor, options});
    out.back().options.boundary = rule;
  }
  return out;
}

Candidate refined_candidate(const MethodOptions& options) {
  Candidate candidate{"refine", std::to_string(options.refine + 1),
                      "the mesh is too coarse for the heat method", kRefined, options};
  ++candidate.options.refine;
  return candidate;
}

}  // namespace geotherm
