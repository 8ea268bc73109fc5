// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "geotherm/directions.h"
#include "solver/directions/tangent_fans.h"
#include "solver/path/path_surface.h"
#include "solver/polyhedral/propagation.h"
#include "solver/polyhedral/wave_tables.h"
#include "solver/polyhedral/window_mesh.h"

namespace geotherm {

/// The angle of a vector in a layout, and a place there by its weights.
inline double angle_of(const Eigen::Vector2d& v) { return std::atan2(v.y(), v.x()); }
inline Eigen::Vector2d place_of(const std::array<Eigen::Vector2d, 3>& at,
                                const std::array<double, 3>& w) {
  return w[0] * at[0] + w[1] * at[1] + w[2] * at[2];
}

inline Error directions_out_of_memory(Index faces) {
  return {ErrorCode::kOutOfMemory,
          "the memory ended in directions on " + std::to_string(faces) + " faces",
          {"take a mesh with fewer faces"}};
}

/// The faces of the mesh without flips, so that what is straight in them is so on the mesh; both
/// surfaces number clean faces alike.
struct Directions::State {
  State(std::shared_ptr<const TriangleMesh> mesh, std::shared_ptr<const WaveSurface> waves)
      : paths(std::move(mesh)), surface(std::move(waves)), windows(*surface), fans(*surface) {}

  PathSurface paths;
  std::shared_ptr<const WaveSurface> surface;
  WindowMesh windows;
  TangentFans fans;
  mutable std::once_flag tables_made;
  mutable std::unique_ptr<const WaveTables>
      tables;  ///< of waves, made when they are first asked for

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
