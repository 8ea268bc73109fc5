// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "geotherm/distance_method.h"
#include "solver/heat/diffuse.h"
#include "solver/heat/poisson.h"
#include "solver/heat/source_anchors.h"

namespace geotherm {

/// Whether what is known without heat comes into the answer: near fields and straight lines. The
/// variant classic is the method as published, and the penalty mode shows what it does at sources.
inline bool uses_what_is_known(const HeatOptions& options) {
  return options.variant != Variant::kClassic &&
         options.constraint.mode != ConstraintMode::kPenalty;
}

/// Makes distances of a Poisson answer (n x K, elimination order, units of the domain), one
/// source set a column. Under kPinSources the anchors have their value exactly; otherwise each
/// component is shifted so that phi agrees with the anchors in the mean: `answer.shift` says by how
/// much then. Distances below 0 become 0 and are counted where that is more than round-off; then
/// those of `near` (Domain::near_field() of each set; or empty) come in. Fills `distances` (file
/// order, model units, kUnreached elsewhere), `max_source_distance` and `clamped_vertices` of the
/// results. Errors: kNumericalFailure when a value is not finite. Cost: one pass over the vertices.
Result<void> normalize(const Domain& domain, PoissonAnswer& answer,
                       std::span<const SourceAnchors> anchors,
                       std::span<const std::vector<NearVertex>> near, ConstraintMode mode,
                       int threads, std::span<DistanceResult> results);

/// What may help where the Poisson step gave what is no answer.
Hint no_answer_hint(ConstraintMode mode);

/// phi of one column after normalize(), as the distances have it but for the clamping.
std::vector<double> shifted_phi(const Domain& domain, const PoissonAnswer& answer,
                                const SourceAnchors& anchors, ConstraintMode mode,
                                Eigen::Index column);

/// u of one column, file order, scaled so that the largest value is 1; 0 where out of range.
std::vector<double> heat_in_file_order(const Domain& domain, const HeatField& heat,
                                       Eigen::Index column);

/// The natural logarithm of the same, of any level; -inf where u is 0 or below.
std::vector<double> log_heat_in_file_order(const Domain& domain, const HeatField& heat,
                                           Eigen::Index column);

}  // namespace geotherm
