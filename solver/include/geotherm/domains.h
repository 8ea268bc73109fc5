// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "geotherm/error.h"
#include "geotherm/io.h"
#include "geotherm/mesh.h"
#include "geotherm/names.h"
#include "geotherm/progress.h"
#include "geotherm/sources.h"
#include "geotherm/types.h"

// Spaces other than triangle meshes. The heat method needs of a space a mass, a stiffness and the
// gradient of a field on each cell (Crane, Weischedel, Wardetzky 2013, section 3.2): a CellComplex
// states these, and cells_of() makes one of tetrahedra, polygons and graphs; a Grid is used as it
// is. Points become a triangle mesh, surface_of(). docs/adding_a_domain.md makes a space of one's
// own.
namespace geotherm {

/// A space cut into cells. A cell joins k vertices, which may be another number in each, and gives
/// the values on them one gradient of D numbers, in a frame of its own. The stiffness of a cell is
/// measure times G' G, G its D x k gradients; its mass goes to its vertices in shares.
struct CellComplex {
  Index vertices = 0;               ///< V
  int dimension = 0;                ///< D: 1, 2 or 3
  std::vector<std::int64_t> start;  ///< C + 1: cell c has the corners start[c] to start[c + 1]
  std::vector<Index> corners;       ///< S, one cell after the other; a cell's are different
  std::vector<double> gradients;    ///< D to a corner: of its hat function, 1 / model units
  std::vector<double> measures;     ///< C: lengths, areas or volumes, > 0
  std::vector<double> shares;       ///< S: of the measure, to each corner; empty: all are equal
  std::vector<double> widths;       ///< C: lengths that u is linear over, > 0; t has their mean
  std::vector<char> on_boundary;    ///< V: what the boundary rules hold; empty: none
  /// C, from 0 on, ascending: what sources call each cell; empty: 0 to C - 1. Cells with the same
  /// corners, in one order, may share a number, as the triangles of a polygon do.
  std::vector<Index> numbers;
  /// C: of polygons, model units; not finite: a triangle that its face was cut into, of the three
  /// corners whose gradients are not 0; empty: no polygons.
  std::vector<Vec3> virtual_vertices;
  /// V, model units; empty where the vertices lie nowhere. Elimination orders are better with them.
  std::vector<Vec3> positions;
  /// No way is shorter than the straight line between `positions`: what is below it is raised.
  bool lengths_are_straight = false;
  std::vector<Warning> notes;  ///< about what was left out: HeatMethod::warnings() begins with them
  std::string cell_name = "cell", cells_name = "cells";  ///< in messages

