// SPDX-License-Identifier: MIT
// Surfaces of the brain: GIFTI (Harwell, Glasser and others, version 1.0), and what FreeSurfer
// writes: three bytes, two lines, the counts, places in float, corners, all big endian.
#include "solver/mesh/io/gifti_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "solver/mesh/io/byte_order.h"
#include "solver/mesh/io/input_file.h"
#include "solver/mesh/io/vtk_xml.h"

namespace geotherm::io {
namespace {

constexpr struct {
  std::string_view name;
  NumberType type;
} kNiftiTypes[] = {
    {"NIFTI_TYPE_UINT8", NumberType::kUint8},     {"NIFTI_TYPE_INT8", NumberType::kInt8},
    {"NIFTI_TYPE_INT16", NumberType::kInt16},     {"NIFTI_TYPE_UINT16", NumberType::kUint16},
    {"NIFTI_TYPE_INT32", NumberType::kInt32},     {"NIFTI_TYPE_UINT32", NumberType::kUint32},
    {"NIFTI_TYPE_INT64", NumberType::kInt64},     {"NIFTI_TYPE_UINT64", NumberType::kUint64},
    {"NIFTI_TYPE_FLOAT32", NumberType::kFloat32}, {"NIFTI_TYPE_FLOAT64", NumberType::kFloat64}};

struct GiftiArray {
  std::string_view intent;
  VtuArray array;
  VtuEncoding encoding;
  std::int64_t rows = 0, columns = 1;
  bool column_major = false;
};

GiftiArray read_array_tag(std::string_view bytes, const XmlTag& tag) {
  GiftiArray out;
  out.intent = attribute(tag, "Intent").value_or("");
  const std::string_view type = attribute(tag, "DataType").value_or("");
  const auto* const known = std::ranges::find(kNiftiTypes, type, [](auto& t) { return t.name; });
  if (known == std::end(kNiftiTypes)) {
    fail_at_tag(bytes, tag, "the type of numbers " + quoted(type, type.data()) + " is unknown");
  }
  out.array.type = known->type;
  const std::string_view encoding = attribute(tag, "Encoding").value_or("");
  if (encoding != "ASCII" && encoding != "Base64Binary" && encoding != "GZipBase64Binary") {
    fail_at_tag(bytes, tag,
                "the encoding " + quoted(encoding, encoding.data()) + " is not supported",
                {"save it as GZipBase64Binary"});
  }
  out.array.format = encoding == "ASCII" ? VtuArray::Format::kText : VtuArray::Format::kBase64;
  out.encoding.size_of_length = 0;
  out.encoding.compressed = encoding == "GZipBase64Binary";
  if (attribute(tag, "Endian") == "BigEndian") out.encoding.order = std::endian::big;
  out.column_major = attribute(tag, "ArrayIndexingOrder") == "ColumnMajorOrder";
  const std::int64_t dimensions = vtk_number(bytes, tag, "Dimensionality");
  out.rows = vtk_number(bytes, tag, "Dim0");
  if (dimensions > 1) out.columns = vtk_number(bytes, tag, "Dim1");
  const std::uint64_t most = kMaxVtkNumbers * bytes.size();
  const bool fits = out.columns == 0 || static_cast<std::uint64_t>(out.rows) <=
                                            most / static_cast<std::uint64_t>(out.columns);
  if (dimensions < 1 || dimensions > 2 || !fits) {
    fail_at_tag(bytes, tag,
                "an array of " + std::to_string(dimensions) + " dimensions, " +
                    std::to_string(out.rows) + " x " + std::to_string(out.columns) +
                    ", does not fit in " + std::to_string(bytes.size()) + " bytes");
  }
  return out;
}

std::vector<GiftiArray> arrays_of(std::string_view bytes) {
  std::vector<GiftiArray> out;
  bool is_gifti = false, open = false;
  XmlTags tags(bytes);
  while (const auto tag = tags.next()) {
    is_gifti = is_gifti || tag->name == "GIFTI";
    if (tag->name == "DataArray") {
      out.push_back(read_array_tag(bytes, *tag));
      open = true;
    } else if (tag->name == "Data" && open) {
      out.back().array.place = tag->behind;
      open = false;
    }
  }
  if (!is_gifti) fail_at_line(bytes, bytes.data(), "there is no tag GIFTI");
  std::erase_if(out, [](const GiftiArray& each) { return each.array.place == 0; });
  return out;
}

/// The bytes up to the end of the array, so that nothing behind it is taken for a part of it.
std::string_view until_end(std::string_view bytes, const GiftiArray& array) {
  return bytes.substr(0, bytes.find('<', static_cast<std::size_t>(array.array.place)));
}

const GiftiArray& surface_array(std::string_view bytes, const std::vector<GiftiArray>& arrays,
                                const char* intent) {
  const auto found =
      std::ranges::find(arrays, std::string("NIFTI_INTENT_") + intent, &GiftiArray::intent);
  if (found == arrays.end()) {
    fail_at_line(bytes, bytes.data(), std::string("there is no array ") + intent,
                 {"take the file of a surface (.surf.gii); masks and values have none"});
  }
  if (found->columns != 3) {
    fail_at_line(bytes, found->intent.data(),
                 std::string("the array ") + intent + " has " + std::to_string(found->columns) +
                     " columns instead of 3");
  }
  return *found;
}

/// The place of number (row, column) in the array.
std::size_t place_in(const GiftiArray& array, std::int64_t row, int column) {
  return static_cast<std::size_t>(array.column_major ? column * array.rows + row
                                                     : row * array.columns + column);
}

Face face_of(const std::array<std::int64_t, 3>& corners, std::int64_t number,
             std::size_t vertices) {
  Face face;
  for (std::size_t k = 0; k < 3; ++k) {
    if (corners[k] < 0 || static_cast<std::uint64_t>(corners[k]) >= vertices) {
      throw ReadFailure{"face " + std::to_string(number) + " uses vertex " +
                        std::to_string(corners[k]) + ", but there are " + std::to_string(vertices) +
                        " vertices"};
    }
    face[k] = static_cast<Index>(corners[k]);
  }
  return face;
}

/// Big-endian numbers, one after the other.
class BigEndianBytes {
 public:
  BigEndianBytes(std::string_view bytes, std::size_t at) : bytes_(bytes), at_(at) {}

