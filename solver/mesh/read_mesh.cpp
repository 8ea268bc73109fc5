// SPDX-License-Identifier: MIT
#include "geotherm/io.h"

#include <algorithm>
#include <new>
#include <stdexcept>
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

Result<MeshFile> finish(const std::string& name, io::RawMesh raw) {
  io::PolygonCutter cutter(raw.faces.size());
  for (const io::Polygon& polygon : raw.polygons) {
    const std::span fan = std::span(raw.faces).subspan(polygon.first_face, polygon.face_count);
    if (!cutter.triangulate(raw.positions, fan)) {
      return Error{ErrorCode::kBadFile,
                   name + ": a polygon with " + std::to_string(polygon.face_count + 2) +
                       " corners needs more than the " + std::to_string(cutter.most_tests()) +
                       " tests of points that all polygons of this file may take",
                   {"triangulate it in the program that wrote it"}};
    }
  }
  Result<TriangleMesh> mesh = TriangleMesh::build(std::move(raw.positions), std::move(raw.faces));
  if (!mesh)
    return Error{ErrorCode::kBadFile, name + ": " + mesh.error().message, mesh.error().hint};
  return MeshFile{*std::move(mesh), static_cast<Index>(raw.polygons.size()),
                  static_cast<Index>(raw.welded), std::move(raw.notes)};
}

/// `read` gives a RawMesh; `size`: bytes of the file.
template <class Read>
Result<MeshFile> guarded(const std::string& name, std::size_t size, const Read& read) {
  try {
    return finish(name, read());
  } catch (const io::ReadFailure& failure) {
    return Error{ErrorCode::kBadFile, name + ": " + failure.message, failure.hint};
  } catch (const std::bad_alloc&) {
  } catch (const std::length_error&) {
  }
  return Error{ErrorCode::kOutOfMemory,
               name + ": not enough memory for the mesh in its " + std::to_string(size) + " bytes"};
}

Result<MeshFile> read_file(const std::string& path, const Format& format) {
  const auto file = io::InputFile::open(path);
  if (!file) return file.error();
  auto mesh = guarded(io::printable(path), file->size(), [&] { return format.read_file(*file); });
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

Result<MeshFile> read_mesh(const std::string& path) {
  const std::string extension = io::file_extension(path);
  if (const Format* const format = format_of(extension)) return read_file(path, *format);
  if (auto there = io::InputFile::open(path); !there) return there.error();
  return Error{ErrorCode::kNotAvailable,
               io::printable(path) + ": unknown extension \"" + io::printable(extension) + "\"",
               {"there are .obj .ply .off .stl"}};
}

Result<MeshFile> read_mesh(const std::string& path, std::string_view format) {
  const auto known = format_named(format);
  if (!known) return known.error();
  return read_file(path, **known);
}

Result<MeshFile> read_mesh(int descriptor, std::string_view format, const std::string& name) {
  const auto known = format_named(format);
  if (!known) return known.error();
  const auto stream = io::StreamBytes::read(descriptor, name);
  if (!stream) return stream.error();
  return guarded(name, stream->bytes().size(), [&] { return (*known)->read(stream->bytes()); });
}

}  // namespace geotherm
