// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "geotherm/error.h"
#include "geotherm/types.h"

// A triangle mesh, points on it, and meshes made of it. V is its number of vertices, F of faces;
// both are numbered from 0 in the order of the file or of the arrays given.
namespace geotherm {

struct FaceSegment;

/// An immutable triangle mesh, exactly as its file or generator gave it.
///
/// Positions: V x 3, finite, model units. Faces: F x 3, every corner in [0, V). Nothing else is
/// promised: faces may repeat a corner, have no area, disagree in orientation, share an edge three
/// times; vertices may belong to no face. What is made of that is each
/// method's business.
class TriangleMesh {
 public:
  /// Takes the arrays. Errors: no faces, a corner out of range, a coordinate that is not finite
  /// (each with its number). Cost: one pass over both arrays.
  static Result<TriangleMesh> build(std::vector<Vec3> positions, std::vector<Face> faces);

  /// One some of whose vertices are one (weld()). `same_as`: V; the lowest vertex that each is one
  /// with, itself where there is none lower. Corners become those. Errors: those of build(), a
  /// table that is none (with its vertex).
  static Result<TriangleMesh> build(std::vector<Vec3> positions, std::vector<Face> faces,
                                    std::vector<Index> same_as);

  /// The same faces, which both meshes share, with the vertices elsewhere: a surface that moves.
  /// Errors: another number of positions, a coordinate that is not finite (with its vertex). Cost:
  /// one pass over the positions.
  Result<TriangleMesh> moved(std::vector<Vec3> positions) const;

  /// V and F, as they were given, and how many there are.
  std::span<const Vec3> positions() const { return positions_; }
  std::span<const Face> faces() const { return *faces_; }
  Index vertex_count() const { return static_cast<Index>(positions_.size()); }
  Index face_count() const { return static_cast<Index>(faces_->size()); }

  /// V: the vertex that stands for each in all faces; empty where each stands for itself. Those
  /// that another stands for belong to no face, and have its distance.
  std::span<const Index> same_as() const { return same_as_; }

  /// The vertex that stands for v. Precondition: v in [0, V).
  Index standing_for(Index v) const {
    return same_as_.empty() ? v : same_as_[static_cast<std::size_t>(v)];
  }

 private:
  TriangleMesh(std::vector<Vec3> positions, std::vector<Face> faces)
      : positions_(std::move(positions)),
        faces_(std::make_shared<const std::vector<Face>>(std::move(faces))) {}

  std::vector<Vec3> positions_;
  std::shared_ptr<const std::vector<Face>> faces_;  ///< one copy for all that moved() made
  std::vector<Index> same_as_;
};

/// What is left out of a mesh; either list may be empty.
struct Mask {
  std::vector<char> vertices;  ///< V: other than 0 is left out, with all its faces
  std::vector<char> faces;     ///< F: the same
};

/// The mesh without what the mask leaves out: distances are those on a mesh from which it was cut.
/// All numbers stay; faces that are left out repeat a corner from here on, and vertices of no other
/// face have no distance. Errors: kBadInput (lists of other lengths; nothing is left). Cost: O(F).
Result<TriangleMesh> masked(const TriangleMesh& mesh, const Mask& mask);

/// Whether `other` is `mesh` with its vertices elsewhere: the same faces, and the same vertices
/// that are one. Errors: kBadInput, with the numbers. Cost: one pass over the faces, none where
/// moved() made one of the other.
Result<void> check_moved(const TriangleMesh& mesh, const TriangleMesh& other);

/// A point on the surface: a vertex, or barycentric weights in a face (weights of 0 put it on an
/// edge or a corner). Weights are >= 0 and sum to 1.
struct SurfacePoint {
  Index vertex = kNoIndex;          ///< set for a vertex; then `face` and `weights` do not matter
  Index face = kNoIndex;            ///< that it is in
  std::array<double, 3> weights{};  ///< of the corners of `face`

  /// One at a vertex, and one in a face.
  static SurfacePoint at_vertex(Index v) { return {v, kNoIndex, {}}; }
  static SurfacePoint in_face(Index f, std::array<double, 3> w) { return {kNoIndex, f, w}; }
  bool is_vertex() const { return vertex != kNoIndex; }  ///< else in a face
  bool operator==(const SurfacePoint&) const = default;
};

/// The answer of closest_point().
struct ClosestPoint {
  SurfacePoint point;   ///< a vertex where the closest point is one, else weights in a face
  double distance = 0;  ///< straight line, model units
};

/// The point of the surface nearest to `query` (model units); the first face among equals. Faces
/// that repeat a corner are left out; faces without area count as the segments they are.
/// Errors: kBadInput (a coordinate that is not finite, no face but such with a repeated corner).
/// Cost: O(F), no index is built.
Result<ClosestPoint> closest_point(const TriangleMesh& mesh, const Vec3& query);

/// A mesh whose close vertices are one.
struct WeldedMesh {
  TriangleMesh mesh;  ///< as many vertices and faces, in the same order; TriangleMesh::same_as()
  Index merged = 0;   ///< vertices that another one stands for
};

/// Makes vertices one that are joined by steps of at most `distance` (model units; 0: equal
/// positions) from vertex to vertex, which closes cracks between faces. The lowest one stands for
/// all, at its place. Only vertices of faces with three different corners are merged. Faces that
/// collapse then repeat a corner, and are left out when the mesh is cleaned. Errors: kBadInput
/// (distance negative or not finite; every face collapses), kOutOfMemory. Cost: O(V log V).
Result<WeldedMesh> weld(const TriangleMesh& mesh, double distance);

/// Cuts every face into four at the midpoints of its edges, `times` times: the surface stays the
/// same, and so do the numbers of its vertices, which come first. Faces that share an edge, two or
/// more, share its midpoint. The parts of face f are 4^times f, ... (subdivided_point()). A face
/// that repeats a corner has no inside and becomes itself four times.
///
/// Errors: kBadInput (times negative; more faces than can be numbered), kOutOfMemory, each with
/// the number of faces. Cost: O(4^times F); each time the mean edge halves.
Result<TriangleMesh> subdivide(const TriangleMesh& mesh, int times);

/// The same point in the subdivided mesh; a vertex stays one. Weights are halved and doubled alone,
/// so that points on edges stay on edges. Preconditions: weights >= 0 that sum to 1, a face that
/// repeats no corner.
SurfacePoint subdivided_point(SurfacePoint point, int times);

/// A straight line in a face (sources.h) in the parts that it crosses, in order.
std::vector<FaceSegment> subdivided_segment(const FaceSegment& segment, int times);

/// The vertices along side k of face f of the mesh that became `faces`, from corner k to the next:
/// 2^times + 1. Precondition: the face repeats no corner.
std::vector<Index> subdivided_side(std::span<const Face> faces, Index f, int k, int times);

/// Faces with any number of corners, as modelling programs write them: V vertices, faces one after
/// the other. They may be concave, and need not be planar; nothing cuts them into triangles.
struct PolygonMesh {
  std::vector<Vec3> positions;      ///< V, model units
  std::vector<std::int64_t> start;  ///< faces + 1: face f has the corners start[f] to start[f + 1]
  std::vector<Index> corners;       ///< round each face
};

/// A polygon mesh as triangles with the same vertices, for what needs such: faces of more than
/// three corners become fans, or, where these would fold over, triangles that cover them once;
/// faces with fewer than three none. Errors (kBadInput): a corner out of range, a coordinate that
/// is not finite, no face. Cost: O(corners) for convex faces.
Result<TriangleMesh> triangulated(const PolygonMesh& mesh);

}  // namespace geotherm
