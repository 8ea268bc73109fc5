// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "geotherm/build_method.h"
#include "geotherm/sources.h"
#include "tests/fuzz/fuzz_targets.h"

namespace geotherm::test {

/// Which vertices are made one before anything is solved.
enum class Welding {
  kNone,
  kEqual,   ///< those at one place
  kCracks,  ///< those that close the cracks found
  kCoarse,  ///< those a quarter of the bounding box's diagonal apart: faces collapse
};

/// What arbitrary bytes ask of the solver.
struct FuzzCase {
  std::shared_ptr<const TriangleMesh> mesh;  ///< null: too few bytes for one
  MethodOptions options;                     ///< of any method
  Welding welding = Welding::kNone;
  SourceSet sources;  ///< may be wrong
};

/// Up to 40 vertices on a coarse grid, which makes degenerate and coinciding faces likely, or
/// anywhere, at any scale and place; up to 80 faces of any corners. Every text of bytes is a case.
FuzzCase decode_case(Bytes bytes);

}  // namespace geotherm::test
