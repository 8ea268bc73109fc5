// SPDX-License-Identifier: MIT
#pragma once

#include "geotherm/mesh_report.h"
#include "geotherm/options.h"

namespace geotherm {

/// What LaplacianKind::kAuto becomes on a mesh.
inline LaplacianKind auto_kind(const MeshReport& mesh) {
  if (mesh.refinement.points > 0) return LaplacianKind::kRefined;
  if (mesh.tufted_components > 0) return LaplacianKind::kTufted;
  return mesh.non_delaunay_edges > 0 ? LaplacianKind::kIntrinsicDelaunay : LaplacianKind::kCotan;
}

}  // namespace geotherm