  Index cell_count() const { return static_cast<Index>(measures.size()); }  ///< of cells
  /// Precondition: cell in [0, cell_count()).
  std::span<const Index> corners_of(Index cell) const {
    const auto c = static_cast<std::size_t>(cell);
    return {corners.data() + start[c], corners.data() + start[c + 1]};
  }
};

/// Whether the arrays fit together, in O(S). Errors (kBadInput, with the numbers): sizes that do
/// not, no cell, a corner out of range or twice in one, what is not finite, gradients that do not
/// sum to 0, measures or widths not above 0, shares below 0, not of sum 1, or all 0 at a vertex.
Result<void> check_cells(const CellComplex& cells);

/// Vertices joined by edges with lengths, in model units: roads, pipes, a skeleton. Distance runs
/// along the edges.
struct Graph {
  /// Two vertices that are joined.
  struct Edge {
    Index from = kNoIndex, to = kNoIndex;  ///< in [0, vertices)
    double length = 0;                     ///< > 0
  };
  Index vertices = 0;       ///< how many
  std::vector<Edge> edges;  ///< in any order and direction
};

/// A graph as a space of one dimension: each edge is a cell. Errors (kBadInput, with the number):
/// no edge, an end out of range, both ends the same, a length that is not above 0. Cost: one pass.
Result<CellComplex> cells_of(const Graph& graph);

/// A polygon mesh as a space of two dimensions: a face of k corners is the k triangles between its
/// sides and a virtual vertex (Bunge, Herholz, Kazhdan, Botsch 2020), whose value is a mean of the
/// corners': the harmonic one; or the k - 2 of triangulated(), where not all sides are seen from it
/// or one of its triangles is nearly flat. Each is a cell, with all corners of the face and its
/// number in the mesh. HeatMethod flips those that are far from Delaunay. Corners that repeat the
/// one before are dropped, faces without area, of under three corners or with one twice left out.
/// Errors (kBadInput, with the number): a corner out of range, a coordinate that is not finite,
/// over 256 corners in a face, no face to use. Cost: 3 k^2 numbers, k^3 steps for k corners.
Result<CellComplex> cells_of(const PolygonMesh& mesh);

/// Samples in a box, such as the pixels of an image or the voxels of a scan. Its vertices are the
/// samples, numbered with x fastest. Its cells are the squares or cubes between samples that all
/// pass, and the edges between two that lie in none of these, so that corridors one sample wide
/// connect. The speed of a cell is the harmonic mean of its corners'.
struct Grid {
  std::array<Index, 3> size = {1, 1, 1};  ///< samples along x, y and z; 1 along z in two dimensions
  /// Between samples, model units, not 0; below 0 where the axis runs backwards.
  std::array<double, 3> spacing = {1, 1, 1};
  Vec3 origin = Vec3::Zero();  ///< of sample (0, 0, 0)
  /// For each sample, x fastest: the speed with which distance is travelled there, so that the
  /// answer is travel time; 0 where nothing passes. Empty: 1 everywhere.
  std::vector<double> speeds;
  bool three_axes = false;  ///< arrays that are written have three, also where size[2] is 1

  Index sample_count() const { return size[0] * size[1] * size[2]; }  ///< of all three axes
  /// The sample at these steps along x, y, z; the steps of a sample; its place in model units.
  Index number(const std::array<Index, 3>& at) const {
    return at[0] + size[0] * (at[1] + size[1] * at[2]);
  }
  std::array<Index, 3> place(Index sample) const {
    return {sample % size[0], sample / size[0] % size[1], sample / size[0] / size[1]};
  }
  Vec3 position(Index sample) const {
    const auto at = place(sample);
    return origin + Vec3(at[0] * spacing[0], at[1] * spacing[1], at[2] * spacing[2]);
  }
  double speed(Index sample) const { return speeds.empty() ? 1 : speeds[sample]; }  ///< 0: wall
};

/// Errors (kBadInput, with the numbers): sizes that are not positive, are above a billion samples
/// in all or do not fit the speeds, a spacing that is 0, a speed that is negative or not finite, no
/// two neighbours that pass. Cost: one pass.
Result<void> check_grid(const Grid& grid);

/// The point of a grid nearest to a place: a sample, else a point in a cell.
struct ClosestGridPoint {
  Index sample = kNoIndex;  ///< where it is one
  CellPoint in_cell;        ///< where `sample` is kNoIndex; numbered by the cell's lowest sample
  double distance = 0;      ///< straight line, model units; 0 inside
};
/// In a cell that passes the point itself, else the nearest sample that passes. Errors (kBadInput):
/// those of check_grid(), a coordinate that is not finite. Cost: O(V).
Result<ClosestGridPoint> closest_point(const Grid& grid, const Vec3& query);

/// What the values of a file's samples mean.
enum class GridValues {
  kAuto,   ///< floating-point numbers are speeds, all others a mask
  kMask,   ///< what is not 0 passes, with speed 1; of pictures, brightness of at least half
  kSpeeds  ///< speeds, 0 and NaN are walls; of pictures brightness, from 0 to 1
};
NamedValues<GridValues> named_values(GridValues);

/// A grid as read from a file, what its values mean and what the reader left out.
struct GridFile {
  Grid grid;                       ///< what it holds
  std::string meaning;             ///< what its values were taken for, in a sentence
  std::vector<std::string> notes;  ///< one sentence each, for people
};

/// Reads `.npy` (booleans, whole numbers, floating-point numbers of 4 and 8 bytes; 2 or 3 axes, of
/// which the last is x), `.png` (the first row is the top: y runs backwards), `.vti` (VTK image:
/// text, base64, appended, compressed by zlib; the active scalars of the points, or the first) and
/// `.nrrd`, `.nhdr` (raw, gzip, text; samples in the file or beside it). Errors: one sentence with
/// path and cause (kBadFile), a negative speed with its place among them; an unknown extension
/// (kNotAvailable); kOutOfMemory. Never throws. What a file announces is held against its size
/// before memory is asked for. Cost: the file and 8 bytes a sample in memory.
Result<GridFile> read_grid(const ModelInput& input, GridValues values = GridValues::kAuto);
/// Reads the grid of a path, as ModelInput::open() takes it.
Result<GridFile> read_grid(const std::string& path, GridValues values = GridValues::kAuto);

/// The extensions without their point: npy, png, vti, nrrd, nhdr.
std::vector<std::string> grid_formats();
/// Whether the format is one of those.
bool holds_grid(const ModelInput& input);

/// True when write_distances() of a grid knows the extension; otherwise the error (kNotAvailable)
/// says which there are.
Result<void> check_grid_distances_path(const std::string& path);

/// Writes one distance a sample, infinite where unreached: `.npy` in the shape of the grid, `.csv`,
/// `.vti` (point data `distance`). `nearest` and `fields` follow as for a triangle mesh. Errors:
/// those of check_grid_distances_path(), kBadInput (sizes), kBadFile, kOutOfMemory.
Result<void> write_distances(const std::string& path, const Grid& grid,
                             std::span<const double> distances, std::span<const Index> nearest = {},
                             std::span<const DataField> fields = {});

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

