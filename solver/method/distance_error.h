// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "solver/core/types.h"
#include "solver/method/method_kind.h"

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

/// Precondition: the same size. Cost: O(V).
DistanceError distance_error(std::span<const double> d, std::span<const double> e);

/// The same over several source sets: the mean of the mean errors, the largest of the largest.
struct JointError {
  DistanceError figures;
  std::size_t worst_set = 0;  ///< of DistanceError::worst
};
/// Preconditions: as many of both, the same size in each pair.
JointError joint_error(std::span<const std::vector<double>> d,
                       std::span<const std::vector<double>> e);

/// How right an answer is, in a word.
enum class Grade { kNearExact, kGood, kFair, kPoor };

/// Bounds of the mean relative error up to which an answer is near exact, good and fair, and of the
/// largest error, as a share of the largest distance, above which it is poor whatever its mean: a
/// few grossly wrong vertices do not show in that. An error of 5 % is poor even where the reference
/// hides half a per cent of it.
inline constexpr double kNearExactError = 1e-3, kGoodError = 0.02, kFairError = 0.05;
inline constexpr double kMaxOfRange = 0.045;

/// kPoor as well where one of both reaches vertices that the other does not.
Grade grade_of(const DistanceError& error);

/// How far an answer is from being good: at most 1 where it is. The larger of the mean error over
/// kGoodError and the largest over kMaxOfRange.
double badness(const DistanceError& error);

/// near exact | good | fair | poor
std::string to_text(Grade grade);

/// V: d - e, infinite where either is.
std::vector<double> signed_error(std::span<const double> d, std::span<const double> e);

/// How many values of a signed error lie in each of `bins` equal parts of [low, high].
struct ErrorHistogram {
  double low = 0, high = 0;
  std::vector<Index> count;
};
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

}  // namespace geotherm
