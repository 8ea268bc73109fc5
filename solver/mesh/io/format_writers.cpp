// SPDX-License-Identifier: MIT
#include "solver/mesh/io/format_writers.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>

#include "solver/mesh/io/byte_order.h"
#include "solver/mesh/io/vtk_writer.h"

namespace geotherm::io {
namespace {

template <class T>
requires std::integral<T> || std::floating_point<T>
void append(std::string& text, T value) {
  char digits[32];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

void append(std::string& text, const Vec3& p) {
  append(text, p.x());
  text += ' ';
  append(text, p.y());
  text += ' ';
  append(text, p.z());
  text += '\n';
}

}  // namespace

std::string csv_bytes(std::span<const double> distances, std::span<const Index> nearest,
                      std::span<const DataField> fields) {
  std::string text = nearest.empty() ? "vertex,distance" : "vertex,distance,nearest_source";
  for (const DataField& field : fields) text += ',' + field.name;
  text += '\n';
  text.reserve((28 + 20 * fields.size()) * distances.size() + text.size());
  for (std::size_t v = 0; v < distances.size(); ++v) {
    append(text, v);
    text += ',';
    append(text, distances[v]);
    if (!nearest.empty()) {
      text += ',';
      append(text, nearest[v]);
    }
    for (const DataField& field : fields) {
      text += ',';
      append(text, field.values[v]);
    }
    text += '\n';
  }
  return text;
}

std::string obj_bytes(const TriangleMesh& mesh) {
  std::string text;
  text.reserve(64 * mesh.positions().size() + 24 * mesh.faces().size());
  for (const Vec3& p : mesh.positions()) {
    text += "v ";
    append(text, p);
  }
  for (const Face& face : mesh.faces()) {
    text += 'f';
    for (const Index corner : face) {
      text += ' ';
      append(text, std::int64_t{corner} + 1);
    }
    text += '\n';
  }
  return text;
}

std::string off_bytes(const TriangleMesh& mesh) {
  std::string text = "OFF\n";
  text.reserve(64 * mesh.positions().size() + 24 * mesh.faces().size());
  append(text, mesh.vertex_count());
  text += ' ';
  append(text, mesh.face_count());
  text += " 0\n";
  for (const Vec3& p : mesh.positions()) append(text, p);
  for (const Face& face : mesh.faces()) {
    text += '3';
    for (const Index corner : face) {
      text += ' ';
      append(text, corner);
    }
    text += '\n';
  }
  return text;
}

namespace {

constexpr auto kOnVertices = DataField::Place::kVertices;
constexpr auto kOnFaces = DataField::Place::kFaces;

bool is_small(const DataField& field) { return field.type == DataField::Type::kUint8; }

bool has_face_field(std::span<const DataField> fields) {
  return std::ranges::any_of(fields, [](const DataField& each) { return each.place == kOnFaces; });
}

std::string ply_properties(std::span<const DataField> fields, DataField::Place place) {
  std::string text;
  for (const DataField& field : fields) {
    if (field.place != place) continue;
    text += (is_small(field) ? "property uchar " : "property double ") + field.name + '\n';
  }
  return text;
}

}  // namespace

std::string npy_header(const std::string& type, std::span<const std::uint64_t> shape) {
  constexpr std::size_t kPreamble = 10;  // magic, version, length of the header
  constexpr std::size_t kAlignment = 64;
  std::string header = "{'descr': '" + type + "', 'fortran_order': False, 'shape': (";
  for (std::size_t i = 0; i < shape.size(); ++i) {
    header += (i > 0 ? ", " : "") + std::to_string(shape[i]);
  }
  header += shape.size() == 1 ? ",), }" : "), }";  // () is a single number
  while ((kPreamble + header.size() + 1) % kAlignment != 0) header += ' ';
  header += '\n';
  std::string bytes("\x93NUMPY\x01\x00", 8);
  append_little(bytes, static_cast<std::uint16_t>(header.size()));
  return bytes + header;
}

std::string npy_bytes(std::span<const double> distances, std::span<const Index> nearest) {
  const std::uint64_t shape[] = {distances.size(), 2};
  std::string bytes = npy_header("<f8", std::span(shape).first(nearest.empty() ? 1 : 2));
  bytes.reserve(bytes.size() + sizeof(double) * (distances.size() + nearest.size()));
  for (std::size_t v = 0; v < distances.size(); ++v) {
    append_little(bytes, distances[v]);
    if (!nearest.empty()) append_little(bytes, static_cast<double>(nearest[v]));
  }
  return bytes;
}

namespace {

/// What the quality of an unreached vertex is: programs make a scale of it, which must end. Within
/// the range of its 32 bits.
double largest_finite(std::span<const double> values) {
  double largest = 0;
  for (const double x : values) {
    if (std::isfinite(x)) largest = std::max(largest, x);
  }
  return std::min(largest, double{std::numeric_limits<float>::max()});
}

/// The rows of a PLY file, as numbers or as text.
class PlyRows {
 public:
  PlyRows(std::string& bytes, bool ascii) : bytes_(bytes), ascii_(ascii) {}

