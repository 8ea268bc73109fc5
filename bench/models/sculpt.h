// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "bench/models/draft_mesh.h"
#include "bench/models/sculpture.h"
#include "geotherm/error.h"
#include "geotherm/progress.h"

namespace geotherm::generate {

/// What sculpt() makes a mesh of: the solid for a given grid spacing, and a box around it.
struct SculptureModel {
  std::function<Sculpture(double spacing)> carve;
  Vec3 low, high;
  double area;  ///< of the surface, about: where the search for the spacing starts
};

/// A closed mesh of about `faces` faces of the solid: finds the grid's spacing that gives this many
/// (within 2 %, or the nearest of ten), extracts the surface, then evens out its triangles on it.
/// Error: kCancelled.
Result<DraftMesh> sculpt(const SculptureModel& model, Index faces, const Progress& progress);

}  // namespace geotherm::generate
