// SPDX-License-Identifier: MIT
#include "geotherm/io.h"

#include <algorithm>

#include "solver/core/text.h"
#include "solver/mesh/io/format_writers.h"
#include "solver/mesh/output_file.h"

namespace geotherm {
Result<void> check_distance_path(const std::string& path) {
  const std::string extension = io::file_extension(path);
  if (extension == ".obj" || extension == ".off" || extension == ".stl") {
    return Error{ErrorCode::kNotAvailable,
                 io::printable(path) + ": " + extension + " holds no value per vertex",
                 {"write .ply or .vtp (mesh and distance) or .csv or .npy (distance alone)"}};
  }
  return check_written(path, ".csv .npy .ply .vtp");
}

Result<void> check_field(const std::string& path, const DataField& field) {
  const auto fits = [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_';
  };
  if (field.name.empty() || !std::ranges::all_of(field.name, fits)) {
    return Error{ErrorCode::kBadInput,
                 io::printable(path) + ": a field is called \"" + io::printable(field.name) + "\"",
                 {"its name may hold letters, digits and _"}};
  }
  const std::string extension = io::written_extension(path);
  if (extension == ".ply" || extension == ".vtp" || extension == ".vtu") return {};
  const bool on_faces = field.place == DataField::Place::kFaces;
  if ((extension == ".csv" || extension == ".vti") && !on_faces) return {};
  return Error{ErrorCode::kNotAvailable,
               io::printable(path) + ": " + extension + " holds no field \"" + field.name +
                   (on_faces ? "\", which has a value per face" : "\" beside the distances"),
               {on_faces ? "write .ply or .vtp" : "write .csv, .ply or .vtp"}};
}

Result<void> write_distances(const std::string& path, const TriangleMesh& mesh,
                             std::span<const double> distances, std::span<const Index> nearest,
                             std::span<const DataField> fields) {
  if (Result<void> known = check_distance_path(path); !known) return known;
  for (const DataField& field : fields) {
    if (Result<void> held = check_field(path, field); !held) return held;
  }
  if (distances.size() != mesh.positions().size()) {
    return Error{ErrorCode::kBadInput, io::printable(path) + ": " +
                                           std::to_string(distances.size()) + " distances for " +
                                           std::to_string(mesh.vertex_count()) + " vertices"};
  }
  return write_made(path, [&]() -> Result<std::string> {
    const std::string extension = io::written_extension(path);
    if (extension == ".npy") return io::npy_bytes(distances, nearest);
    if (extension == ".ply") return io::ply_bytes(mesh, distances, nearest, fields);
    if (extension == ".vtp") return io::vtp_bytes(mesh, distances, nearest, fields);
    return io::csv_bytes(distances, nearest, fields);
  });
}

Result<void> check_mesh_path(const std::string& path) {
  return check_written(path, ".obj .ply .off .stl");
}

Result<void> write_mesh(const std::string& path, const TriangleMesh& mesh) {
  if (Result<void> known = check_mesh_path(path); !known) return known;
  const std::string extension = io::file_extension(path);
  return write_made(path, [&]() -> Result<std::string> {
    if (extension == ".ply") return io::ply_bytes(mesh);
    if (extension == ".off") return io::off_bytes(mesh);
    if (extension == ".stl") return io::stl_bytes(mesh);
    return io::obj_bytes(mesh);
  });
}

}  // namespace geotherm
