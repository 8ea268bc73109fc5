// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>

#include "solver/geometry/intrinsic_mesh.h"
#include "solver/wave/wave_surface.h"

namespace geotherm {

/// Corners of a face in its layout.
inline std::array<Eigen::Vector2d, 3> corners_of(const FaceLayout& p) {
  return {Eigen::Vector2d(0, 0), Eigen::Vector2d(p.base, 0), Eigen::Vector2d(p.x, p.height)};
}

/// Straight distance within a face to a piece of a source, without its offset.
inline double distance_to(const SourceSeeds::Piece& piece, const Eigen::Vector2d& p) {
  const Eigen::Vector2d along = piece.to - piece.from;
  const double square = along.squaredNorm();
  const double t = square > 0 ? std::clamp((p - piece.from).dot(along) / square, 0.0, 1.0) : 0.0;
  return (p - piece.from - t * along).norm();
}

/// The least offset of all seeds: measured from it, distances keep their digits.
inline double least_offset(const SourceSeeds& seeds) {
  double least = kUnreached;
  for (const auto& vertex : seeds.vertices) least = std::min(least, vertex.offset);
  for (const auto& piece : seeds.pieces) least = std::min(least, piece.offset);
  return least;
}

}  // namespace geotherm
