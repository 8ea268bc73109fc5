// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "solver/core/text.h"
#include "solver/mesh/io/byte_order.h"
#include "solver/mesh/io/input_file.h"
#include "solver/mesh/io/ply_header.h"
#include "solver/mesh/io/raw_mesh.h"
#include "solver/mesh/io/text_scanner.h"

namespace geotherm::io {
namespace {

/// What messages call a row; the name in the file may hold anything.
const char* row_name(const PlyElement& element) {
  if (element.name == "vertex") return "vertex";
  return element.name == "face" ? "face" : "row";
}

/// The values of an ASCII body, as words.
class AsciiBody {
 public:
  AsciiBody(std::string_view bytes, const PlyHeader& header)
      : scanner_(bytes, '\0', static_cast<std::size_t>(header.body - bytes.data())) {}

  void now_reading(const PlyElement& element, std::int64_t row) {
    scanner_.now_reading(row_name(element), row + 1, element.count);
  }
  double number(PlyType) { return scanner_.number(); }
  double coordinate(PlyType) { return scanner_.coordinate(); }
  std::int64_t integer(PlyType) { return scanner_.integer(); }
  [[noreturn]] void fail(const std::string& cause) const { scanner_.fail(cause); }
  std::size_t bytes_left() { return scanner_.at_end() ? 0 : scanner_.bytes_left(); }

 private:
  TextScanner scanner_;
};

/// The values of a binary body, as bytes in the given order.
template <std::endian Order>
class BinaryBody {
 public:
  BinaryBody(std::string_view bytes, const PlyHeader& header)
      : bytes_(bytes), p_(header.body), end_(bytes.data() + bytes.size()) {}

  void now_reading(const PlyElement& element, std::int64_t row) {
    element_ = &element;
    row_ = row;
  }

  double number(PlyType type) {
    return take(type, [](auto value) { return static_cast<double>(value); });
  }

  double coordinate(PlyType type) {
    const double value = number(type);
    if (!std::isfinite(value)) fail("a coordinate is not finite");
    return value;
  }

  std::int64_t integer(PlyType type) {
    return take(type, [this](auto value) {
      if constexpr (std::is_floating_point_v<decltype(value)>) {
        if (!(std::abs(value) < 1e9 && value == std::floor(value))) fail("an index is not whole");
      }
      return static_cast<std::int64_t>(value);
    });
  }

  [[noreturn]] void fail(const std::string& cause) const {
    fail_at_byte(bytes_, last_,
                 cause + " in " + row_name(*element_) + ' ' + std::to_string(row_ + 1) + " of " +
                     std::to_string(element_->count));
  }

  std::size_t bytes_left() const { return static_cast<std::size_t>(end_ - p_); }

 private:
  template <class Use>
  auto take(PlyType type, const Use& use) {
    switch (type) {
      case PlyType::kInt8:
        return use(take<std::int8_t>());
      case PlyType::kUint8:
        return use(take<std::uint8_t>());
      case PlyType::kInt16:
        return use(take<std::int16_t>());
      case PlyType::kUint16:
        return use(take<std::uint16_t>());
      case PlyType::kInt32:
        return use(take<std::int32_t>());
      case PlyType::kUint32:
        return use(take<std::uint32_t>());
      case PlyType::kFloat32:
        return use(take<float>());
      case PlyType::kFloat64:
        break;
    }
    return use(take<double>());
  }

  template <class T>
  T take() {
    last_ = p_;
    if (bytes_left() < sizeof(T)) fail("the file ends");
    p_ += sizeof(T);
    return load<T>(last_, Order);
  }

