// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "solver/core/progress.h"
#include "solver/heat/heat_options.h"
#include "solver/mesh/triangle_mesh.h"
#include "solver/method/distance_method.h"

namespace geotherm {

/// A method with its options.
struct MethodOptions {
  MethodKind method = MethodKind::kHeat;
  HeatOptions heat;  ///< of the heat method; `threads` is every method's

  bool operator==(const MethodOptions&) const = default;
};

/// Makes a mesh ready for a method. Cost: that of HeatMethod::build(), WavefrontMethod::build(), ...
/// Errors: theirs.
Result<std::shared_ptr<const DistanceMethod>> build_method(std::shared_ptr<const TriangleMesh> mesh,
                                                           const MethodOptions& options = {},
                                                           const Progress& progress = {});

}  // namespace geotherm