  /// V and T, as they were given, and how many there are.
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
  Index vertex = kNoIndex;          ///< set for a vertex; then `tet` and `weights` do not matter
  Index tet = kNoIndex;             ///< that it is in
  std::array<double, 4> weights{};  ///< of the corners of `tet`

  /// One at a vertex, and one in a tet.
  static VolumePoint at_vertex(Index v) { return {v, kNoIndex, {}}; }
  static VolumePoint in_tet(Index t, std::array<double, 4> w) { return {kNoIndex, t, w}; }
  bool is_vertex() const { return vertex != kNoIndex; }  ///< else in a tet
  bool operator==(const VolumePoint&) const = default;
};

/// The answer of closest_point() in a volume.
struct ClosestVolumePoint {
  VolumePoint point;    ///< a vertex where the closest point is one, else weights in a tet
  double distance = 0;  ///< straight line, model units; 0 inside
};

/// The point of the volume nearest to `query` (model units); the first tet among equals. Tets
/// without a volume are left out, as they are from what distance is computed in. Errors: kBadInput
/// (a coordinate that is not finite, no tet but such with a repeated corner). Cost: O(T), no index
/// is built.
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
  TetMesh mesh;                    ///< what it holds
  std::vector<std::string> notes;  ///< one sentence each, for people
};

/// The tets as a space: linear functions on each. Those that repeat a corner, repeat another or are
/// flat are left out and said (TetMesh); sources keep the numbers of the mesh. Errors: kBadInput
/// (no tet with a volume), kOutOfMemory. Cost: O(V + T).
Result<CellComplex> cells_of(const TetMesh& mesh);

