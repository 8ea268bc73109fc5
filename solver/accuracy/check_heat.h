// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "geotherm/distance_method.h"
#include "geotherm/error.h"
#include "geotherm/options.h"
#include "solver/accuracy/distance_bounds.h"
#include "solver/heat/diffuse.h"
#include "solver/heat/domain.h"
#include "solver/heat/source_anchors.h"
#include "solver/heat/unit_field.h"

namespace geotherm {

/// |M u - b| / |b| over free rows: how well the heat step was solved. Column c; unit 1.
double heat_residual(const DomainOperator& matrix, const HeatField& heat, const Block& b,
                     Eigen::Index column);

/// |L phi - b| / |b| over the rows that are not anchors; `phi` in elimination order, any shift.
/// The same bits with any number of threads.
double poisson_residual(const Domain& domain, std::span<const double> phi, const Block& b,
                        Eigen::Index column, const SourceAnchors& anchors, bool skip_anchors,
                        int threads);

/// What the faces say: mean of | |grad phi| - 1 | by area, and lost gradients of u, over the
/// components that hold a source. `phi` in units of the intrinsic mesh. Faces whose corners are all
/// anchors or `held_at_zero` (a flag per row, or empty) have no gradient to lose, and no slope
/// where phi is the same at all of them. Edges too steep
/// for `steep` are counted, those that have a twin in `twin` (3F of the intrinsic mesh) by halves.
/// `some`: a flag for each face that counts, or empty. The same bits with any number of threads.
CellCounts inspect_faces(const OperatorMesh& mesh, std::span<const Side> twin,
                         const SteepSides& steep, const FaceField& field,
                         std::span<const double> phi, Eigen::Index column,
                         const SourceAnchors& anchors, std::span<const char> held_at_zero,
                         int threads, Quality& quality, std::span<const char> some = {});

/// Whether a diffusion time, in squares of the mean edge, may be why a system could not be solved.
bool is_extreme_time(double unit_t);

/// A kNumericalFailure or kBudgetEnded of the heat step with what to do about the diffusion time
/// added, where that is extreme. `unit_t`: t in squares of the mean edge.
Error with_time_hint(Error error, double unit_t, TimeRule rule);

/// Appends to an answer what a person should know about its quality figures, which must be filled
/// in. `usual_heat_residual`: what the way in which the heat step was solved leaves by design;
/// `cell_names`: what cells are called in messages.
/// Errors: kNumericalFailure where residuals say that this is no answer at all.
Result<void> assess_heat(const HeatOptions& options, double unit_t, const CellCounts& cells,
                         DistanceResult& result, double usual_heat_residual = 0,
                         const char* cell_names = "faces");

}  // namespace geotherm
