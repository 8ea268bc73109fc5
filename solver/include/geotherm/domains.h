// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "geotherm/error.h"
#include "geotherm/io.h"
#include "geotherm/types.h"

// Spaces other than triangle meshes in which distance is computed, points of them, and their files.
namespace geotherm {

/// The four corners of a tetrahedron, as vertex numbers.
using Tet = std::array<Index, 4>;

/// An immutable volume of tetrahedra, exactly as its file or generator gave it.
///
/// Positions: V x 3, finite, model units. Tets: T x 4, every corner in [0, V), in either
/// orientation. Nothing else is promised: tets may repeat a corner, have no volume, stand there
/// twice or overlap; vertices may belong to no tet. What operators are made of is clean: tets that
/// repeat a corner, repeat another or are flat are left out, and the rest is turned to be positive.
class TetMesh {
 public:
  /// Takes the arrays. Errors: no tets, a corner out of range, a coordinate that is not finite
  /// (each with its number). Cost: one pass over both arrays.
  static Result<TetMesh> build(std::vector<Vec3> positions, std::vector<Tet> tets);

  std::span<const Vec3> positions() const { return positions_; }
  std::span<const Tet> tets() const { return tets_; }
  Index vertex_count() const { return static_cast<Index>(positions_.size()); }
  Index tet_count() const { return static_cast<Index>(tets_.size()); }

 private:
  TetMesh(std::vector<Vec3> positions, std::vector<Tet> tets)
      : positions_(std::move(positions)), tets_(std::move(tets)) {}

  std::vector<Vec3> positions_;
  std::vector<Tet> tets_;
};

/// A point of the volume: a vertex, or barycentric weights in a tet (weights of 0 put it on a face,
/// an edge or a corner). Weights are >= 0 and sum to 1.
struct VolumePoint {
  Index vertex = kNoIndex;  ///< set for a vertex; then `tet` and `weights` do not matter
  Index tet = kNoIndex;
  std::array<double, 4> weights{};

  static VolumePoint at_vertex(Index v) { return {v, kNoIndex, {}}; }
  static VolumePoint in_tet(Index t, std::array<double, 4> w) { return {kNoIndex, t, w}; }
  bool is_vertex() const { return vertex != kNoIndex; }
  bool operator==(const VolumePoint&) const = default;
};

/// The answer of closest_point() in a volume.
struct ClosestVolumePoint {
  VolumePoint point;    ///< a vertex where the closest point is one, else weights in a tet
  double distance = 0;  ///< straight line, model units; 0 inside
};

/// The point of the volume nearest to `query` (model units); the first tet among equals. Tets that
/// repeat a corner are left out; flat ones count as the faces they are. Errors: kBadInput (a
/// coordinate that is not finite, no tet but such with a repeated corner). Cost: O(T), no index is
/// built.
Result<ClosestVolumePoint> closest_point(const TetMesh& mesh, const Vec3& query);

/// The border of a volume: the faces that belong to exactly one tet, counted without tets that
/// repeat a corner or another tet.
struct TetBoundary {
  std::vector<Face> faces;      ///< B; counter-clockwise as seen from outside
  std::vector<Index> tets;      ///< B: the tet that each belongs to
  std::vector<Index> vertices;  ///< those of these faces, ascending
};

/// In the order of the tets. A face of a tet without any volume has the orientation that the file
/// gave it. Errors: kOutOfMemory. Cost: O(V + T).
Result<TetBoundary> boundary(const TetMesh& mesh);

/// A volume as read from a file: the mesh, and what the reader left out.
struct TetFile {
  TetMesh mesh;
  std::vector<std::string> notes;  ///< one sentence each, for people
};

/// Reads the tetrahedra with four corners of Medit `.mesh` and `.meshb`, Gmsh `.msh` (2.x and 4.1,
/// text and binary), VTK `.vtk` (unstructured grid, text and binary) and `.vtu` (text, base64 and
/// appended, also compressed by zlib), TetGen `.node` with `.ele` (either is named, the other lies
/// beside it); the extension decides, in any case. Vertices are numbered from 0 in the order of the
/// file, whatever numbers it gives them. Elements that are no tets are left out with a note.
/// Errors: one sentence, "PATH: line N: ..." or "PATH: byte N: ..." with the cause (kBadFile); an
/// unknown extension (kNotAvailable); kOutOfMemory. Never throws. What a file announces is held
/// against its size before memory is asked for. Independent of the locale. Cost: a copy of the file
/// in memory, and one pass over it.
Result<TetFile> read_tets(const std::string& path);

/// The extensions without their point: mesh, meshb, msh, vtk, vtu, node, ele.
std::vector<std::string> tet_formats();

/// Whether read_tets() is the one to ask: the extension is one of those and, for `.msh`, `.vtk` and
/// `.vtu`, which also hold other things, the file begins as one with elements does (Gmsh; an
/// unstructured grid). Whether there are tets among these only reading tells. False for a file that
/// cannot be read. Cost: the first 4 KiB.
bool holds_tets(const std::string& path);

/// True when write_tets() knows the extension of `path`; otherwise the error (kNotAvailable) says
/// which there are.
Result<void> check_tets_path(const std::string& path);

/// Writes the volume alone: `.mesh` (Medit, text) or `.vtu`. Positions read back exactly. The file
/// is there whole or not at all. `path` "-" writes .mesh to standard output. Errors: those of
/// check_tets_path(); kBadFile, with the path and the system's reason; kOutOfMemory.
Result<void> write_tets(const std::string& path, const TetMesh& mesh);

/// The same for write_distances() of a volume.
Result<void> check_tet_distances_path(const std::string& path);

/// Writes one distance per vertex, in the order of the file, model units, infinite where unreached:
/// `.csv` and `.npy` as for a triangle mesh, `.vtu` (ParaView; point data `distance`, binary).
/// `nearest` and `fields` follow as there; a field of DataField::Place::kFaces has a value per tet,
/// which .vtu alone holds. Preconditions: sizes that fit, names of letters, digits and _.
/// Errors: those of check_tet_distances_path(), kBadInput (sizes), kBadFile, kOutOfMemory.
Result<void> write_distances(const std::string& path, const TetMesh& mesh,
                             std::span<const double> distances, std::span<const Index> nearest = {},
                             std::span<const DataField> fields = {});

}  // namespace geotherm
