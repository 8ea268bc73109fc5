// SPDX-License-Identifier: MIT
#include <Eigen/Core>
#include <algorithm>
#include <charconv>
#include <cstdint>
#include <new>
#include <string>

#include "geotherm/domains.h"
#include "solver/core/text.h"
#include "solver/mesh/io/byte_order.h"
#include "solver/mesh/io/format_writers.h"
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

/// A .vtu file that is built in two passes over the same arrays: the XML says where each begins,
/// and the appended bytes hold, one after the other, its length and its numbers.
class VtuWriter {
 public:
  /// Calls append(bytes) later, for `values` numbers of `size` bytes each.
  template <class Append>
  void array(const std::string& attributes, std::uint64_t values, std::uint64_t size,
             const Append& append) {
    if (in_xml_) {
      text_ += "<DataArray " + attributes + " format=\"appended\" offset=\"" +
               std::to_string(offset_) + "\"/>\n";
      offset_ += sizeof(std::uint64_t) + values * size;
    } else {
      io::append_little(text_, values * size);
      append(text_);
    }
  }

  void text(const std::string& xml) {
    if (in_xml_) text_ += xml;
  }

  /// After the first pass over the arrays.
  void begin_data() {
    text_ += "<AppendedData encoding=\"raw\">\n_";
    text_.reserve(text_.size() + offset_ + 64);
    in_xml_ = false;
  }

  std::string finish() && {
    text_ += "\n</AppendedData>\n</VTKFile>\n";
    return std::move(text_);
  }

 private:
  std::string text_;
  std::uint64_t offset_ = 0;
  bool in_xml_ = true;
};

/// What is written beside the mesh itself.
struct VtuData {
  std::span<const double> distances;
  std::span<const Index> nearest;
  std::span<const DataField> fields;
};

void put_field(VtuWriter& file, const DataField& field) {
  const bool small = field.type == DataField::Type::kUint8;
  file.array(
      std::string(small ? "type=\"UInt8\"" : "type=\"Float64\"") + " Name=\"" + field.name + '"',
      field.values.size(), small ? 1 : sizeof(double), [&](std::string& bytes) {
        for (const double value : field.values) {
          if (small) {
            io::append_little(bytes, static_cast<std::uint8_t>(value));
          } else {
            io::append_little(bytes, value);
          }
        }
      });
}

void put_fields(VtuWriter& file, const VtuData& data, DataField::Place place) {
  for (const DataField& field : data.fields) {
    if (field.place == place) put_field(file, field);
  }
}

void put_grid(VtuWriter& file, const TetMesh& mesh) {
  constexpr std::uint8_t kVtkTetType = 10;
  const std::uint64_t vertices = mesh.positions().size(), tets = mesh.tets().size();
  file.text("<Points>\n");
  file.array("type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\"", 3 * vertices, 8,
             [&mesh](std::string& bytes) {
               for (const Vec3& p : mesh.positions()) {
                 for (int axis = 0; axis < 3; ++axis) io::append_little(bytes, p[axis]);
               }
             });
  file.text("</Points>\n<Cells>\n");
  file.array("type=\"Int32\" Name=\"connectivity\"", 4 * tets, 4, [&mesh](std::string& bytes) {
    for (const Tet& tet : mesh.tets()) {
      for (const Index corner : tet) io::append_little(bytes, corner);
    }
  });
  file.array("type=\"Int64\" Name=\"offsets\"", tets, 8, [tets](std::string& bytes) {
    for (std::uint64_t t = 1; t <= tets; ++t) io::append_little(bytes, 4 * t);
  });
  file.array("type=\"UInt8\" Name=\"types\"", tets, 1,
             [tets](std::string& bytes) { bytes.append(tets, static_cast<char>(kVtkTetType)); });
  file.text("</Cells>\n");
}

