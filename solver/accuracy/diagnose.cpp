// SPDX-License-Identifier: MIT
#include "geotherm/accuracy.h"

#include <algorithm>
#include <utility>

#include "geotherm/heat_method.h"
#include "solver/accuracy/candidates.h"
#include "solver/polyhedral/wave_surface.h"

namespace geotherm {
namespace {

/// What leaves more of the error than this explains nothing.
constexpr double kMaxLeft = 0.8;

/// What leaves more than this of what the best before it leaves is not the cause: values that are
/// right on some meshes only, after one that is recommended; four times as many faces.
constexpr double kWorthOther = 0.8, kWorthFaces = 0.5;

/// Shares of the progress: options of the heat method, more faces, other methods.
constexpr double kOptionsDone = 0.5, kFacesDone = 0.8;

/// The question, and the best answers to it so far.
class CauseSearch {
 public:
  /// `mesh`: null in other spaces, where only options of the heat method are tried.
  CauseSearch(MakeMethod make, std::shared_ptr<const TriangleMesh> mesh,
              const CheckedAnswers& answers, MethodKind reference,
              std::span<const std::vector<double>> better)
      : make_(std::move(make)),
        mesh_(std::move(mesh)),
        answers_(answers),
        reference_(reference),
        better_(better),
        before_(joint_error(answers.distances, better).figures),
        left_(badness(before_)),
        exact_answers_(reference == MethodKind::kExact) {}

  /// Tries what changes an option of the heat method. It is the remedy if its answer is good. It is
  /// the cause so far if it is the remedy, or leaves less than `share` of what was left by the best
  /// before it, and lowers the mean error. What fails explains nothing. Errors: kCancelled.
  Result<void> try_option(const Candidate& candidate, double share, const Progress& progress) {
    const auto error = error_of(candidate.options, better_, progress);
    if (!error) return unless_cancelled(error.error());
    const TriedSetting tried = keep(candidate.option, candidate.value, *error, reference_);
    const double left = badness(*error);
    const bool good = left <= 1 && left < badness(before_);
    if (good) found.remedy = tried;
    const double most = std::min(kMaxLeft * badness(before_), (found.cause ? share : 1) * left_);
    if (error->mean_relative >= before_.mean_relative || (left >= most && !good)) return {};
    found.cause = ErrorCause{candidate.option, candidate.value, candidate.because,
                             before_.mean_relative, error->mean_relative};
    left_ = left;
    return {};
  }

  /// The methods that are better than the one that answered, the fastest first.
  Result<void> try_methods(const Progress& progress) {
    for (const MethodKind kind : {MethodKind::kWavefront, MethodKind::kWavefrontFine}) {
      if (!is_better(kind, answers_.method.kind())) continue;
      if (auto tried = try_method(kind, progress); !tried) return tried;
      if (found.remedy) return {};
    }
    if (exact_answers_ && is_better(MethodKind::kExact, answers_.method.kind())) {
      // Exact distances are without error by definition.
      found.remedy = keep("method", to_text(MethodKind::kExact), {}, MethodKind::kExact);
    }
    return {};
  }

  /// The reference, which is right by definition.
  void take_reference() { found.remedy = keep("method", to_text(reference_), {}, reference_); }

  Diagnosis found;

 private:
  /// What a method is held against: the reference, where it is better than the method, else one
  /// that is. Errors: those of the method that is to be solved with.
  Result<void> try_method(MethodKind kind, const Progress& progress) {
    MethodOptions options;
    options.method = kind;
    options.threads = answers_.options.threads;
    if (is_better(reference_, kind)) return try_against(options, reference_, better_, progress);
    const bool small = mesh_->face_count() <= kMaxFacesExact;
    for (const MethodKind reference : {MethodKind::kExact, MethodKind::kWavefrontFine}) {
      if (!is_better(reference, kind) || (reference == MethodKind::kExact && !small)) continue;
      const auto better = solve_reference(mesh_, reference, answers_.sources, options.threads,
                                          triangulation_for_waves(answers_.method), progress);
      if (better) {
        exact_answers_ = exact_answers_ || reference == MethodKind::kExact;
        return try_against(options, reference, better->distances, progress);
      }
      if (better.error().code == ErrorCode::kCancelled) return better.error();
    }
    return {};
  }

  Result<void> try_against(const MethodOptions& options, MethodKind reference,
                           std::span<const std::vector<double>> better, const Progress& progress) {
    // Where the method is the reference, its answers are there.
    const auto error = options.method == reference_
                           ? Result<DistanceError>(joint_error(better_, better).figures)
                           : error_of(options, better, progress);
    if (!error) return unless_cancelled(error.error());
    const TriedSetting tried = keep("method", to_text(options.method), *error, reference);
    if (badness(*error) <= 1) found.remedy = tried;
    return {};
  }

