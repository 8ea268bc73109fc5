// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "geotherm/polyhedral_methods.h"
#include "solver/geometry/intrinsic_surface.h"

namespace geotherm {

/// The intrinsic Delaunay triangulation with its edges, whatever number of faces they have: what
/// waves, fast marching and windows walk over. Immutable; one serves all of them.
struct WaveSurface {
  explicit WaveSurface(std::shared_ptr<const IntrinsicSurface> triangulation)
      : shared(std::move(triangulation)), base(*shared) {}
  WaveSurface(const WaveSurface&) = delete;
  WaveSurface& operator=(const WaveSurface&) = delete;

  std::shared_ptr<const IntrinsicSurface> shared;  ///< a heat method may use it as well
  const IntrinsicSurface& base;                    ///< the same
  std::vector<Index> edge_of_side;                 ///< 3F: number of the edge
  std::vector<std::size_t> side_start;             ///< E + 1
  std::vector<Side> sides;  ///< of edge e: side_start[e] to side_start[e + 1]; 1 is border, 3 and
                            ///< more a non-manifold edge. Two sides may run opposite ways or not.

  Index edge_count() const { return static_cast<Index>(side_start.size()) - 1; }
  std::span<const Side> sides_of(Index edge) const {
    return {sides.data() + side_start[edge], sides.data() + side_start[edge + 1]};
  }
  Index face_count() const { return base.intrinsic.face_count(); }
};

/// build_wave_surface() on a triangulation that is there. Precondition: it is Delaunay. What is to
/// be held against distances on the mesh is no cover, and only waves walk over inserted vertices.
/// Errors: kOutOfMemory, kCancelled. Cost: O(F).
Result<std::shared_ptr<const WaveSurface>> build_wave_surface(
    std::shared_ptr<const IntrinsicSurface> triangulation, const Progress& progress = {});

/// `stage`: what the memory ended in.
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

}  // namespace geotherm
