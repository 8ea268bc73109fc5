// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "geotherm/error.h"
#include "geotherm/mesh.h"
#include "geotherm/names.h"

// Models from files, and distances, meshes and arrays to files.
namespace geotherm {

namespace io {
class InputFile;
}

/// A file, a pipe or another stream that is open for reading, and in which format it is. A stream
/// can be read but once: held here, it can be asked for what it holds and read after that. Files
/// that gzip packed (`.ply.gz`, known by their first bytes) are unpacked. Copies share it.
class ModelInput {
 public:
  /// `format`: one of model_formats(); empty: that of the extension, less .gz, in any case; where
  /// the path has no extension, what the first bytes look like. Errors: kNotAvailable (no such
  /// format); kBadFile (cannot be opened, empty, a directory, packed bytes that are damaged, cut
  /// off or unpack to more than a hundred times their size and 256 MiB), kOutOfMemory (what is held
  /// may be at most half of what is free); each "PATH: cause". Waits two seconds for the writer of
  /// a named pipe.
  static Result<ModelInput> open(const std::string& path, std::string_view format = {});

  /// Reads from an open descriptor, such as standard input (0), to its end. `name`: in place of the
  /// path, in messages. Errors: the same.
  static Result<ModelInput> stream(int descriptor, const std::string& name,
                                   std::string_view format = {});

  /// One of model_formats(), or what else stands behind the point; empty: it has not been found.
  std::string format() const;

  const io::InputFile& file() const { return *file_; }  ///< for the readers of the library

 private:
  explicit ModelInput(std::shared_ptr<const io::InputFile> file) : file_(std::move(file)) {}
  std::shared_ptr<const io::InputFile> file_;
};

/// All formats that models are read from, whatever they hold: extensions without their point.
std::vector<std::string> model_formats();

/// The formats of triangle meshes: obj, ply, off, stl, gltf, glb, 3mf, dae, vtp, vtk, vtu, msh,
/// mesh, meshb, gii, fsurf.
std::vector<std::string> mesh_formats();

/// Errors: kNotAvailable (none of model_formats()), with those that there are.
Result<void> check_model_format(std::string_view name);

/// A model as read from a file: the mesh and what the reader had to do to get it.
struct MeshFile {
  TriangleMesh mesh;               ///< what it holds
  Index polygons = 0;              ///< faces with more than three corners that were triangulated
  Index welded = 0;                ///< STL: corners that were merged into shared vertices
  std::vector<std::string> notes;  ///< one sentence each, for people
  /// The axis that is up (0: x, 1: y, 2: z) where the format says so: glTF, Collada, 3MF.
  std::optional<int> up_axis = {};
};

/// Reads the faces of a model; vertex numbers are 0-based and in the order of the file.
///
/// `.obj`, `.ply` (ASCII, little and big endian; also triangle strips), `.off`, `.stl` (ASCII,
/// binary), GIFTI `.gii`, surfaces of FreeSurfer (`fsurf`, by their first bytes), `.vtp` and `.vtu`
/// (VTK XML), `.vtk` (VTK legacy), Gmsh `.msh` (2.x, 4.1), Medit `.mesh` and `.meshb`: of what
/// holds other elements, too, the triangles, quads and polygons. An STL has no numbers: equal
/// corners are welded, numbered by first appearance. `.gltf`, `.glb`, `.3mf` and `.dae` (read by
/// Assimp, where the library was built with it): all meshes of the scene with their transforms, as
/// often as they are placed; vertices with the same position are one, numbered by first appearance,
/// for these formats split vertices where normals or textures differ.
///
/// Coordinates are the doubles nearest to what is written. A face of more than three corners
/// becomes a fan from its first corner, or, where that would fold over, triangles that cover it
/// once. Errors: one sentence, "PATH: line N: ..." or "PATH: byte N: ..." with the cause
/// (kBadFile); a format that holds no faces (kNotAvailable); kOutOfMemory. Never throws. What a
/// file announces is held against its size before memory is asked for. A file that others change
/// while it is read is an error (kBadFile). Independent of the locale. Cost: a copy of the file in
/// memory, and one pass over it; OBJ on all cores.
Result<MeshFile> read_mesh(const ModelInput& input);

/// Reads a path, as ModelInput::open() takes it. Errors: those of both.
Result<MeshFile> read_mesh(const std::string& path, std::string_view format = {});

/// A mesh of polygons as read from a file.
struct PolygonFile {
  PolygonMesh mesh;                ///< what it holds
  std::vector<std::string> notes;  ///< one sentence each, for people
};

/// Reads the faces as they are; otherwise as read_mesh(), of formats that keep polygons. Errors:
/// those of read_mesh().
Result<PolygonFile> read_polygons(const ModelInput& input);

/// Reads a path, as ModelInput::open() takes it. Errors: those of both.
Result<PolygonFile> read_polygons(const std::string& path, std::string_view format = {});

/// Numbers on the vertices or faces of a mesh, as files hold them beside the distances.
struct DataField {
  /// What the numbers belong to.
  enum class Place { kVertices, kFaces };
  /// How a file holds them.
  enum class Type {
    kFloat64,  ///< any numbers
    kUint8,    ///< whole numbers, 0 to 255
  };

