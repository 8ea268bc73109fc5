// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstring>
#include <memory>
#include <new>
#include <stdexcept>
#include <utility>

#include "geotherm/domains.h"
#include "geotherm/mesh.h"
#include "solver/grid/io/raw_grid.h"
#include "solver/mesh/io/gifti_reader.h"
#include "solver/mesh/io/gzip.h"
#include "solver/mesh/io/input_file.h"
#include "solver/mesh/io/mask_numbers.h"
#include "solver/mesh/io/raw_elements.h"
#include "solver/points/io/raw_points.h"
#include "solver/volume/io/tetgen_reader.h"
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

/// `read` gives what is wrong with what it read.
template <class Read>
std::string reading_fault(Bytes bytes, const Read& read) {
  // A block of its own, so that reading beyond the padding is seen.
  const std::size_t padded = bytes.size() + io::FileBytes::kPadding;
  const auto copy = std::make_unique<char[]>(padded);
  if (!bytes.empty()) std::memcpy(copy.get(), bytes.data(), bytes.size());
  try {
    return read(std::string_view(copy.get(), bytes.size()));
  } catch (const io::ReadFailure& failure) {
    return message_fault(failure.message);
  } catch (const std::bad_alloc&) {
    return "memory was asked for that the file cannot need";
  } catch (const std::length_error&) {
    return "an array was asked for that the file cannot need";
  }
}

std::string read_fault(Reader read, Bytes bytes) {
  return reading_fault(bytes, [read](std::string_view text) { return mesh_fault(read(text)); });
}

/// Of tets and faces.
std::string elements_fault(io::RawElements raw) {
  const auto vertices = static_cast<Index>(raw.positions.size());
  for (const auto& tet : raw.tets) {
    for (const Index corner : tet) {
      if (corner < 0 || corner >= vertices) return "a tet has a corner that is no vertex";
    }
  }
  return mesh_fault(std::move(raw));
}

template <io::RawElements (*Read)(std::string_view)>
std::string elements_read_fault(Bytes bytes) {
  return reading_fault(bytes, [](std::string_view text) { return elements_fault(Read(text)); });
}

template <io::RawPoints (*Read)(std::string_view)>
std::string points_read_fault(Bytes bytes) {
  return reading_fault(bytes, [](std::string_view text) -> std::string {
    io::RawPoints raw = Read(text);
    const bool empty = raw.positions.empty();
    const auto points = PointCloud::build(std::move(raw.positions), std::move(raw.normals));
    return points || empty ? "" : "unchecked: " + sentence(points.error());
  });
}

std::string grid_fault(const io::RawGrid& raw) {
  return io::count_samples(raw.size) == raw.values.size() ? "" : "a grid without all its samples";
}

template <io::RawGrid (*Read)(std::string_view)>
std::string grid_read_fault(Bytes bytes) {
  return reading_fault(bytes, [](std::string_view text) { return grid_fault(Read(text)); });
}

io::RawGrid read_nrrd(std::string_view text) {
  const io::NrrdHeader header = io::read_nrrd_header(text);
  if (!header.data_file.empty()) throw io::ReadFailure{"the samples are in another file"};
  return io::read_nrrd_data(header, text.substr(header.data_begins));
}

/// Assimp may ask for memory that the file cannot need: its process has a limit for that.
std::string scene_fault(Bytes bytes, const char* format) {
  return reading_fault(bytes, [format](std::string_view text) {
    try {
      return mesh_fault(io::read_scene(text, format, {}));
    } catch (const std::bad_alloc&) {
      return std::string();
    }
  });
}

}  // namespace

std::string fuzz_obj(Bytes bytes) {
  return read_fault([](std::string_view text) { return io::read_obj(text); }, bytes);
}
std::string fuzz_ply(Bytes bytes) {
  const std::string fault = read_fault(io::read_ply, bytes);
  return fault.empty() ? points_read_fault<io::read_ply_points>(bytes) : fault;
}
std::string fuzz_off(Bytes bytes) { return read_fault(io::read_off, bytes); }
std::string fuzz_stl(Bytes bytes) { return read_fault(io::read_stl, bytes); }
std::string fuzz_vtk(Bytes bytes) { return elements_read_fault<io::read_vtk>(bytes); }
std::string fuzz_vtu(Bytes bytes) { return elements_read_fault<io::read_vtu>(bytes); }
std::string fuzz_vtp(Bytes bytes) { return elements_read_fault<io::read_vtp>(bytes); }
std::string fuzz_msh(Bytes bytes) { return elements_read_fault<io::read_gmsh>(bytes); }
std::string fuzz_mesh(Bytes bytes) { return elements_read_fault<io::read_medit>(bytes); }
std::string fuzz_meshb(Bytes bytes) { return elements_read_fault<io::read_meshb>(bytes); }

std::string fuzz_node(Bytes bytes) {
  const auto zero = std::ranges::find(bytes, std::uint8_t{0});
  const Bytes nodes(bytes.begin(), zero);
  const Bytes elements(zero == bytes.end() ? zero : zero + 1, bytes.end());
  return reading_fault(nodes, [elements](std::string_view node_text) {
    return reading_fault(elements, [&](std::string_view text) {
      return elements_fault(io::read_ele(text, io::read_node(node_text)));
    });
  });
}

std::string fuzz_gii(Bytes bytes) { return read_fault(io::read_gifti, bytes); }
std::string fuzz_fsurf(Bytes bytes) { return read_fault(io::read_freesurfer, bytes); }

std::string fuzz_mask(Bytes bytes) {
  for (const char* const extension : {".txt", ".npy", ".label", ".ply", ".gii"}) {
    const std::string fault = reading_fault(bytes, [extension](std::string_view text) {
      const auto numbers = io::read_mask_numbers(text, extension, "wall");
      return numbers.values.size() > 1100 * text.size() ? "more than the file can hold" : "";
    });
    if (!fault.empty()) return extension + (": " + fault);
  }
  return {};
}

std::string fuzz_xyz(Bytes bytes) { return points_read_fault<io::read_xyz_points>(bytes); }
std::string fuzz_pts(Bytes bytes) { return points_read_fault<io::read_pts_points>(bytes); }
std::string fuzz_pcd(Bytes bytes) { return points_read_fault<io::read_pcd_points>(bytes); }

std::string fuzz_npy(Bytes bytes) { return grid_read_fault<io::read_npy>(bytes); }
std::string fuzz_png(Bytes bytes) { return grid_read_fault<io::read_png>(bytes); }
std::string fuzz_vti(Bytes bytes) { return grid_read_fault<io::read_vti>(bytes); }
std::string fuzz_nrrd(Bytes bytes) { return grid_read_fault<read_nrrd>(bytes); }

std::string fuzz_gz(Bytes bytes) {
  constexpr std::size_t kMax = std::size_t{1} << 20;
  return reading_fault(bytes, [](std::string_view packed) {
    const auto out = io::unpack_gzip(packed, kMax, io::FileBytes::kPadding);
    return out.size() > kMax + io::FileBytes::kPadding ? "more than may be" : "";
  });
}

std::string fuzz_glb(Bytes bytes) { return scene_fault(bytes, "glb"); }
std::string fuzz_dae(Bytes bytes) { return scene_fault(bytes, "dae"); }
std::string fuzz_threemf(Bytes bytes) { return scene_fault(bytes, "3mf"); }

}  // namespace geotherm::test
