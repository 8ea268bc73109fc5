// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include "geotherm/path.h"
#include "tests/support/shapes.h"

namespace geotherm::test {

/// A finder with the method, which must be possible to build.
PathFinder finder_on(const MeshPtr& mesh, MethodKind kind = MethodKind::kWavefront);

/// A path that must be possible to find.
SurfacePath found(const PathFinder& finder, const std::vector<SurfacePoint>& points,
                  const PathOptions& options = {});
SurfacePath found(const PathFinder& finder, Index from, Index to, const PathOptions& options = {});

/// Whether the path is one: every piece in its face, none of length 0, its length that of the
/// pieces, no number that is not finite.
testing::AssertionResult is_path(const TriangleMesh& mesh, const SurfacePath& path);

inline SurfacePoint vertex(Index v) { return SurfacePoint::at_vertex(v); }

}  // namespace geotherm::test
