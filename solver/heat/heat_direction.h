// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "solver/geometry/face_gradient.h"

namespace geotherm {

/// X = -grad u / |grad u| on every face of the mesh (F), from ln u at its vertices (V; -inf: u is
/// 0). 0 where u is 0 at all corners or has no slope, and on faces without area. Cost: O(F).
/// Source: Crane, Weischedel, Wardetzky (2013), section 3.1.
std::vector<Vec3> heat_directions(const TriangleMesh& mesh, std::span<const double> log_heat);

}  // namespace geotherm