std::string vtu_bytes(const TetMesh& mesh, const VtuData& data) {
  VtuWriter file;
  file.text(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
      "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<UnstructuredGrid>\n<Piece "
      "NumberOfPoints=\"" +
      std::to_string(mesh.vertex_count()) + "\" NumberOfCells=\"" +
      std::to_string(mesh.tet_count()) + "\">\n");
  for (const bool xml : {true, false}) {
    if (!xml) file.begin_data();
    file.text(data.distances.empty() ? "<PointData>\n" : "<PointData Scalars=\"distance\">\n");
    if (!data.distances.empty()) {
      file.array("type=\"Float64\" Name=\"distance\"", data.distances.size(), 8,
                 [&data](std::string& bytes) {
                   for (const double each : data.distances) io::append_little(bytes, each);
                 });
    }
    if (!data.nearest.empty()) {
      file.array("type=\"Int32\" Name=\"nearest_source\"", data.nearest.size(), 4,
                 [&data](std::string& bytes) {
                   for (const Index each : data.nearest) io::append_little(bytes, each);
                 });
    }
    put_fields(file, data, DataField::Place::kVertices);
    file.text("</PointData>\n<CellData>\n");
    put_fields(file, data, DataField::Place::kFaces);
    file.text("</CellData>\n");
    put_grid(file, mesh);
    file.text("</Piece>\n</UnstructuredGrid>\n");
  }
  return std::move(file).finish();
}

Result<void> check_extension(const std::string& path, std::span<const std::string_view> known) {
  if (path == "-") return {};
  const std::string extension = io::file_extension(path);
  std::string names;
  for (const std::string_view each : known) {
    if (extension == each) return {};
    names += (names.empty() ? "" : " ") + std::string(each);
  }
  return Error{
      ErrorCode::kNotAvailable,
      io::printable(path) + ": unknown extension \"" + io::printable(extension) + "\" for a volume",
      {"there are " + names}};
}

template <class MakeBytes>
Result<void> write_volume(const std::string& path, const MakeBytes& make_bytes) {
  try {
    return write_file(path, make_bytes());
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::kOutOfMemory, io::printable(path) + ": not enough memory to write it"};
  }
}

constexpr std::string_view kVolumeExtensions[] = {".mesh", ".vtu"};
constexpr std::string_view kVolumeDistanceExtensions[] = {".csv", ".npy", ".vtu"};

/// Whether the numbers have a value for each element, and the file a place for them.
Result<void> check_values(const std::string& path, const TetMesh& mesh, const VtuData& data) {
  const auto fails = [&path](const std::string& what, std::size_t values, std::size_t elements) {
    return Error{ErrorCode::kBadInput, io::printable(path) + ": " + std::to_string(values) + ' ' +
                                           what + " for " + std::to_string(elements) +
                                           " vertices or tetrahedra"};
  };
  const std::size_t vertices = mesh.positions().size();
  if (data.distances.size() != vertices) {
    return fails("distances", data.distances.size(), vertices);
  }
  if (!data.nearest.empty() && data.nearest.size() != vertices) {
    return fails("nearest sources", data.nearest.size(), vertices);
  }
  const std::string extension = path == "-" ? ".csv" : io::file_extension(path);
  for (const DataField& field : data.fields) {
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
  return check_extension(path, kVolumeExtensions);
}

Result<void> write_tets(const std::string& path, const TetMesh& mesh) {
  if (auto known = check_tets_path(path); !known) return known;
  const bool vtu = path != "-" && io::file_extension(path) == ".vtu";
  return write_volume(path, [&] { return vtu ? vtu_bytes(mesh, {}) : medit_bytes(mesh); });
}

Result<void> check_tet_distances_path(const std::string& path) {
  return check_extension(path, kVolumeDistanceExtensions);
}

Result<void> write_distances(const std::string& path, const TetMesh& mesh,
                             std::span<const double> distances, std::span<const Index> nearest,
                             std::span<const DataField> fields) {
  if (auto known = check_tet_distances_path(path); !known) return known;
  const VtuData data{distances, nearest, fields};
  if (auto fits = check_values(path, mesh, data); !fits) return fits;
  const std::string extension = path == "-" ? ".csv" : io::file_extension(path);
  return write_volume(path, [&] {
    if (extension == ".vtu") return vtu_bytes(mesh, data);
    if (extension == ".npy") return io::npy_bytes(distances, nearest);
    return io::csv_bytes(distances, nearest, fields);
  });
}

}  // namespace geotherm
