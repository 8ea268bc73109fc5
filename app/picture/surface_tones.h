// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "app/picture/line_sight.h"
#include "geotherm/error.h"
#include "geotherm/mesh.h"
#include "geotherm/progress.h"
#include "solver/mesh/ray_tree.h"

namespace geotherm::app {

/// Regions of a picture in which the surface is at least so bright; the rule is even-odd.
struct Tone {
  double brightness;  ///< 0 to 1; 0 is all of the surface
  std::vector<Outline> outlines;
};

/// The shape of a surface in a few tones, each inside the one before: its brightness under a light
/// beside the eye is sampled on a grid of pixels and contoured. The outline against the background
/// is found to a fraction of a pixel. Errors: kCancelled.
Result<std::vector<Tone>> surface_tones(const TriangleMesh& mesh, const RayTree& tree,
                                        const LineView& view, int width, int height,
                                        const Progress& progress);

}  // namespace geotherm::app