  template <class T>
  void add(T value) {
    if (!ascii_) return io::append_little(bytes_, value);
    append(bytes_, value);
    bytes_ += ' ';
  }
  /// The value of one element in every field that has one there.
  void add(std::span<const DataField> fields, DataField::Place place, std::size_t i) {
    for (const DataField& field : fields) {
      if (field.place != place) continue;
      if (is_small(field)) {
        add(static_cast<std::uint8_t>(field.values[i]));
      } else {
        add(field.values[i]);
      }
    }
  }
  void end() {
    if (ascii_) bytes_.back() = '\n';
  }

 private:
  std::string& bytes_;
  bool ascii_;
};

}  // namespace

std::string ply_bytes(const TriangleMesh& mesh, std::span<const double> distances,
                      std::span<const Index> nearest, std::span<const DataField> fields) {
  // Readers that take binary faces one array after the other lose those with further properties.
  const bool ascii = has_face_field(fields);
  std::string bytes = std::string("ply\nformat ") + (ascii ? "ascii" : "binary_little_endian") +
                      " 1.0\nelement vertex " + std::to_string(mesh.vertex_count()) +
                      "\nproperty double x\nproperty double y\nproperty double z\n";
  if (!distances.empty()) bytes += "property double distance\nproperty float quality\n";
  if (!nearest.empty()) bytes += "property int nearest_source\n";
  bytes += ply_properties(fields, kOnVertices);
  bytes += "element face " + std::to_string(mesh.face_count()) +
           "\nproperty list uchar int vertex_indices\n";
  bytes += ply_properties(fields, kOnFaces) + "end_header\n";
  std::size_t values = 0;
  for (const DataField& field : fields) values += field.values.size() * (is_small(field) ? 1 : 8);
  bytes.reserve(bytes.size() + 40 * mesh.positions().size() + 13 * mesh.faces().size() + values);
  const double largest = largest_finite(distances);
  PlyRows rows(bytes, ascii);
  for (std::size_t v = 0; v < mesh.positions().size(); ++v) {
    for (int axis = 0; axis < 3; ++axis) rows.add(mesh.positions()[v][axis]);
    if (!distances.empty()) {
      rows.add(distances[v]);
      rows.add(static_cast<float>(std::min(distances[v], largest)));
    }
    if (!nearest.empty()) rows.add(nearest[v]);
    rows.add(fields, kOnVertices, v);
    rows.end();
  }
  for (std::size_t f = 0; f < mesh.faces().size(); ++f) {
    rows.add(std::uint8_t{3});
    for (const Index corner : mesh.faces()[f]) rows.add(corner);
    rows.add(fields, kOnFaces, f);
    rows.end();
  }
  return bytes;
}

std::string vtp_bytes(const TriangleMesh& mesh, std::span<const double> distances,
                      std::span<const Index> nearest, std::span<const DataField> fields) {
  const std::uint64_t vertices = mesh.positions().size(), faces = mesh.faces().size();
  const std::string piece = "NumberOfPoints=\"" + std::to_string(vertices) +
                            "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
                            "NumberOfPolys=\"" +
                            std::to_string(faces) + '"';
  return vtk_bytes("PolyData", "", piece, [&](VtkWriter& file) {
    file.text("<PointData Scalars=\"distance\">\n");
    file.answers(distances, nearest);
    file.fields(fields, kOnVertices);
    file.text("</PointData>\n");
    if (has_face_field(fields)) {
      file.text("<CellData>\n");
      file.fields(fields, kOnFaces);
      file.text("</CellData>\n");
    }
    file.points(vertices, [&](const auto& use) { std::ranges::for_each(mesh.positions(), use); });
    file.text("<Polys>\n");
    file.cells(mesh.faces());
    file.text("</Polys>\n");
  });
}

Result<std::string> stl_bytes(const TriangleMesh& mesh) {
  constexpr std::size_t kHeader = 80;
  std::string bytes = "binary STL, geotherm";
  bytes.resize(kHeader, ' ');
  bytes.reserve(kHeader + 4 + 50 * mesh.faces().size());
  append_little(bytes, static_cast<std::uint32_t>(mesh.face_count()));
  const auto append_floats = [&bytes](const Vec3& p) {
    for (int axis = 0; axis < 3; ++axis) append_little(bytes, static_cast<float>(p[axis]));
  };
  for (const Face& face : mesh.faces()) {
    const auto at = [&](std::size_t k) -> const Vec3& {
      return mesh.positions()[static_cast<std::size_t>(face[k])];
    };
    const Vec3 area = (at(1) - at(0)).cross(at(2) - at(0));
    const bool has_normal = area.norm() > 0 && std::isfinite(area.norm());
    append_floats(has_normal ? Vec3(area / area.norm()) : Vec3(Vec3::Zero()));
    for (std::size_t k = 0; k < 3; ++k) {
      if (at(k).cwiseAbs().maxCoeff() > double{std::numeric_limits<float>::max()}) {
        return Error{
            ErrorCode::kBadInput,
            "vertex " + std::to_string(face[k]) + " is too far away for the 32-bit numbers of STL",
            {"write .ply, .obj or .off"}};
      }
      append_floats(at(k));
    }
    append_little(bytes, std::uint16_t{0});
  }
  return bytes;
}

}  // namespace geotherm::io
