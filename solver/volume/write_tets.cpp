// SPDX-License-Identifier: MIT
#include <Eigen/Core>
#include <algorithm>
#include <charconv>
#include <cstdint>
#include <string>

#include "geotherm/domains.h"
#include "solver/core/text.h"
#include "solver/mesh/io/format_writers.h"
#include "solver/mesh/io/vtk_writer.h"
#include "solver/mesh/output_file.h"

namespace geotherm {
namespace {

template <class T>
void append_digits_of(std::string& text, T value) {
  char digits[32];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
  text += ' ';
}

/// Medit's text, with the fewest digits that read back as the same doubles.
std::string medit_bytes(const TetMesh& mesh) {
  std::string text = "MeshVersionFormatted 2\nDimension 3\nVertices\n" +
                     std::to_string(mesh.vertex_count()) + '\n';
  text.reserve(text.size() + 64 * mesh.positions().size() + 36 * mesh.tets().size());
  for (const Vec3& p : mesh.positions()) {
    for (int axis = 0; axis < 3; ++axis) append_digits_of(text, p[axis]);
    text += "0\n";
  }
  text += "Tetrahedra\n" + std::to_string(mesh.tet_count()) + '\n';
  for (const Tet& tet : mesh.tets()) {
    for (const Index corner : tet) append_digits_of(text, std::int64_t{corner} + 1);
    text += "0\n";
  }
  return text + "End\n";
}

std::string vtu_bytes(const TetMesh& mesh, std::span<const double> distances,
                      std::span<const Index> nearest, std::span<const DataField> fields) {
  constexpr std::uint8_t kVtkTetType = 10;
  const std::uint64_t vertices = mesh.positions().size(), tets = mesh.tets().size();
  const std::string piece = "NumberOfPoints=\"" + std::to_string(vertices) + "\" NumberOfCells=\"" +
                            std::to_string(tets) + '"';
  return io::vtk_bytes("UnstructuredGrid", "", piece, [&](io::VtkWriter& file) {
    file.text(distances.empty() ? "<PointData>\n" : "<PointData Scalars=\"distance\">\n");
    file.answers(distances, nearest);
    file.fields(fields, DataField::Place::kVertices);
    file.text("</PointData>\n<CellData>\n");
    file.fields(fields, DataField::Place::kFaces);
    file.text("</CellData>\n");
    file.points(vertices, [&](const auto& use) { std::ranges::for_each(mesh.positions(), use); });
    file.text("<Cells>\n");
    file.cells(mesh.tets());
    file.array<std::uint8_t>("types", tets, [&](const auto& put) {
      for (std::uint64_t t = 0; t < tets; ++t) put(kVtkTetType);
    });
    file.text("</Cells>\n");
  });
}

/// Whether the numbers have a value for each element, and the file a place for them.
Result<void> check_values(const std::string& path, const TetMesh& mesh,
                          std::span<const double> distances, std::span<const Index> nearest,
                          std::span<const DataField> fields) {
  const auto fails = [&path](const std::string& what, std::size_t values, std::size_t elements) {
    return Error{ErrorCode::kBadInput, io::printable(path) + ": " + std::to_string(values) + ' ' +
                                           what + " for " + std::to_string(elements) +
                                           " vertices or tetrahedra"};
  };
  const std::size_t vertices = mesh.positions().size();
  if (distances.size() != vertices) return fails("distances", distances.size(), vertices);
  if (!nearest.empty() && nearest.size() != vertices) {
    return fails("nearest sources", nearest.size(), vertices);
  }
  const std::string extension = io::written_extension(path);
  for (const DataField& field : fields) {
    const bool on_tets = field.place == DataField::Place::kFaces;
    const std::size_t elements = on_tets ? mesh.tets().size() : vertices;
    if (field.values.size() != elements) {
      return fails("values of " + io::printable(field.name), field.values.size(), elements);
    }
    if (extension == ".vtu" || (extension == ".csv" && !on_tets)) continue;
    return Error{ErrorCode::kNotAvailable,
                 io::printable(path) + ": " + extension + " holds no field \"" +
                     io::printable(field.name) + '"',
                 {"write .vtu"}};
  }
  return {};
}

}  // namespace

Result<void> check_tets_path(const std::string& path) {
  return check_written(path, ".mesh .vtu", " for a volume");
}

Result<void> write_tets(const std::string& path, const TetMesh& mesh) {
  if (auto known = check_tets_path(path); !known) return known;
  const bool vtu = io::file_extension(path) == ".vtu";
  return write_made(path, [&] { return vtu ? vtu_bytes(mesh, {}, {}, {}) : medit_bytes(mesh); });
}

Result<void> check_tet_distances_path(const std::string& path) {
  return check_written(path, ".csv .npy .vtu", " for a volume");
}

Result<void> write_distances(const std::string& path, const TetMesh& mesh,
                             std::span<const double> distances, std::span<const Index> nearest,
                             std::span<const DataField> fields) {
  if (auto known = check_tet_distances_path(path); !known) return known;
  if (auto fits = check_values(path, mesh, distances, nearest, fields); !fits) return fits;
  const std::string extension = io::written_extension(path);
  return write_made(path, [&] {
    if (extension == ".vtu") return vtu_bytes(mesh, distances, nearest, fields);
    if (extension == ".npy") return io::npy_bytes(distances, nearest);
    return io::csv_bytes(distances, nearest, fields);
  });
}

}  // namespace geotherm
