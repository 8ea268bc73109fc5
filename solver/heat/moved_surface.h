// SPDX-License-Identifier: MIT
#pragma once

#include "solver/core/stopwatch.h"
#include "solver/heat/surface.h"

// What build_surface() does where it is given the surface before it moved.
namespace geotherm {

/// Whether most vertices are where they were: then lengths keep their unit, and with it their bits.
bool moved_little(const IntrinsicSurface& earlier, const TriangleMesh& mesh);

/// Order, analysis and operators from those of an earlier surface. False where they do not serve.
/// `little`: little has moved, in the same units; what has not changed is copied.
bool keep_order(const Surface& earlier, bool little, int threads, Stopwatch& watch, Surface& out);

}  // namespace geotherm