/// Reads the tetrahedra with four corners of Medit `.mesh` and `.meshb`, Gmsh `.msh` (2.x and 4.1,
/// text and binary), VTK `.vtk` (unstructured grid, text and binary) and `.vtu` (text, base64 and
/// appended, also compressed by zlib), TetGen `.node` with `.ele` (either is named, the other lies
/// beside it), as ModelInput::open() tells them apart. Vertices are numbered from 0 in the order of
/// the file, whatever numbers it gives them. Elements that are no tets are left out with a note.
/// Errors: one sentence, "PATH: line N: ..." or "PATH: byte N: ..." with the cause (kBadFile); an
/// unknown extension, or faces and no tets (kNotAvailable); kOutOfMemory. Never throws. What a file
/// announces is held against its size before memory is asked for. Independent of the locale. Cost:
/// a copy of the file in memory, and one pass over it.
Result<TetFile> read_tets(const ModelInput& input);
Result<TetFile> read_tets(const std::string& path);  ///< of a path, as ModelInput::open() takes it

/// The extensions without their point: mesh, meshb, msh, vtk, vtu, node, ele.
std::vector<std::string> tet_formats();
/// Whether read_tets() is the one to ask: the extension is one of those and, for `.msh`, `.vtk` and
/// `.vtu`, which also hold other things, the file begins as one with elements does (Gmsh; an
/// unstructured grid). Whether there are tets among these only reading tells. False for a file that
/// cannot be read. Cost: the first 4 KiB.
bool holds_tets(const ModelInput& input);

/// True when write_tets() knows the extension of `path`; otherwise the error (kNotAvailable) says
/// which there are.
Result<void> check_tets_path(const std::string& path);

/// Writes the volume alone: `.mesh` (Medit, text) or `.vtu`. Positions read back exactly. The file
/// is there whole or not at all. `path` "-" writes .mesh to standard output. Errors: those of
/// check_tets_path(); kBadFile, with the path and the system's reason; kOutOfMemory.
Result<void> write_tets(const std::string& path, const TetMesh& mesh);

/// Whether write_distances() of a volume knows the extension; the error says which there are.
Result<void> check_tet_distances_path(const std::string& path);

/// Writes one distance per vertex, in the order of the file, model units, infinite where unreached:
/// `.csv` and `.npy` as for a triangle mesh, `.vtu` (ParaView; point data `distance`, binary).
/// `nearest` and `fields` follow as there; a field of DataField::Place::kFaces has a value per tet,
/// which .vtu alone holds. Preconditions: sizes that fit, names of letters, digits and _.
/// Errors: those of check_tet_distances_path(), kBadInput (sizes), kBadFile, kOutOfMemory.
Result<void> write_distances(const std::string& path, const TetMesh& mesh,
                             std::span<const double> distances, std::span<const Index> nearest = {},
                             std::span<const DataField> fields = {});

/// An immutable set of points on some surface, exactly as a file or a program gave it.
///
/// Positions: P x 3, finite, model units. Normals: P x 3, or none at all; of any length, and those
/// that are 0 or not finite say nothing about their point. Points may lie at one place.
class PointCloud {
 public:
  /// Takes the arrays. Errors (kBadInput): no points, a coordinate that is not finite (with the
  /// number of its point), normals of another number than the points. Cost: O(P).
  static Result<PointCloud> build(std::vector<Vec3> positions, std::vector<Vec3> normals = {});

  std::span<const Vec3> positions() const { return positions_; }               ///< P, model units
  std::span<const Vec3> normals() const { return normals_; }                   ///< P, or none
  Index point_count() const { return static_cast<Index>(positions_.size()); }  ///< P

 private:
  PointCloud(std::vector<Vec3> positions, std::vector<Vec3> normals)
      : positions_(std::move(positions)), normals_(std::move(normals)) {}

  std::vector<Vec3> positions_, normals_;
};

/// How points become a surface.
struct PointOptions {
  /// Nearest neighbours that each point is triangulated with, from 6 to 100. Fewer bridge narrower
  /// gaps between sheets and along boundaries; more even out noise.
  int neighbours = 30;
  /// Points whose normals are more than 120 degrees apart are never joined. For normals that all
  /// point to one side of their surface.
  bool normals_separate = true;

  bool operator==(const PointOptions&) const = default;
};

