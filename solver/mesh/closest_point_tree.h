// SPDX-License-Identifier: MIT
#pragma once

#include "geotherm/error.h"
#include "geotherm/mesh.h"
#include "geotherm/progress.h"
#include "solver/mesh/box_tree.h"

namespace geotherm {

/// Answers closest_point() for many places by a tree of boxes over the faces: with the same bits.
/// Immutable; the mesh must outlive it.
class ClosestPointTree {
 public:
  /// Cost: O(F log F). Errors: kCancelled.
  static Result<ClosestPointTree> build(const TriangleMesh& mesh, const Progress& progress);

  /// As closest_point(). Cost: O(log F) near ordinary meshes, O(F) a million sizes away from them.
  Result<ClosestPoint> to(const Vec3& query) const;

 private:
  ClosestPointTree(const TriangleMesh& mesh, const BoxFrame& frame, BoxTree tree)
      : mesh_(&mesh), frame_(frame), tree_(std::move(tree)) {}

  const TriangleMesh* mesh_;
  BoxFrame frame_;
  BoxTree tree_;
};

}  // namespace geotherm