  std::string name;                ///< of a property or column: letters, digits, _
  Place place = Place::kVertices;  ///< what they belong to
  Type type = Type::kFloat64;      ///< how a file holds them
  std::vector<double> values;      ///< V or F, in the order of the file; infinite: no value
};

/// True when write_distances() knows the extension of `path`; otherwise the error says which
/// extensions there are (and for .obj that the format holds no values).
Result<void> check_distance_path(const std::string& path);

/// Writes one distance per vertex, in the order of the file, model units, `inf` where unreached.
/// The format is the extension's: `.csv` (`vertex,distance`, the fewest digits that read back
/// equal),
/// `.npy` (float64, shape V), `.ply` (mesh, binary little endian but ASCII with fields of faces,
/// with the vertex properties `double distance` and `float quality`, the same for MeshLab, where
/// unreached vertices have the largest distance), `.vtp` (ParaView PolyData, point data
/// `distance`). `path` "-" writes CSV to standard output. The file is written beside its place and
/// renamed: it is there whole or not at all.
///
/// With `nearest`, a number per vertex (DistanceResult::nearest_source), they have a third column
/// `nearest_source`, shape V x 2, a property `int nearest_source` and point data of that name.
/// `fields` follow under their names: as columns (.csv, those of vertices), properties `double` or
/// `uchar` of vertices and faces (.ply), point and cell data (.vtp).
///
/// Preconditions: distances.size() == mesh.vertex_count(), and nearest.size() unless it is empty;
/// every field has as many values as its place has elements. Errors: those of check_field();
/// kBadFile, with the path and the system's reason.
Result<void> write_distances(const std::string& path, const TriangleMesh& mesh,
                             std::span<const double> distances, std::span<const Index> nearest = {},
                             std::span<const DataField> fields = {});

/// Whether the file of this path holds the field beside the distances (.vtu of tets, .vti of grids
/// among them). Errors: kNotAvailable, with
/// the extensions that do.
Result<void> check_field(const std::string& path, const DataField& field);

/// Whether write_mesh() knows the extension of `path`; otherwise the error says which there are.
Result<void> check_mesh_path(const std::string& path);

/// Writes the mesh alone: `.obj`, `.ply` (binary), `.off` or `.stl` (binary), by extension.
/// Positions read back exactly, except from .stl: 32-bit numbers, no vertex without a face, and
/// vertices numbered by first use. `path` "-" writes OBJ to standard output.
Result<void> write_mesh(const std::string& path, const TriangleMesh& mesh);

/// The numbers of a .npy array, little endian.
enum class NpyType { kFloat64, kFloat32 };
inline NamedValues<NpyType> named_values(NpyType) {
  using enum NpyType;
  return {"there is no type of numbers '*'",
          {{kFloat64, "float64"}, {kFloat32, "float32"}},
          ErrorCode::kNotAvailable};
}

/// Bytes of a file of rows x columns numbers, header included.
std::uint64_t npy_bytes_of(std::uint64_t rows, std::uint64_t columns, NpyType type);

/// A .npy array of two dimensions that is written row by row, so that no more than one row need be
/// in memory: whole or not at all, as with write_distances(). kFloat32 rounds to nearest; infinity
/// stays what it is.
class NpyRows {
 public:
  /// `path` "-" is standard output. Errors (kBadFile) carry the path and the system's reason.
  static Result<NpyRows> open(const std::string& path, std::uint64_t rows, std::uint64_t columns,
                              NpyType type);
  NpyRows(NpyRows&&) noexcept;
  NpyRows& operator=(NpyRows&&) noexcept;
  ~NpyRows();

  /// Precondition: as many values as columns; at most `rows` calls. Errors: kBadFile; kBadInput
  /// where the values do not fit into kFloat32: one above 3.4e38, or all below 1.2e-38.
  Result<void> append(std::span<const double> row);

  /// Makes it the file of its path. Precondition: every row was appended.
  Result<void> finish();

 private:
  struct State;
  explicit NpyRows(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// Rows of which few entries are there, written row by row as a .npz that scipy.sparse.load_npz()
/// reads: compressed sparse rows (data, indices, indptr, shape). Whole or not at all; memory: 8
/// bytes a row. What was appended waits beside the file until the end, in as much room again.
class SparseRows {
 public:
  /// `path` "-" is standard output. Errors (kBadFile) carry the path and the system's reason.
  static Result<SparseRows> open(const std::string& path, std::uint64_t columns, NpyType type);
  SparseRows(SparseRows&&) noexcept;
  SparseRows& operator=(SparseRows&&) noexcept;
  ~SparseRows();

  /// A row's entries. Preconditions: as many values as columns, which are ascending. Errors: those
  /// of NpyRows::append().
  Result<void> append(std::span<const Index> columns, std::span<const double> values);

  std::uint64_t rows() const;     ///< that were appended
  std::uint64_t entries() const;  ///< of all of them; those that are 0 count

  /// Makes it the file of its path.
  Result<void> finish();

 private:
  struct State;
  explicit SparseRows(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// What a file says of a mesh with these faces to be left out. `text`: FILE; keep:FILE marks what
/// stays instead; faces:FILE holds numbers of faces, not of vertices; FILE.ply:NAME is a property
/// of its vertices. Files: text or .npy of V or F numbers, 0 or 1, or of other numbers, which are
/// those of the vertices; .label of FreeSurfer; .ply; .gii, one number for each vertex, of which
/// other than 0 counts. Errors: kBadFile, with what is wrong and where.
Result<Mask> read_mask(const std::string& text, const TriangleMesh& mesh);

}  // namespace geotherm
