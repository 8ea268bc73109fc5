// SPDX-License-Identifier: MIT
#pragma once

#include "geotherm/mesh.h"

namespace geotherm {

/// Cracks of a surface: edges of its boundary that lie on each other, or a small share of the mean
/// edge apart, and what weld() would do about them.
struct CrackReport {
  Index vertices = 0;      ///< that would be merged, WeldedMesh::merged; 0: there are no cracks
  double distance = 0;     ///< that merges them, model units, one digit; 0: they are equal
  Index border_edges = 0;  ///< edges with one face
  Index closed_edges = 0;  ///< those of them that would have two faces or more
};

/// A distance up to a hundredth of the mean edge is tried, the smallest that closes the most
/// counts; one that makes a face collapse does not, but for faces that have two corners at one
/// place already. Cost: four times weld() and clean_faces().
CrackReport find_cracks(const TriangleMesh& mesh);

}  // namespace geotherm
