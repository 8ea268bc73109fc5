// SPDX-License-Identifier: MIT
#pragma once

#include "solver/heat/diffuse.h"
#include "solver/heat/source_anchors.h"
#include "solver/heat/unit_field.h"
#include "solver/method/distance_bounds.h"

namespace geotherm {

/// |M u - b| / |b| over free rows: how well the heat step was solved. Column c; unit 1.
double heat_residual(const FemOperator& matrix, const HeatField& heat, const Block& b,
                     Eigen::Index column);

/// |L phi - b| / |b| over the rows that are not anchors; `phi` in elimination order, any shift.
/// The same bits with any number of threads.
double poisson_residual(const OperatorMesh& mesh, std::span<const double> phi, const Block& b,
                        Eigen::Index column, const SourceAnchors& anchors, bool skip_anchors,
                        int threads);

/// Faces in the components that hold a source, and those of them where the heat has no direction,
/// whether or not it could have one.
struct FaceCounts {
  Index in_reach = 0, without_direction = 0;
};

/// What the faces say: mean of | |grad phi| - 1 | by area, and lost gradients of u, over the
/// components that hold a source. `phi` in units of the intrinsic mesh. Faces whose corners are all
/// anchors or `held_at_zero` (a flag per row, or empty) have no gradient to lose. Edges too steep
/// for `steep` are counted, those that have a twin in `twin` (3F of the intrinsic mesh) by halves.
/// The same bits with any number of threads.
FaceCounts inspect_faces(const OperatorMesh& mesh, std::span<const Side> twin,
                         const SteepSides& steep, const UnitField& field,
                         std::span<const double> phi, Eigen::Index column,
                         const SourceAnchors& anchors, std::span<const char> held_at_zero,
                         int threads, Quality& quality);

}  // namespace geotherm
