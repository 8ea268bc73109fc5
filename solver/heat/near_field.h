// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "solver/heat/source_anchors.h"

namespace geotherm {

/// A vertex beside a source, where the near-exact distance stands in for some of heat's.
struct NearVertex {
  Index row;
  double distance;  ///< near-exact, in units of the intrinsic mesh
  double share;     ///< of heat's distance in the answer: 0 beside the source, below 1
};

/// What is known around the sources without heat: a wave (docs/numerics.md, "Wavefront") walks over
/// the faces nearest to them. Its distances count alone up to half as far as it is sure of them, at
/// most half of eight times the length that the triangulation resolves, and fade into heat's from
/// there on. Errors: kOutOfMemory.
/// Cost: that of two waves over some hundreds of faces; for many sources, over those at the sources
/// or a tenth of all.
Result<std::vector<NearVertex>> find_near_field(const Surface& surface,
                                                const SourceAnchors& anchors);

}  // namespace geotherm
