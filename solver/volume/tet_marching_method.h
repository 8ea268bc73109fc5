// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "geotherm/distance_method.h"
#include "geotherm/domains.h"

namespace geotherm {

/// Fast marching in a volume (TetFastMarching) as a DistanceMethod: what heat is held against
/// there. Sources are vertices and points of tets, with offsets; nearest sources are known. Errors:
/// those of TetFastMarching::build().
Result<std::shared_ptr<const DistanceMethod>> build_tet_marching(
    std::shared_ptr<const TetMesh> mesh, int threads, const Progress& progress = {});

}  // namespace geotherm
