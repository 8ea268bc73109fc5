// SPDX-License-Identifier: MIT
#include "geotherm/io.h"

#include <algorithm>
#include <new>
#include <string_view>
#include <utility>

#include "solver/core/text.h"
#include "solver/mesh/io/formats.h"
#include "solver/mesh/io/gifti_reader.h"
#include "solver/mesh/io/input_file.h"
#include "solver/mesh/io/raw_elements.h"

namespace geotherm {
namespace {

/// Reads a file whose bytes are not needed any more once they are parsed.
template <io::RawMesh (*Read)(std::string_view)>
io::RawMesh read_whole(const io::InputFile& file) {
  return Read(io::FileBytes(file).bytes());
}

template <io::RawElements (*Read)(std::string_view)>
io::RawMesh read_faces(const io::InputFile& file) {
  return io::faces_of(Read(io::FileBytes(file).bytes()));
}

struct MeshReader {
  std::string_view extension;
  io::RawMesh (*read)(const io::InputFile& file);
};

constexpr MeshReader kMeshReaders[] = {
    {".obj", io::read_obj},
    {".ply", read_whole<io::read_ply>},
    {".off", read_whole<io::read_off>},
    {".stl", read_whole<io::read_stl>},
    {".gltf", io::read_scene},
    {".glb", io::read_scene},
    {".3mf", io::read_scene},
    {".dae", io::read_scene},
    {".vtp", read_faces<io::read_vtp>},
    {".vtk", read_faces<io::read_vtk>},
    {".vtu", read_faces<io::read_vtu>},
    {".msh", read_faces<io::read_gmsh>},
    {".mesh", read_faces<io::read_medit>},
    {".meshb", read_faces<io::read_meshb>},
    {".gii", read_whole<io::read_gifti>},
    {".fsurf", read_whole<io::read_freesurfer>},
};
static_assert(io::reads_all(kMeshReaders, io::kFaces));

/// The triangles of a mesh whose polygons are fans. Errors: kBadInput.
Result<TriangleMesh> triangles_of(io::RawMesh raw) {
  io::PolygonCutter cutter(raw.faces.size());
  for (const io::Polygon& polygon : raw.polygons) {
    const std::span fan = std::span(raw.faces).subspan(polygon.first_face, polygon.face_count);
    if (!cutter.triangulate(raw.positions, fan)) {
      return Error{ErrorCode::kBadInput,
                   "a polygon with " + std::to_string(polygon.face_count + 2) +
                       " corners needs more than the " + std::to_string(cutter.most_tests()) +
                       " tests of points that all polygons of this file may take",
                   {"triangulate it in the program that wrote it"}};
    }
  }
  return TriangleMesh::build(std::move(raw.positions), std::move(raw.faces));
}

Result<MeshFile> mesh_file(const std::string& name, io::RawMesh raw) {
  const auto polygons = static_cast<Index>(raw.polygons.size());
  const auto welded = static_cast<Index>(raw.welded);
  const std::optional<int> up_axis = raw.up_axis;
  std::vector<std::string> notes = std::move(raw.notes);
  Result<TriangleMesh> mesh = triangles_of(std::move(raw));
  if (!mesh)
    return Error{ErrorCode::kBadFile, name + ": " + mesh.error().message, mesh.error().hint};
  return MeshFile{*std::move(mesh), polygons, welded, std::move(notes), up_axis};
}

/// A fan's corners are the first triangle's, then the last one of each that follows.
Result<PolygonFile> polygon_file(const std::string& name, io::RawMesh raw) {
  if (raw.faces.empty()) return Error{ErrorCode::kBadFile, name + ": the mesh has no faces"};
  PolygonMesh mesh{std::move(raw.positions), {0}, {}};
  auto polygon = raw.polygons.begin();
  for (std::size_t f = 0; f < raw.faces.size();) {
    const bool begins = polygon != raw.polygons.end() && polygon->first_face == f;
    const std::size_t count = begins ? (polygon++)->face_count : 1;
    mesh.corners.insert(mesh.corners.end(), raw.faces[f].begin(), raw.faces[f].begin() + 2);
    for (std::size_t k = 0; k < count; ++k) mesh.corners.push_back(raw.faces[f + k][2]);
    mesh.start.push_back(std::ssize(mesh.corners));
    f += count;
  }
  return PolygonFile{std::move(mesh), std::move(raw.notes)};
}

/// `finish` makes the answer of what the reader of the file's format gives.
template <class File>
Result<File> read_file(Result<File> (*finish)(const std::string&, io::RawMesh),
                       const io::InputFile& file) {
  const MeshReader* const reader = io::format_of(kMeshReaders, file.extension());
  if (reader == nullptr) return io::unknown_model(file, "", io::kFaces);
  return io::read_unchanged(file, file.shown(), "mesh",
                            [&] { return finish(file.shown(), reader->read(file)); });
}

}  // namespace

Result<void> check_model_format(std::string_view name) {
  std::string known;
  for (const std::string& each : model_formats()) {
    if (each == name) return {};
    known += (known.empty() ? "" : ", ") + each;
  }
  return Error{ErrorCode::kNotAvailable,
               "'" + io::printable(name) + "' is no format of models",
               {"there are " + known}};
}

Result<ModelInput> ModelInput::open(const std::string& path, std::string_view format) {
  if (!format.empty()) {
    if (auto known = check_model_format(format); !known) return known.error();
  }
  auto file = io::InputFile::open(path, format);
  if (!file) return file.error();
  return ModelInput(std::make_shared<const io::InputFile>(*std::move(file)));
}

Result<ModelInput> ModelInput::stream(int descriptor, const std::string& name,
                                      std::string_view format) {
  if (!format.empty()) {
    if (auto known = check_model_format(format); !known) return known.error();
  }
  auto file = io::InputFile::of_stream(descriptor, name, format);
  if (!file) return file.error();
  return ModelInput(std::make_shared<const io::InputFile>(*std::move(file)));
}

std::string ModelInput::format() const {
  const std::string& extension = file_->extension();
  return extension.empty() ? extension : extension.substr(1);
}

Result<io::RawMesh> io::read_raw_mesh(const std::string& path) {
  const auto file = InputFile::open(path);
  if (!file) return file.error();
  return read_file<io::RawMesh>(
      [](const std::string&, io::RawMesh raw) { return Result<io::RawMesh>(std::move(raw)); },
      *file);
}

Result<MeshFile> read_mesh(const ModelInput& input) { return read_file(mesh_file, input.file()); }

Result<MeshFile> read_mesh(const std::string& path, std::string_view format) {
  const auto input = ModelInput::open(path, format);
  return input ? read_mesh(*input) : input.error();
}

Result<PolygonFile> read_polygons(const ModelInput& input) {
  return read_file(polygon_file, input.file());
}

Result<PolygonFile> read_polygons(const std::string& path, std::string_view format) {
  const auto input = ModelInput::open(path, format);
  return input ? read_polygons(*input) : input.error();
}

Result<TriangleMesh> triangulated(const PolygonMesh& mesh) try {
  io::RawMesh raw;
  raw.positions = mesh.positions;
  io::FanBuilder fan(raw.faces);
  for (std::size_t f = 0; f + 1 < mesh.start.size(); ++f) {
    for (std::int64_t k = mesh.start[f]; k < mesh.start[f + 1]; ++k) {
      const Index corner = k < std::ssize(mesh.corners) && k >= 0 ? mesh.corners[k] : kNoIndex;
      if (corner < 0 || corner >= std::ssize(mesh.positions)) {
        return Error{ErrorCode::kBadInput, "face " + std::to_string(f) + " has the corner " +
                                               std::to_string(corner) + ", and there are " +
                                               std::to_string(mesh.positions.size()) + " vertices"};
      }
      fan.add(corner);
    }
    fan.end(raw.polygons);
  }
  return triangles_of(std::move(raw));
} catch (const std::bad_alloc&) {
  return Error{ErrorCode::kOutOfMemory, "the memory ended while polygons were cut into triangles"};
}

}  // namespace geotherm
