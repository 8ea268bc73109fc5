// SPDX-License-Identifier: MIT
#include <cstring>
#include <memory>
#include <new>
#include <stdexcept>

#include "geotherm/mesh.h"
#include "solver/mesh/io/input_file.h"
#include "solver/mesh/io/raw_mesh.h"
#include "tests/fuzz/fuzz_targets.h"

namespace geotherm::test {
namespace {

using Reader = io::RawMesh (*)(std::string_view bytes);

std::string mesh_fault(io::RawMesh raw) {
  io::PolygonCutter cutter(raw.faces.size());
  for (const io::Polygon& polygon : raw.polygons) {
    if (polygon.face_count < 2 || polygon.first_face + polygon.face_count > raw.faces.size()) {
      return "a polygon has no place among the faces";
    }
    cutter.triangulate(raw.positions,
                       std::span(raw.faces).subspan(polygon.first_face, polygon.face_count));
  }
  const bool empty = raw.faces.empty();
  const auto mesh = TriangleMesh::build(std::move(raw.positions), std::move(raw.faces));
  if (mesh) return empty ? "a mesh without faces" : "";
  // Readers check corners and coordinates themselves: they know the line.
  return empty ? message_fault(sentence(mesh.error())) : "unchecked: " + sentence(mesh.error());
}

std::string read_fault(Reader read, Bytes bytes) {
  // A block of its own, so that reading beyond the padding is seen.
  const std::size_t padded = bytes.size() + io::FileBytes::kPadding;
  const auto copy = std::make_unique<char[]>(padded);
  if (!bytes.empty()) std::memcpy(copy.get(), bytes.data(), bytes.size());
  try {
    return mesh_fault(read({copy.get(), bytes.size()}));
  } catch (const io::ReadFailure& failure) {
    return message_fault(failure.message);
  } catch (const std::bad_alloc&) {
    return "memory was asked for that the file cannot need";
  } catch (const std::length_error&) {
    return "an array was asked for that the file cannot need";
  }
}

}  // namespace

std::string fuzz_obj(Bytes bytes) {
  return read_fault([](std::string_view text) { return io::read_obj(text); }, bytes);
}
std::string fuzz_ply(Bytes bytes) { return read_fault(io::read_ply, bytes); }
std::string fuzz_off(Bytes bytes) { return read_fault(io::read_off, bytes); }
std::string fuzz_stl(Bytes bytes) { return read_fault(io::read_stl, bytes); }

}  // namespace geotherm::test
