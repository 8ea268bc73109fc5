// SPDX-License-Identifier: MIT
#include "solver/mesh/read_mesh.h"

#include <algorithm>
#include <new>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "solver/mesh/io/file_extension.h"
#include "solver/mesh/io/mapped_file.h"
#include "solver/mesh/io/read_failure.h"
#include "solver/mesh/io/readers.h"
#include "solver/mesh/io/stream_bytes.h"

namespace geotherm {
namespace {

using Reader = io::RawMesh (*)(std::string_view bytes);

struct Format {
  std::string_view extension;
  Reader read;
};

constexpr Format kFormats[] = {
    {".obj", io::read_obj}, {".ply", io::read_ply}, {".off", io::read_off}, {".stl", io::read_stl}};

Result<MeshFile> finish(const std::string& name, io::RawMesh raw) {
  for (const io::Polygon& polygon : raw.polygons) {
    io::triangulate_polygon(raw.positions,
                            std::span(raw.faces).subspan(polygon.first_face, polygon.face_count));
  }
  Result<TriangleMesh> mesh = TriangleMesh::build(std::move(raw.positions), std::move(raw.faces));
  if (!mesh) return Error{ErrorCode::kBadFile, name + ": " + mesh.error().message};
  return MeshFile{*std::move(mesh), static_cast<Index>(raw.polygons.size()),
                  static_cast<Index>(raw.welded), std::move(raw.notes)};
}

/// Precondition: padding behind the bytes.
Result<MeshFile> read_bytes(const std::string& name, std::string_view bytes, const Format& format) {
  try {
    return finish(name, format.read(bytes));
  } catch (const io::ReadFailure& failure) {
    return Error{ErrorCode::kBadFile, name + ": " + failure.message};
  } catch (const std::bad_alloc&) {
  } catch (const std::length_error&) {
  }
  return Error{ErrorCode::kOutOfMemory, name + ": not enough memory for the mesh in its " +
                                            std::to_string(bytes.size()) + " bytes"};
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
               "'" + io::printable(name) + "' is no format of models; there are " + known};
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
  const std::string shown = io::printable(path);
  Result<io::MappedFile> file = io::MappedFile::open(path);
  if (!file) return file.error();
  const std::string extension = io::file_extension(path);
  if (const Format* const format = format_of(extension)) {
    return read_bytes(shown, file->bytes(), *format);
  }
  return Error{ErrorCode::kNotAvailable, shown + ": unknown extension \"" +
                                             io::printable(extension) +
                                             "\"; there are .obj .ply .off .stl"};
}

Result<MeshFile> read_mesh(const std::string& path, std::string_view format) {
  const auto known = format_named(format);
  if (!known) return known.error();
  Result<io::MappedFile> file = io::MappedFile::open(path);
  if (!file) return file.error();
  return read_bytes(io::printable(path), file->bytes(), **known);
}

Result<MeshFile> read_mesh(int descriptor, std::string_view format, const std::string& name) {
  const auto known = format_named(format);
  if (!known) return known.error();
  const auto stream = io::StreamBytes::read(descriptor, name);
  if (!stream) return stream.error();
  return read_bytes(name, stream->bytes(), **known);
}

}  // namespace geotherm