  std::string_view bytes_;
  const char* p_;
  const char* end_;
  const char* last_ = p_;  ///< start of the last value
  const PlyElement* element_ = nullptr;
  std::int64_t row_ = 0;
};

template <class Body>
std::int64_t list_length(Body& body, const PlyProperty& property) {
  const std::int64_t length = body.integer(property.count_type);
  if (length < 0 || static_cast<std::uint64_t>(length) > body.bytes_left()) {
    body.fail("a list of " + std::to_string(length) + " items does not fit");
  }
  return length;
}

template <class Body>
void skip(Body& body, const PlyProperty& property) {
  const std::int64_t count = property.is_list ? list_length(body, property) : 1;
  for (std::int64_t k = 0; k < count; ++k) body.number(property.type);
}

template <class Body>
void skip_rows(Body& body, const PlyElement& element) {
  if (element.properties.empty()) return;
  for (std::int64_t row = 0; row < element.count; ++row) {
    body.now_reading(element, row);
    for (const PlyProperty& property : element.properties) skip(body, property);
  }
}

template <class Body>
void read_vertices(Body& body, const PlyElement& element, RawMesh& mesh) {
  std::vector<int> axis_of(element.properties.size(), -1);
  constexpr std::array<std::string_view, 3> kAxes = {"x", "y", "z"};
  for (int axis = 0; axis < 3; ++axis) {
    const int property = element.find(kAxes[static_cast<std::size_t>(axis)], false);
    axis_of[static_cast<std::size_t>(property)] = axis;
  }
  mesh.positions.resize(static_cast<std::size_t>(element.count));
  for (std::int64_t row = 0; row < element.count; ++row) {
    body.now_reading(element, row);
    for (std::size_t k = 0; k < axis_of.size(); ++k) {
      if (axis_of[k] < 0) {
        skip(body, element.properties[k]);
      } else {
        mesh.positions[static_cast<std::size_t>(row)][axis_of[k]] =
            body.coordinate(element.properties[k].type);
      }
    }
  }
}

template <class Body>
void read_corners(Body& body, const PlyProperty& list, std::int64_t vertex_count, FanBuilder& fan) {
  const std::int64_t corner_count = list_length(body, list);
  for (std::int64_t k = 0; k < corner_count; ++k) {
    const std::int64_t corner = body.integer(list.type);
    if (corner < 0 || corner >= vertex_count) {
      body.fail("vertex " + std::to_string(corner) + " is used, but the file has " +
                std::to_string(vertex_count) + " vertices (0 to " +
                std::to_string(vertex_count - 1) + ")");
    }
    fan.add(static_cast<Index>(corner));
  }
}

template <class Body>
void read_faces(Body& body, const PlyElement& element, std::size_t corners,
                std::int64_t vertex_count, RawMesh& mesh) {
  mesh.faces.reserve(static_cast<std::size_t>(element.count));
  FanBuilder fan(mesh.faces);
  std::size_t skipped = 0;
  for (std::int64_t row = 0; row < element.count; ++row) {
    body.now_reading(element, row);
    for (std::size_t k = 0; k < element.properties.size(); ++k) {
      if (k == corners) {
        read_corners(body, element.properties[k], vertex_count, fan);
      } else {
        skip(body, element.properties[k]);
      }
    }
    if (fan.corners() < 3) ++skipped;
    fan.end(mesh.polygons);
  }
  if (skipped > 0) {
    mesh.notes.push_back(counted_text(skipped, "face", "faces") + " with fewer than 3 corners " +
                         (skipped == 1 ? "was" : "were") + " left out");
  }
}

/// What the file must have to be a mesh; returns the property with the corners of a face.
std::size_t check_elements(std::string_view bytes, const PlyHeader& header) {
  const auto fail = [&](const std::string& cause, Hint hint = {}) {
    fail_at_line(bytes, header.body - 1, cause, std::move(hint));  // at the header's end
  };
  const PlyElement* const vertex = header.find("vertex");
  if (vertex == nullptr) fail("the header has no element \"vertex\"");
  for (const char* const axis : {"x", "y", "z"}) {
    if (vertex->find(axis, false) < 0) {
      fail(std::string("the element \"vertex\" has no property \"") + axis + "\"");
    }
  }
  const PlyElement* const face = header.find("face");
  if (face == nullptr && header.find("tristrips") != nullptr) {
    fail("the file has triangle strips, which are not supported", {"save it with faces"});
  }
  if (face == nullptr) {
    fail("the file has no faces (no element \"face\"): a point cloud has no surface");
  }
  int corners = face->find("vertex_indices", true);
  if (corners < 0) corners = face->find("vertex_index", true);
  if (corners < 0) fail("the element \"face\" has no list \"vertex_indices\" or \"vertex_index\"");
  return static_cast<std::size_t>(corners);
}

template <class Body>
RawMesh read_body(std::string_view bytes, const PlyHeader& header) {
  const std::size_t corners = check_elements(bytes, header);
  Body body(bytes, header);
  RawMesh mesh;
  for (const PlyElement& element : header.elements) {
    if (element.name == "vertex") {
      read_vertices(body, element, mesh);
    } else if (element.name == "face") {
      read_faces(body, element, corners, header.find("vertex")->count, mesh);
    } else {
      skip_rows(body, element);
    }
  }
  if (const std::size_t left = body.bytes_left(); left > 0) {
    mesh.notes.push_back(counted_text(left, "byte", "bytes") + " behind the last element " +
                         (left == 1 ? "was" : "were") + " ignored");
  }
  return mesh;
}

}  // namespace

RawMesh read_ply(std::string_view bytes) {
  const PlyHeader header = read_ply_header(bytes);
  switch (header.format) {
    case PlyFormat::kAscii:
      return read_body<AsciiBody>(bytes, header);
    case PlyFormat::kLittleEndian:
      return read_body<BinaryBody<std::endian::little>>(bytes, header);
    case PlyFormat::kBigEndian:
      break;
  }
  return read_body<BinaryBody<std::endian::big>>(bytes, header);
}

}  // namespace geotherm::io
