// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "geotherm/polyhedral_methods.h"
#include "solver/core/memory.h"
#include "solver/geometry/intrinsic_mesh.h"
#include "solver/geometry/intrinsic_surface.h"

namespace geotherm {

/// The edges of a triangulation, whatever number of faces they have.
struct WaveEdges {
  std::vector<Index> of_side;                   ///< 3F: number of the edge
  std::vector<std::uint32_t> side_start = {0};  ///< E + 1
  RawVector<Side> sides;  ///< of edge e: side_start[e] to side_start[e + 1]; 1 is boundary, 3 and
                          ///< more a non-manifold edge. Two sides may run opposite ways or not.
};

/// The intrinsic Delaunay triangulation with its edges, whatever number of faces they have: what
/// waves, fast marching and windows walk over. Immutable; one serves all of them. It adds edges to
/// an IntrinsicSurface as Surface (heat/) adds matrices to one, and shares it with that where it
/// can; PathSurface (path/) is of the file's own faces instead.
struct WaveSurface {
  explicit WaveSurface(std::shared_ptr<const IntrinsicSurface> triangulation)
      : shared(std::move(triangulation)), base(*shared) {}
  WaveSurface(const WaveSurface&) = delete;
  WaveSurface& operator=(const WaveSurface&) = delete;

  std::shared_ptr<const IntrinsicSurface> shared;  ///< a heat method may use it as well
  const IntrinsicSurface& base;                    ///< the same

  /// Listed when they are first asked for: tables of a surface that has moved do without. Throws
  /// std::bad_alloc.
  const WaveEdges& edges() const;
  Index edge_count() const { return static_cast<Index>(edges().side_start.size()) - 1; }
  Index edge_of_side(Side side) const { return edges().of_side[side]; }
  std::span<const Side> sides_of(Index edge) const {
    const auto& start = edges().side_start;
    return {edges().sides.data() + start[edge], edges().sides.data() + start[edge + 1]};
  }
  Index face_count() const { return base.intrinsic.face_count(); }

 private:
  mutable std::once_flag listed_;
  mutable WaveEdges edges_;
};

/// build_wave_surface() with or without inserted vertices, which only wavefronts walk over.
Result<std::shared_ptr<const WaveSurface>> build_wave_surface(
    std::shared_ptr<const TriangleMesh> mesh, RefineRule refine, const Progress& progress = {},
    int threads = 1, const WaveSurface* earlier = nullptr);

/// The surface, triangulated again where vertices were inserted. Errors: those of
/// build_wave_surface().
Result<std::shared_ptr<const WaveSurface>> without_inserted(
    std::shared_ptr<const WaveSurface> surface, int threads, const Progress& progress);

/// build_wave_surface() on a given triangulation. Preconditions: it is Delaunay and, where
/// distances are compared with those on the mesh, no tufted cover. Errors: kOutOfMemory,
/// kCancelled. Cost: O(F).
Result<std::shared_ptr<const WaveSurface>> build_wave_surface(
    std::shared_ptr<const IntrinsicSurface> triangulation, const Progress& progress = {});

/// The error when memory ran out in `stage`.
Error wave_out_of_memory(const char* stage, Index faces);

/// A source set as the triangulation sees it. Lengths and places in units of `intrinsic`.
struct SourceSeeds {
  struct Vertex {
    Index vertex;
    double offset;
    Index group;  ///< source_groups()
  };
  /// A point (both ends the same) or a straight piece of a curve inside one face or along its
  /// sides, in the face's layout (lay_out()). What lies on a side stands in every face at that
  /// edge.
  struct Piece {
    Index face;
    Eigen::Vector2d from, to;
    double offset;
    Index group;
  };
  std::vector<Vertex> vertices;  ///< points at vertices, and all ends of curve edges; each once
  std::vector<Piece> pieces;
};

/// Errors: those of check_sources().
Result<SourceSeeds> seed_sources(const WaveSurface& surface, const SourceSet& sources);

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
