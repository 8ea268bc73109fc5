// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "geotherm/sources.h"
#include "tests/support/shapes.h"

namespace geotherm::test {

/// Lengths of the shortest ways over faces that cross sides at one of `cuts` places, evenly spread,
/// or pass their ends: upper bounds of the distance, a few per mille above it with some ten cuts.
/// Knows corners and positions alone: nothing of edges, neighbours, orientation or area. Cost:
/// F cuts^2 log.
std::vector<double> way_lengths(const TriangleMesh& mesh, const std::vector<Face>& faces,
                                const SourceSet& sources, int cuts);

}  // namespace geotherm::test
