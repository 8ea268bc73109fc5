// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "geotherm/error.h"
#include "geotherm/mesh.h"
#include "geotherm/sources.h"
#include "solver/geometry/clean_faces.h"
#include "solver/mesh/connectivity.h"

namespace geotherm {

/// A mesh made ready for paths, which run over the faces of the file rather than over an intrinsic
/// triangulation as IntrinsicSurface has it: its clean faces, which faces meet at an edge or a
/// vertex (any number of them), and positions about the origin in units of order 1. Faces and
/// points are numbered as clean_faces() leaves them; into() and out_of() lead from and to those of
/// the file. Immutable. Cost: O(F).
class PathSurface {
 public:
  explicit PathSurface(std::shared_ptr<const TriangleMesh> mesh);
  PathSurface(const PathSurface&) = delete;  // the edge graph sees the positions
  PathSurface& operator=(const PathSurface&) = delete;

  const std::shared_ptr<const TriangleMesh>& mesh() const { return mesh_; }
  std::span<const Face> faces() const { return clean_.faces; }
  const Face& face(Index f) const { return clean_.faces[static_cast<std::size_t>(f)]; }
  const EdgeTable& edges() const { return clean_.edges; }
  Index edge_at(Side side) const { return edge_at_[static_cast<std::size_t>(side)]; }
  const EdgeGraph& edge_graph() const { return edge_graph_; }

  /// The corners that a vertex has: corner k of face f is 3 f + k. None: it is in no clean face.
  std::span<const Index> corners_at(Index v) const { return clean_.corners.at(v); }

  /// (model position - middle) / unit.
  const Vec3& position(Index v) const { return positions_[static_cast<std::size_t>(v)]; }
  Vec3 position(const SurfacePoint& point) const;
  double unit() const { return unit_; }

  /// A point of the file: a bare vertex where it is one, else in a clean face with weights that sum
  /// to 1. Errors: kBadInput (out of range, weights that are negative or do not sum to 1 by more
  /// than 1e-6, as of sources; a vertex or an edge in no clean face).
  Result<SurfacePoint> into(const SurfacePoint& point) const;
  SurfacePoint out_of(const SurfacePoint& point) const;
  Index file_face(Index f) const { return clean_.original[static_cast<std::size_t>(f)]; }

  /// The same point with weights in `face`, if this holds it; a vertex stays as it is.
  std::optional<SurfacePoint> express(const SurfacePoint& point, Index face) const;

  /// The faces that hold the point: one inside a face, those of an edge or a vertex.
  std::vector<Index> faces_at(const SurfacePoint& point) const;

  /// The corner of the face that is the vertex, -1 where none is.
  int corner_of_vertex(Index face, Index vertex) const;

  /// Radians, 0 to pi.
  double corner_angle(Index face, int corner) const;

  /// The edge that two faces share, kNoIndex where they share none.
  Index shared_edge(Index f, Index g) const;

 private:
  Result<SurfacePoint> at_weighted_vertices(const Face& vertices,
                                            const std::array<double, 3>& weights) const;

  std::shared_ptr<const TriangleMesh> mesh_;
  CleanFaces clean_;
  std::vector<Index> clean_face_;  // of each face of the file
  std::vector<Index> edge_at_;     // of each side
  double unit_ = 1;
  std::vector<Vec3> positions_;
  EdgeGraph edge_graph_;
};

}  // namespace geotherm
