// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "solver/method/build_method.h"
#include "solver/method/distance_error.h"
#include "solver/quality/diagnose.h"

// How wrong distances are, by a more accurate method, and what would make them better.
namespace geotherm {

/// When other settings are tried (diagnose()).
enum class CureSearch {
  kNever,
  kWherePoor,     ///< on meshes of up to kMaxFacesBesides faces
  kWhereNotGood,  ///< also where the answer is fair, and on larger meshes (kMaxFacesDiagnosed)
};

struct AccuracyOptions {
  /// What the distances are held against: reference_for() is the most accurate method that fits the
  /// mesh. None: usual_reference().
  std::optional<MethodKind> reference = std::nullopt;
  CureSearch search = CureSearch::kWherePoor;
  int threads = 0;  ///< 0: all cores
};

/// Distances of a more accurate method from some source sets.
struct ReferenceAnswers {
  MethodKind method = MethodKind::kWavefront;
  std::vector<std::vector<double>> distances;  ///< of each set: V, model units
  double milliseconds = 0;                     ///< set-up and queries
};

/// How wrong distances are. Over several source sets the mean error is the mean of theirs, and the
/// largest is the largest of any.
struct AccuracyReport {
  MethodKind reference = MethodKind::kExact;  ///< the method itself: there is nothing better
  bool measured = false;                      ///< else only `reference` and `verdict` mean anything
  bool failed = false;                        ///< the check itself failed; the verdict says why
  DistanceError figures;
  Grade grade = Grade::kPoor;
  std::size_t worst_set = 0;   ///< the source set of DistanceError::worst
  std::size_t sets = 1;        ///< source sets that were solved for
  std::vector<double> values;  ///< of one set, V: d - d_reference; infinite where either is
  ErrorHistogram histogram;    ///< of the values
  std::string verdict;         ///< the grade and the figure that decides it, or why there is none
  Hint advice;                 ///< what follows it in a sentence: why, what helps
  double milliseconds = 0;     ///< that the reference took, set-up and queries
  std::optional<ErrorCause> cause;  ///< the one option to which most of the error is due
  std::optional<Cure> cure;         ///< a setting that was tried and is right
  std::vector<TriedSetting> tried;  ///< all that was tried, in order

  /// A grossly wrong answer, known to be one.
  bool is_poor() const { return measured && grade == Grade::kPoor; }
};

/// Solves by `kind`. `beside`: a method on the same mesh whose triangulation is shared where it can
/// be; may be null. Errors: those of build_method() and its queries.
Result<ReferenceAnswers> solve_reference(const std::shared_ptr<const TriangleMesh>& mesh,
                                         MethodKind kind, std::span<const SourceSet> sources,
                                         int threads, const DistanceMethod* beside = nullptr,
                                         const Progress& progress = {});

/// The same by a method that is ready.
Result<ReferenceAnswers> solve_reference(const DistanceMethod& method,
                                         std::span<const SourceSet> sources,
                                         const Progress& progress = {});

/// Holds distances of `checked`, V for each source set, against better ones of the same sets.
AccuracyReport hold_against(std::span<const std::vector<double>> distances, MethodKind checked,
                            const ReferenceAnswers& better);

/// The verdict and the advice, settings as in hint_text().
std::string sentence(const AccuracyReport& report, std::string_view before_name = {});

/// What is to be said where nothing better fits the mesh, or nothing was asked.
AccuracyReport unmeasured(MethodKind method, std::string verdict);

/// Looks for a setting that is right (diagnose()) as far as `search` allows, and puts it into the
/// report and its advice. Preconditions: hold_against() made the report from answer.distances and
/// `better`. Errors: kCancelled. Cost: that of diagnose().
Result<void> find_cure(AccuracyReport& report, const std::shared_ptr<const TriangleMesh>& mesh,
                       const CheckedAnswers& answers, const ReferenceAnswers& better,
                       CureSearch search, const Progress& progress = {});

/// All of the above: how wrong the answers of a method are. `answers`: what it gave for which
/// sources; the method and its options serve the search and are shared by it where they can be.
/// Where `options.reference` is no better than the method, nothing is measured. Errors: those of
/// the reference; the distances themselves are untouched. Cost: a set-up of the reference without
/// its triangulation, and its queries; the search, where one is made.
///
///     auto method = build_method(mesh, options);
///     auto answer = (*method)->solve(sources);
///     auto report = check_accuracy(mesh, {**method, options, {&sources, 1},
///                                         {&answer->distances, 1}});
///     if (report && report->is_poor()) warn(sentence(*report));
Result<AccuracyReport> check_accuracy(const std::shared_ptr<const TriangleMesh>& mesh,
                                      const CheckedAnswers& answers,
                                      const AccuracyOptions& options = {},
                                      const Progress& progress = {});

/// "0.81 %".
std::string percent_text(double share);

}  // namespace geotherm
