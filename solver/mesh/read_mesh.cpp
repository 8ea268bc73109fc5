// SPDX-License-Identifier: MIT
#include "geotherm/io.h"

#include <algorithm>
#include <new>
#include <string_view>
#include <utility>

#include "solver/core/text.h"
#include "solver/mesh/io/input_file.h"
#include "solver/mesh/io/raw_mesh.h"

namespace geotherm {
namespace {

/// From a file whose bytes a mesh no longer needs once they are parsed.
template <io::RawMesh (*Read)(std::string_view)>
io::RawMesh read_whole(const io::InputFile& file) {
  return Read(io::FileBytes(file).bytes());
}

struct Format {
  std::string_view extension;
  io::RawMesh (*read)(std::string_view bytes);
  io::RawMesh (*read_file)(const io::InputFile& file);
};

constexpr Format kFormats[] = {{".obj", io::read_obj, io::read_obj},
                               {".ply", io::read_ply, read_whole<io::read_ply>},
                               {".off", io::read_off, read_whole<io::read_off>},
                               {".stl", io::read_stl, read_whole<io::read_stl>}};

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
  std::vector<std::string> notes = std::move(raw.notes);
  Result<TriangleMesh> mesh = triangles_of(std::move(raw));
  if (!mesh)
    return Error{ErrorCode::kBadFile, name + ": " + mesh.error().message, mesh.error().hint};
  return MeshFile{*std::move(mesh), polygons, welded, std::move(notes)};
}

struct PolygonFile {
  PolygonMesh mesh;
  std::vector<std::string> notes;
};

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

/// `read` gives a RawMesh, of which `finish` makes the answer; `size`: bytes of the file.
template <class File, class Read>
Result<File> guarded(Result<File> (*finish)(const std::string&, io::RawMesh),
                     const std::string& name, std::size_t size, const Read& read) {
  return io::guarded_read(name, "mesh", size, [&] { return finish(name, read()); });
}

template <class File>
Result<File> read_file(Result<File> (*finish)(const std::string&, io::RawMesh),
                       const std::string& path, const Format& format) {
  const auto file = io::InputFile::open(path);
  if (!file) return file.error();
  auto mesh =
      guarded(finish, io::printable(path), file->size(), [&] { return format.read_file(*file); });
  // Before what was wrong in it: it may have been half of what it is to be.
  if (auto same = file->check_unchanged(); !same) return same.error();
  return mesh;
}

const Format* format_of(std::string_view extension) {
  const auto found = std::ranges::find(kFormats, extension, &Format::extension);
  return found == std::end(kFormats) ? nullptr : found;
}

Result<const Format*> format_named(std::string_view name) {
  const Format* const format = format_of("." + std::string(name));
  if (format) return format;
  std::string known;
  for (const std::string& each : mesh_formats()) known += (known.empty() ? "" : ", ") + each;
  return Error{ErrorCode::kNotAvailable,
               "'" + io::printable(name) + "' is no format of models",
               {"there are " + known}};
}

/// `name`: empty for what the extension says.
Result<const Format*> format_of_file(const std::string& path, std::string_view name) {
  if (!name.empty()) return format_named(name);
  const std::string extension = io::file_extension(path);
  if (const Format* const format = format_of(extension)) return format;
  if (auto there = io::InputFile::open(path); !there) return there.error();
  return Error{ErrorCode::kNotAvailable,
               io::printable(path) + ": unknown extension \"" + io::printable(extension) + "\"",
               {"there are .obj .ply .off .stl"}};
}

}  // namespace

std::vector<std::string> mesh_formats() {
  std::vector<std::string> names;
  for (const Format& format : kFormats) names.emplace_back(format.extension.substr(1));
  return names;
}

Result<void> check_mesh_format(std::string_view name) {
  const auto known = format_named(name);
  if (!known) return known.error();
  return {};
}

Result<io::RawMesh> io::read_raw_mesh(const std::string& path) {
  const auto known = format_of_file(path, {});
  if (!known) return known.error();
  return read_file<io::RawMesh>(
      [](const std::string&, io::RawMesh raw) { return Result<io::RawMesh>(std::move(raw)); }, path,
      **known);
}

Result<MeshFile> read_mesh(const std::string& path) {
  const auto known = format_of_file(path, {});
  if (!known) return known.error();
  return read_file(mesh_file, path, **known);
}

Result<MeshFile> read_mesh(const std::string& path, std::string_view format) {
  const auto known = format_named(format);
  if (!known) return known.error();
  return read_file(mesh_file, path, **known);
}

Result<PolygonMesh> read_polygons(const std::string& path, std::string_view format,
                                  std::vector<std::string>* notes) {
  const auto known = format_of_file(path, format);
  if (!known) return known.error();
  auto file = read_file(polygon_file, path, **known);
  if (!file) return file.error();
  if (notes != nullptr) *notes = std::move(file->notes);
  return std::move(file->mesh);
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

Result<MeshFile> read_mesh(int descriptor, std::string_view format, const std::string& name) {
  const auto known = format_named(format);
  if (!known) return known.error();
  const auto stream = io::StreamBytes::read(descriptor, name);
  if (!stream) return stream.error();
  return guarded(mesh_file, name, stream->bytes().size(),
                 [&] { return (*known)->read(stream->bytes()); });
}

}  // namespace geotherm