  template <class T>
  T take(const char* what) {
    if (bytes_.size() - at_ < sizeof(T)) fail(std::string("the file ends in ") + what);
    const T value = load<T>(bytes_.data() + at_, std::endian::big);
    at_ += sizeof(T);
    return value;
  }
  std::size_t left() const { return bytes_.size() - at_; }
  [[noreturn]] void fail(const std::string& cause) const {
    fail_at_byte(bytes_, bytes_.data() + at_, cause);
  }

 private:
  std::string_view bytes_;
  std::size_t at_;
};

}  // namespace

RawMesh read_gifti(std::string_view bytes) {
  const std::vector<GiftiArray> arrays = arrays_of(bytes);
  const GiftiArray& points = surface_array(bytes, arrays, "POINTSET");
  const GiftiArray& triangles = surface_array(bytes, arrays, "TRIANGLE");
  RawMesh mesh;
  const auto places = read_vtu_reals(until_end(bytes, points), points.encoding, points.array,
                                     "POINTSET", points.rows * 3);
  mesh.positions.resize(static_cast<std::size_t>(points.rows));
  for (std::int64_t v = 0; v < points.rows; ++v) {
    for (int axis = 0; axis < 3; ++axis) {
      mesh.positions[static_cast<std::size_t>(v)][axis] = places[place_in(points, v, axis)];
    }
  }
  const auto corners = read_vtu_integers(until_end(bytes, triangles), triangles.encoding,
                                         triangles.array, "TRIANGLE", triangles.rows * 3);
  mesh.faces.reserve(static_cast<std::size_t>(triangles.rows));
  for (std::int64_t f = 0; f < triangles.rows; ++f) {
    std::array<std::int64_t, 3> face{};
    for (int k = 0; k < 3; ++k) {
      face[static_cast<std::size_t>(k)] = corners[place_in(triangles, f, k)];
    }
    mesh.faces.push_back(face_of(face, f, mesh.positions.size()));
  }
  return mesh;
}

std::vector<double> read_gifti_numbers(std::string_view bytes) {
  for (const GiftiArray& array : arrays_of(bytes)) {
    if (array.intent == "NIFTI_INTENT_POINTSET" || array.intent == "NIFTI_INTENT_TRIANGLE")
      continue;
    if (array.columns != 1) continue;
    return read_vtu_reals(until_end(bytes, array), array.encoding, array.array, "of values",
                          array.rows, false);
  }
  fail_at_line(bytes, bytes.data(), "there is no array of one number for each vertex",
               {"take the file of a mask (.shape.gii, .func.gii, .label.gii)"});
}

RawMesh read_freesurfer(std::string_view bytes) {
  if (!bytes.starts_with("\xff\xff\xfe")) {
    fail_at_byte(bytes, bytes.data(), "a surface of FreeSurfer begins with the bytes ff ff fe",
                 {"surfaces of triangles alone are read"});
  }
  const std::size_t end = bytes.find("\n\n");
  if (end == bytes.npos) fail_at_byte(bytes, bytes.data() + 3, "its first lines do not end");
  BigEndianBytes source(bytes, end + 2);
  const auto vertices = source.take<std::int32_t>("its counts");
  const auto faces = source.take<std::int32_t>("its counts");
  const bool counts = vertices >= 0 && faces >= 0;
  if (!counts || (static_cast<std::uint64_t>(vertices) + static_cast<std::uint64_t>(faces)) * 12 >
                     source.left()) {
    source.fail(std::to_string(vertices) + " vertices and " + std::to_string(faces) +
                " faces are announced, and " + std::to_string(source.left()) + " bytes follow");
  }
  RawMesh mesh;
  mesh.positions.resize(static_cast<std::size_t>(vertices));
  for (Vec3& place : mesh.positions) {
    for (int axis = 0; axis < 3; ++axis) {
      place[axis] = static_cast<double>(source.take<float>("its vertices"));
      if (!std::isfinite(place[axis])) source.fail("a coordinate is not finite");
    }
  }
  mesh.faces.reserve(static_cast<std::size_t>(faces));
  for (std::int32_t f = 0; f < faces; ++f) {
    std::array<std::int64_t, 3> corners{};
    for (auto& corner : corners) corner = source.take<std::int32_t>("its faces");
    mesh.faces.push_back(face_of(corners, f, mesh.positions.size()));
  }
  return mesh;
}

}  // namespace geotherm::io
