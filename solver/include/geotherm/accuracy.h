// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "geotherm/build_method.h"
#include "geotherm/io.h"
#include "geotherm/names.h"

// How wrong distances are, by a more accurate method, what would make them better, and where they
// are right.
namespace geotherm {

/// How far distances d are from better ones e, over the vertices where both are finite.
struct DistanceError {
  double mean_relative = 0;       ///< mean of |d - e| / e where e > 0
  double max_of_range = 0;        ///< largest |d - e|, divided by the largest e
  double mean_signed = 0;         ///< mean of d - e, model units
  double max = 0;                 ///< largest |d - e|, model units
  Index worst = kNoIndex;         ///< the vertex of that; kNoIndex: there is no such vertex
  Index differently_reached = 0;  ///< vertices that one of both reaches and the other does not
};

/// The error of distances d against better ones e. Precondition: the same size. Cost: O(V).
DistanceError distance_error(std::span<const double> d, std::span<const double> e);

/// How far distances are from better ones over several source sets.
struct JointError {
  DistanceError figures;      ///< mean of the means, largest of the largest
  std::size_t worst_set = 0;  ///< of DistanceError::worst
};
/// The error over all sets. Preconditions: as many of both, the same size in each pair.
JointError joint_error(std::span<const std::vector<double>> d,
                       std::span<const std::vector<double>> e);

/// How right an answer is, in a word.
enum class Grade { kNearExact, kGood, kFair, kPoor };
inline NamedValues<Grade> named_values(Grade) {
  using enum Grade;
  return {"there is no grade '*'",
          {{kNearExact, "near exact"}, {kGood, "good"}, {kFair, "fair"}, {kPoor, "poor"}}};
}

/// Bounds of the mean relative error up to which an answer is near exact, good and fair, and of the
/// largest error, as a share of the largest distance, above which it is poor whatever its mean: a
/// few grossly wrong vertices do not show in that. An error of 5 % is poor even where the reference
/// hides half a per cent of it.
inline constexpr double kNearExactError = 1e-3, kGoodError = 0.02, kFairError = 0.05;
inline constexpr double kMaxOfRange = 0.045;

/// The grade of an error by these bounds; it is kPoor as well where one of both reaches vertices
/// that the other does not.
Grade grade_of(const DistanceError& error);

/// How far an answer is from being good: at most 1 where it is. The larger of the mean error over
/// kGoodError and the largest over kMaxOfRange.
double badness(const DistanceError& error);

/// The differences d - e (V), infinite where either is.
std::vector<double> signed_error(std::span<const double> d, std::span<const double> e);

/// How many values of a signed error lie in each of `bins` equal parts of [low, high].
struct ErrorHistogram {
  double low = 0, high = 0;  ///< the ends, model units
  std::vector<Index> count;  ///< of each part
};
/// The histogram from the smallest to the largest value that is finite. Precondition: at least one
/// bin.
ErrorHistogram error_histogram(std::span<const double> signed_error, int bins);

/// The more accurate method that a mesh of so many faces can be held against within a few seconds:
/// the exact one, or wavefront-fine. `kind` itself, where there is none.
MethodKind reference_for(MethodKind kind, Index faces);

/// What distances are held against where nobody chose: those of heat and fast marching against
/// waves, which take about as long as one heat query; on up to 1,000 faces, where waves may be as
/// wrong, against exact ones, which take a few milliseconds there. `kind` itself, where it is near
/// exact.
MethodKind usual_reference(MethodKind kind, Index faces);

/// Whether a is by its kind more accurate than b: heat and fast marching, wavefront,
/// wavefront-fine, exact.
bool is_better(MethodKind a, MethodKind b);

/// The one option of the heat method to which most of an error is due.
struct ErrorCause {
  std::string option;   ///< the name of a setting: "time-factor"
  std::string value;    ///< what lowers the error: "1"
  std::string because;  ///< "t is too large (m = 100, sqrt(t) = 10 mean edges)"; empty: the value
                        ///< is none that is recommended everywhere
  double mean_relative_before = 0, mean_relative_after = 0;  ///< DistanceError::mean_relative
};

/// A setting that was solved with, and what it gave.
struct TriedSetting {
  std::string option, value;                    ///< of a setting: "method", "wavefront"
  double mean_relative = 0, max_of_range = 0;   ///< of DistanceError
  MethodKind against = MethodKind::kWavefront;  ///< what it was held against
};
/// A tried setting whose answer is good.
using Remedy = TriedSetting;

/// The setting and the value that were tried.
SettingHint setting_of(const TriedSetting& tried);

/// What diagnose() has found.
struct Diagnosis {
  std::optional<ErrorCause> cause;  ///< absent: no option of the heat method lowers the error much
  std::optional<Remedy> remedy;     ///< absent: all that could be tried failed
  std::vector<TriedSetting> tried;  ///< in order
};

/// Answers of a method, and what it was asked.
struct CheckedAnswers {
  const DistanceMethod& method;                    ///< that gave them
  const MethodOptions& options;                    ///< that the method was made with
  std::span<const SourceSet> sources;              ///< that it was asked for
  std::span<const std::vector<double>> distances;  ///< one for each source set, V each
};

/// How much work a search for a remedy takes on, as faces that are set up for one setting: a
/// setting that shares all but one factor counts for a third of the mesh, a cover for two, a
/// refined mesh for four. The first where it was asked for, the second where it was not.
inline constexpr Index kMaxFacesDiagnosed = 300'000;
inline constexpr Index kMaxFacesBesides = 100'000;

/// Exact distances take some tenths of a second up to here, so that other methods are held against
/// them, and they are offered where no other method is good.
inline constexpr Index kMaxFacesExact = 20'000;

/// What makes wrong answers right, by trying: solves again with one setting at a time changed, and
/// takes the first whose answer is good. In this order, and the cheapest of each kind first:
/// options of the heat method that are not what is recommended, set to that; other values of its
/// options (time factors 2 and 4, the variant classic, other rules where there is a boundary,
/// tufted covers, a finer mesh); the methods wavefront, wavefront-fine and, on up to kMaxFacesExact
/// faces or where it is the reference, exact. Where no option of the heat method makes it good, the
/// one that lowers the error most is the cause if it takes more than a fifth away, more faces only
/// if they leave less than half of what another one leaves. What fails is passed over. `better`:
/// distances of `reference` for the same sources. The method wavefront is held against exact
/// distances on small meshes, else against wavefront-fine, where it is itself the reference.
/// `most_faces`: kMaxFacesDiagnosed or kMaxFacesBesides. Errors: kCancelled, kOutOfMemory. Cost: a
/// set-up and queries for each setting tried, at most 16.
Result<Diagnosis> diagnose(const std::shared_ptr<const TriangleMesh>& mesh,
                           const CheckedAnswers& answers, MethodKind reference,
                           std::span<const std::vector<double>> better, Index most_faces,
                           const Progress& progress = {});

/// When other settings are tried (diagnose()).
enum class RemedySearch {
  kNever,
  kWherePoor,     ///< on meshes of up to kMaxFacesBesides faces
  kWhereNotGood,  ///< also where the answer is fair, and on larger meshes (kMaxFacesDiagnosed)
};

/// How check_accuracy() goes about it.
struct AccuracyOptions {
  /// What the distances are held against: reference_for() is the most accurate method that fits the
  /// mesh. None: usual_reference().
  std::optional<MethodKind> reference = std::nullopt;
  RemedySearch search = RemedySearch::kWherePoor;  ///< when other settings are tried
  int threads = 0;                                 ///< 0: all cores
};

/// Distances of a more accurate method from some source sets.
struct ReferenceAnswers {
  MethodKind method = MethodKind::kWavefront;  ///< that gave them
  std::vector<std::vector<double>> distances;  ///< of each set: V, model units
  double milliseconds = 0;                     ///< set-up and queries
};

/// How wrong distances are. Over several source sets the mean error is the mean of theirs, and the
/// largest is the largest of any.
struct AccuracyReport {
  MethodKind reference = MethodKind::kExact;  ///< the method itself: there is nothing better
  bool measured = false;                      ///< else only `reference` and `verdict` mean anything
  bool failed = false;                        ///< the check itself failed; the verdict says why
  DistanceError figures;                      ///< against the reference
  Grade grade = Grade::kPoor;                 ///< of the figures
  std::size_t worst_set = 0;                  ///< the source set of DistanceError::worst
  std::size_t sets = 1;                       ///< source sets that were solved for
  std::vector<double> values;  ///< of one set, V: d - d_reference; infinite where either is
  ErrorHistogram histogram;    ///< of the values
  std::string verdict;         ///< the grade and the figure that decides it, or why there is none
  std::string reason;          ///< what follows grade or verdict: " because ...", ": ..."
  Hint advice;                 ///< what helps
  double milliseconds = 0;     ///< that the reference took, set-up and queries
  std::optional<ErrorCause> cause;  ///< the one option to which most of the error is due
  std::optional<Remedy> remedy;     ///< a setting that was tried and is right
  std::vector<TriedSetting> tried;  ///< all that was tried, in order