  Result<DistanceError> error_of(const MethodOptions& options,
                                 std::span<const std::vector<double>> better,
                                 const Progress& progress) const {
    const auto method = make_(options, part_of(progress, 0.0, 0.7));
    if (!method) return method.error();
    auto results =
        (*method)->solve_each(answers_.sources, {.quality = false}, part_of(progress, 0.7, 1.0));
    if (!results) return results.error();
    std::vector<std::vector<double>> distances;
    for (DistanceResult& result : *results) distances.push_back(std::move(result.distances));
    const DistanceError error = joint_error(distances, better).figures;
    if (error.worst == kNoIndex || error.differently_reached > 0) {
      return Error{ErrorCode::kNumericalFailure, "not the same vertices are reached"};
    }
    return error;
  }

  TriedSetting keep(const std::string& option, const std::string& value, const DistanceError& error,
                    MethodKind against) {
    return found.tried.emplace_back(
        TriedSetting{option, value, error.mean_relative, error.max_of_range, against});
  }

  static Result<void> unless_cancelled(const Error& error) {
    if (error.code == ErrorCode::kCancelled) return error;
    return {};
  }

  MakeMethod make_;
  std::shared_ptr<const TriangleMesh> mesh_;
  const CheckedAnswers& answers_;
  MethodKind reference_;
  std::span<const std::vector<double>> better_;
  DistanceError before_;
  double left_;
  bool exact_answers_;  ///< the method exact has answered on this mesh
};

/// Options of the heat method, until one is the remedy.
Result<void> try_candidates(CauseSearch& search, std::span<const Candidate> candidates,
                            const Progress& progress) {
  const auto count = static_cast<double>(candidates.size());
  double done = 0;
  for (const Candidate& candidate : candidates) {
    const double next = done + 1 / count;
    const double share = candidate.because.empty() ? kWorthOther : 1;
    const auto tried = search.try_option(candidate, share, part_of(progress, done, next));
    if (!tried || search.found.remedy) return tried;
    done = next;
  }
  return {};
}

Result<void> try_heat_options(CauseSearch& search, const TriangleMesh& mesh,
                              const CheckedAnswers& answers, double most_faces,
                              const Progress& progress) {
  double faces = mesh.face_count();
  for (int i = 0; i < answers.options.refine; ++i) faces *= 4;
  const HeatMethod* const heat = answers.method.heat();
  auto candidates = heat_candidates(answers.options, inspect_mesh(mesh), heat->relative_t());
  std::erase_if(candidates, [&](const auto& each) { return faces * each.faces > most_faces; });
  auto tried = try_candidates(search, candidates, part_of(progress, 0.0, kOptionsDone));
  if (!tried || search.found.remedy) return tried;
  const Candidate refined = refined_candidate(answers.options);
  if (faces * refined.faces > most_faces) return {};
  tried = search.try_option(refined, kWorthFaces, part_of(progress, kOptionsDone, kFacesDone));
  // Only where a finer mesh makes the answer good, the mesh is what was wrong.
  if (!search.found.remedy && search.found.cause && search.found.cause->option == refined.option) {
    search.found.cause->because.clear();
  }
  return tried;
}

}  // namespace

SettingHint setting_of(const TriedSetting& tried) { return {tried.option, {tried.value}}; }

Result<Diagnosis> diagnose(const std::shared_ptr<const TriangleMesh>& mesh,
                           const CheckedAnswers& answers, MethodKind reference,
                           std::span<const std::vector<double>> better, Index most_faces,
                           const Progress& progress) try {
  const MakeMethod make =
      [&](const MethodOptions& options,
          const Progress& part) -> Result<std::shared_ptr<const DistanceMethod>> {
    if (options.method == MethodKind::kHeat) {
      return build_method_sharing(mesh, options, &answers.method, part);
    }
    auto triangulation = triangulation_for_waves(answers.method);
    if (!triangulation || !walks_on_inserted(options.method)) {
      return build_method(mesh, options, part);
    }
    auto waves = build_wave_surface(std::move(triangulation), part);
    if (!waves) return waves.error();
    return build_method(mesh, options, part, *std::move(waves));
  };
  CauseSearch search(make, mesh, answers, reference, better);
  if (badness(joint_error(answers.distances, better).figures) == 0) return Diagnosis{};
  if (answers.method.heat() != nullptr) {
    const auto tried = try_heat_options(search, *mesh, answers, most_faces, progress);
    if (!tried) return tried.error();
  }
  if (!search.found.remedy) {
    if (auto tried = search.try_methods(part_of(progress, kFacesDone, 1.0)); !tried) {
      return tried.error();
    }
  }
  return std::move(search.found);
} catch (const std::bad_alloc&) {
  return Error{ErrorCode::kOutOfMemory,
               "the memory ended in the search for settings that are right",
               {"take a mesh with fewer faces"}};
}

Result<Diagnosis> diagnose_space(const MakeMethod& make, const CheckedAnswers& answers,
                                 const ReferenceAnswers& better,
                                 std::span<const Candidate> candidates, const Progress& progress) {
  CauseSearch search(make, nullptr, answers, better.method, better.distances);
  if (auto tried = try_candidates(search, candidates, progress); !tried) return tried.error();
  if (!search.found.remedy) search.take_reference();
  return std::move(search.found);
}

}  // namespace geotherm