/// The surface of a point cloud.
struct PointSurface {
  /// Its vertices are the points, in their order; equal ones are one (TriangleMesh::same_as()). Its
  /// faces overlap here and there, and no edge of them need have two: methods that take the tufted
  /// cover (LaplacianKind::kAuto or kTufted) work on it as it is.
  TriangleMesh mesh;
  Index duplicates = 0;  ///< points that an earlier one at the same place stands for
  Index parts = 0;       ///< pieces that no triangle joins; sources in one do not reach the others
  Index outliers = 0;    ///< points in no face, which no source reaches
  Index between_sheets = 0;        ///< points whose faces join two sheets that are near each other
  double spacing = 0;              ///< mean distance from a point to the nearest other, model units
  std::vector<std::string> notes;  ///< one sentence each, for people: what was done
  std::vector<Warning> warnings;   ///< what may make distances wrong
};

/// Joins points by triangles where they sample a surface (Sharp, Crane 2020, section 5.7).
///
/// Each point is triangulated with its nearest neighbours in its tangent plane, which is that of
/// its normal or, where there is none, of a weighted fit (principal components). Of that Delaunay
/// triangulation the triangles at the point are kept: those whose corners share a vertex of the
/// point's Voronoi cell. The cell is that of space, cut by the tangent plane (Boissonnat, Ghosh
/// 2014), so that points far above the plane have no share. The surface is the union over all
/// points, each triangle once: of every triangle that two of its corners found, and of those that
/// one found while all three are among each other's neighbours. A lone point off the surface is
/// therefore joined to nothing.
///
/// Two sheets nearer to each other than some three quarters of the spacing are joined, unless
/// normals keep them apart; holes narrower than some three spacings may be closed.
///
/// `progress` is asked as stage "surface". `threads`: 0 means all cores; the answer has the same
/// bits with any number. Errors: kBadInput (options, points on one line or fewer than three that
/// differ), kOutOfMemory, kCancelled. Cost: O(P log P).
Result<PointSurface> surface_of(const PointCloud& cloud, const PointOptions& options = {},
                                const Progress& progress = {}, int threads = 0);

/// Points as read from a file, and what the reader left out.
struct PointFile {
  PointCloud points;               ///< what it holds
  std::vector<std::string> notes;  ///< one sentence each, for people
};

/// Reads points, numbered from 0 in the order of the file; the extension decides, in any case:
///
/// - `.ply` (ASCII, little and big endian): the element `vertex`, with normals where it has `nx`,
///   `ny`, `nz`. Faces are left out.
/// - `.xyz`: a point a line, x y z and what else there is, separated by blanks or commas. Columns 4
///   to 6 are normals where they are vectors of length 1 (or 0) in all lines. `#` and `//` begin
///   comments.
/// - `.pts`: a line with the number of points and then as many, x y z and what else there is; and
///   again.
/// - `.pcd` (version 0.7: `ascii`, `binary`, `binary_compressed`): the fields x, y, z, and
///   normal_x, normal_y, normal_z where there are such. Points whose coordinates are not finite
///   stand for nothing in this format: they are left out and have no number.
///
/// Errors: one sentence, "PATH: line N: ..." or "PATH: byte N: ..." with the cause (kBadFile); an
/// unknown extension (kNotAvailable); kOutOfMemory. Never throws. What a file announces is held
/// against its size before memory is asked for. A file that others change while it is read is an
/// error (kBadFile). Independent of the locale. Cost: a copy of the file, and one pass over it.
Result<PointFile> read_points(const ModelInput& input);
/// Reads the points of a path, as ModelInput::open() takes it.
Result<PointFile> read_points(const std::string& path);

std::vector<std::string> point_formats();  ///< ply, xyz, pts, pcd
/// Whether the file holds points without faces: by its extension, of a `.ply` by its header, which
/// is all that is read; false where that is damaged. Errors: kOutOfMemory.
Result<bool> is_point_file(const ModelInput& input);

}  // namespace geotherm
