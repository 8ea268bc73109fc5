// SPDX-License-Identifier: MIT
#pragma once

#include <span>
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

/// Whether a is by its kind more accurate than b: heat and fast marching, wavefront,
/// wavefront-fine, exact.
bool is_better(MethodKind a, MethodKind b);

}  // namespace geotherm
