// SPDX-License-Identifier: MIT
#include "solver/mesh/read_mesh.h"

#include <new>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "solver/mesh/io/file_extension.h"
#include "solver/mesh/io/mapped_file.h"
#include "solver/mesh/io/read_failure.h"
#include "solver/mesh/io/readers.h"

namespace geotherm {
namespace {

using Reader = io::RawMesh (*)(std::string_view bytes);

struct Format {
  std::string_view extension;
  Reader read;
};

constexpr Format kFormats[] = {
    {".obj", io::read_obj}, {".ply", io::read_ply}, {".off", io::read_off}, {".stl", io::read_stl}};

Result<MeshFile> finish(const std::string& path, io::RawMesh raw) {
  for (const io::Polygon& polygon : raw.polygons) {
    io::triangulate_polygon(raw.positions,
                            std::span(raw.faces).subspan(polygon.first_face, polygon.face_count));
  }
  Result<TriangleMesh> mesh = TriangleMesh::build(std::move(raw.positions), std::move(raw.faces));
  if (!mesh) return Error{ErrorCode::kBadFile, path + ": " + mesh.error().message};
  return MeshFile{*std::move(mesh), static_cast<Index>(raw.polygons.size()),
                  static_cast<Index>(raw.welded), std::move(raw.notes)};
}

}  // namespace

Result<MeshFile> read_mesh(const std::string& path) {
  const std::string shown = io::printable(path);
  Result<io::MappedFile> file = io::MappedFile::open(path);
  if (!file) return file.error();
  const std::string extension = io::file_extension(path);
  for (const Format& format : kFormats) {
    if (format.extension != extension) continue;
    try {
      return finish(shown, format.read(file->bytes()));
    } catch (const io::ReadFailure& failure) {
      return Error{ErrorCode::kBadFile, shown + ": " + failure.message};
    } catch (const std::bad_alloc&) {
    } catch (const std::length_error&) {
    }
    return Error{ErrorCode::kOutOfMemory, shown + ": not enough memory for the mesh in its " +
                                              std::to_string(file->bytes().size()) + " bytes"};
  }
  return Error{ErrorCode::kNotAvailable, shown + ": unknown extension \"" +
                                             io::printable(extension) +
                                             "\"; there are .obj .ply .off .stl"};
}

}  // namespace geotherm
