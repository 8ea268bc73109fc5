// SPDX-License-Identifier: MIT
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "solver/core/text.h"
#include "solver/mesh/io/input_file.h"
#include "solver/mesh/io/ply_body.h"
#include "solver/mesh/io/ply_header.h"
#include "solver/points/io/raw_points.h"

namespace geotherm::io {
namespace {

using AxisNames = std::array<std::string_view, 3>;
constexpr AxisNames kPlaces = {"x", "y", "z"}, kNormals = {"nx", "ny", "nz"};

/// Which properties of a vertex say what: 0 to 2 its place, 3 to 5 its normal, -1 neither.
struct VertexColumns {
  std::vector<int> meaning;
  bool has_normals = true;
};

VertexColumns columns_of(std::string_view bytes, const PlyHeader& header) {
  const auto fail = [&](const std::string& cause) {
    fail_at_line(bytes, header.body - 1, cause);  // at the header's end
  };
  const PlyElement* const vertex = header.find("vertex");
  if (vertex == nullptr) fail("the header has no element \"vertex\"");
  VertexColumns out;
  out.meaning.assign(vertex->properties.size(), -1);
  for (const std::string_view name : kNormals) out.has_normals &= vertex->find(name, false) >= 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto named = static_cast<std::size_t>(axis);
    const int place = vertex->find(kPlaces[named], false);
    if (place < 0) {
      fail("the element \"vertex\" has no property \"" + std::string(kPlaces[named]) + "\"");
    }
    out.meaning[static_cast<std::size_t>(place)] = axis;
    if (!out.has_normals) continue;
    out.meaning[static_cast<std::size_t>(vertex->find(kNormals[named], false))] = 3 + axis;
  }
  return out;
}

template <class Body>
void read_points(Body& body, const PlyElement& element, const VertexColumns& columns,
                 RawPoints& out) {
  const auto count = static_cast<std::size_t>(element.count);
  out.positions.resize(count);
  if (columns.has_normals) out.normals.resize(count);
  read_rows(body, element, [&](std::int64_t row, std::size_t k) {
    const PlyProperty& property = element.properties[k];
    const int meaning = columns.meaning[k];
    const auto i = static_cast<std::size_t>(row);
    if (meaning < 0) {
      skip(body, property);
    } else if (meaning < 3) {
      out.positions[i][meaning] = body.coordinate(property.type);
    } else {
      out.normals[i][meaning - 3] = body.number(property.type);
    }
  });
}

template <class Body>
RawPoints read_point_body(Body body, const PlyHeader& header, const VertexColumns& columns) {
  RawPoints out;
  for (const PlyElement& element : header.elements) {
    if (element.name == "vertex") {
      read_points(body, element, columns, out);
      break;  // what follows says nothing about points
    }
    skip_rows(body, element);
  }
  if (const PlyElement* const face = header.find("face"); face != nullptr && face->count > 0) {
    out.notes.push_back(counted_text(static_cast<std::size_t>(face->count), "face", "faces") +
                        (face->count == 1 ? " was" : " were") + " left out");
  }
  return out;
}

}  // namespace

RawPoints read_ply_points(std::string_view bytes) {
  const PlyHeader header = read_ply_header(bytes);
  const VertexColumns columns = columns_of(bytes, header);
  return with_ply_body(
      bytes, header, [&](auto body) { return read_point_body(std::move(body), header, columns); });
}

}  // namespace geotherm::io