  /// A grossly wrong answer, known to be one.
  bool is_poor() const { return measured && grade == Grade::kPoor; }
};

/// Solves by `kind`. `triangulation`: of the same mesh, to be shared where it can be
/// (triangulation_for_waves()); may be null. Errors: those of build_method() and its queries.
Result<ReferenceAnswers> solve_reference(
    const std::shared_ptr<const TriangleMesh>& mesh, MethodKind kind,
    std::span<const SourceSet> sources, int threads,
    std::shared_ptr<const IntrinsicSurface> triangulation = nullptr, const Progress& progress = {});

/// Solves by a method that is ready. Errors: those of its queries.
Result<ReferenceAnswers> solve_reference(const DistanceMethod& method,
                                         std::span<const SourceSet> sources,
                                         const Progress& progress = {});

/// Holds distances of `checked`, V for each source set, against better ones of the same sets.
/// Throws std::bad_alloc alone.
AccuracyReport hold_against(std::span<const std::vector<double>> distances, MethodKind checked,
                            const ReferenceAnswers& better);

/// Verdict, reason and advice, settings as in hint_text().
std::string sentence(const AccuracyReport& report, std::string_view before_name = {});

/// What is to be said where nothing better fits the mesh, or nothing was asked.
AccuracyReport unmeasured(MethodKind method, std::string verdict);

/// Looks for a setting that is right (diagnose()) as far as `search` allows, and puts it into the
/// report and its advice. Preconditions: hold_against() made the report from answer.distances and
/// `better`. Where the memory ends, none is found. Errors: kCancelled. Cost: that of diagnose().
Result<void> find_remedy(AccuracyReport& report, const std::shared_ptr<const TriangleMesh>& mesh,
                         const CheckedAnswers& answers, const ReferenceAnswers& better,
                         RemedySearch search, const Progress& progress = {});

/// All of the above: how wrong the answers of a method are. `answers`: what it gave for which
/// sources; the method and its options serve the search and are shared by it where they can be.
/// Where `options.reference` is no better than the method, nothing is measured. Errors: those of
/// the reference, kOutOfMemory; the distances themselves are untouched. Cost: a set-up of the
/// reference without its triangulation, and its queries; the search, where one is made.
Result<AccuracyReport> check_accuracy(const std::shared_ptr<const TriangleMesh>& mesh,
                                      const CheckedAnswers& answers,
                                      const AccuracyOptions& options = {},
                                      const Progress& progress = {});

/// A share as a percentage: "0.81 %".
std::string percent_text(double share);

// Where an answer is right: numbers on the vertices and faces of the mesh of the file.

/// What the numbers say.
enum class QualityField {
  kError,            ///< vertices: d - d_better, model units
  kEikonalError,     ///< faces: | |grad d| - 1 |, which is 0 for distances away from creases
  kGradientAngle,    ///< faces: degrees between X and grad d; heat method
  kLostGradients,    ///< faces: 1 where the heat has no direction though it gets there, else 0
  kTriangleQuality,  ///< faces: 4 sqrt(3) area / (sum of squared sides); 1: equilateral
  kNonDelaunay,      ///< faces: how many of their edges have a negative cotangent weight, 0 to 3
};
inline NamedValues<QualityField> named_values(QualityField) {
  using enum QualityField;
  return {"there is no field '*'",
          {{kError, "error"},
           {kEikonalError, "eikonal-error"},
           {kGradientAngle, "gradient-angle"},
           {kLostGradients, "lost-gradients"},
           {kTriangleQuality, "triangle-quality"},
           {kNonDelaunay, "non-delaunay"}}};
}

/// Whether a field is about u, which only answers of the heat method with QueryOptions::fields
/// have.
bool needs_heat(QualityField field);

/// Name, place and type of a field, without values.
DataField described(QualityField field);

/// One of the fields, in the order of the file. The values are infinite where there is none: on
/// faces without area or with a corner that is not reached (eikonal error, angle), and where one of
/// both directions is missing (angle). `error`: V, of signed_error(); used by kError alone.
/// Preconditions: `answer` belongs to the mesh, and has u where needs_heat(). Cost: O(F).
DataField quality_field(QualityField field, const TriangleMesh& mesh, const DistanceResult& answer,
                        std::span<const double> error = {});

/// X = -grad u / |grad u| on every face of the mesh (F), from ln u at its vertices (V; -inf: u is
/// 0). 0 where u is 0 at all corners or has no slope, and on faces without area. Cost: O(F).
/// Source: Crane, Weischedel, Wardetzky (2013), section 3.1.
std::vector<Vec3> heat_directions(const TriangleMesh& mesh, std::span<const double> log_heat);

/// The values of the field kEikonalError. `distances`: V.
std::vector<double> eikonal_errors(const TriangleMesh& mesh, std::span<const double> distances);
/// The values of the field kLostGradients. `distances`: V; `log_heat`: V, ln u.
std::vector<double> lost_gradients(const TriangleMesh& mesh, std::span<const double> distances,
                                   std::span<const double> log_heat);
/// The values of the field kTriangleQuality, which depend on the mesh alone.
std::vector<double> triangle_qualities(const TriangleMesh& mesh);
/// The values of the field kNonDelaunay, which depend on the mesh alone.
std::vector<double> non_delaunay_edges(const TriangleMesh& mesh);

/// The angle between two vectors of each face, degrees; infinite where either is 0. Exact for small
/// angles and for those near 180, too. Precondition: the same size. Source: W. Kahan (2006).
std::vector<double> angles_between(std::span<const Vec3> a, std::span<const Vec3> b);

}  // namespace geotherm
