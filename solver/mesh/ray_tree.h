// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>

#include "geotherm/error.h"
#include "geotherm/mesh.h"
#include "geotherm/progress.h"
#include "geotherm/sources.h"

namespace geotherm {

/// Where a ray first meets the surface.
struct RayHit {
  SurfacePoint point;   ///< weights in a face, never a bare vertex
  double distance = 0;  ///< along the ray, in lengths of its direction
};

/// Answers which face a ray meets first: a tree of boxes over the faces (surface area heuristic
/// over binned centres: Wald 2007). Immutable; keeps the mesh alive; may be asked from several
/// threads at once.
class RayTree {
 public:
  /// Cost: O(F log F); about 42 bytes a face, 68 at most, and as much again meanwhile.
  /// Errors: kCancelled, kOutOfMemory.
  static Result<RayTree> build(std::shared_ptr<const TriangleMesh> mesh,
                               const Progress& progress = {});

  /// The same tree over a mesh with the same faces whose vertices are elsewhere: what one that is
  /// built afresh meets, but for round-off, and as fast while the surface has kept most of its
  /// shape. Null where this tree has left faces out, and where the mesh reaches far beyond the box
  /// of the first: then it has to be built. Precondition: check_moved(). Cost: a pass over the
  /// faces, and the boxes of those that have moved.
  std::optional<RayTree> moved(std::shared_ptr<const TriangleMesh> mesh) const;

  /// The nearest face in front of `origin` along `direction` (any length above 0, finite; model
  /// units), seen from either side; the lowest number among equals. Faces that repeat a corner or
  /// have no area are never met. The weights sum to 1 exactly. Nothing where the ray misses, or is
  /// none (a number that is not finite, a direction of 0).
  /// Watertight: a ray between two faces that share an edge meets one of them. Cost: O(log F) on
  /// ordinary meshes. Source: Woop, Benthin, Wald 2013.
  std::optional<RayHit> first_hit(const Vec3& origin, const Vec3& direction) const;

 private:
  struct State;
  explicit RayTree(std::shared_ptr<const State> state) : state_(std::move(state)) {}
  std::shared_ptr<const State> state_;
};

}  // namespace geotherm
