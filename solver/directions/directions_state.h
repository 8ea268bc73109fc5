// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <utility>

#include "geotherm/directions.h"
#include "solver/directions/tangent_fans.h"
#include "solver/path/path_surface.h"
#include "solver/polyhedral/propagation.h"
#include "solver/polyhedral/window_mesh.h"

namespace geotherm {

/// The faces of the mesh without flips, so that what is straight in them is so on the mesh; both
/// surfaces number clean faces alike.
struct Directions::State {
  State(std::shared_ptr<const TriangleMesh> mesh, std::shared_ptr<const WaveSurface> waves)
      : paths(std::move(mesh)), surface(std::move(waves)), windows(*surface), fans(*surface) {}

  PathSurface paths;
  std::shared_ptr<const WaveSurface> surface;
  WindowMesh windows;
  TangentFans fans;

  /// The point as a vertex or in a clean face. Errors: not on the mesh, a vertex without frame.
  Result<SurfacePoint> point(const SurfacePoint& point) const;
  TangentFrame frame_at(const SurfacePoint& clean) const;

  /// A face's frame in its layout: the direction of angle a there is turn + a, or turn - a.
  StartDirections::Turn face_turn(Index clean_face) const;
  std::array<Eigen::Vector2d, 3> layout(Index face) const {
    return corners_of(surface->base.intrinsic.lengths[static_cast<std::size_t>(face)]);
  }
};

}  // namespace geotherm
