// SPDX-License-Identifier: MIT
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "solver/core/text.h"
#include "solver/mesh/io/input_file.h"
#include "solver/mesh/io/ply_body.h"
#include "solver/mesh/io/ply_header.h"
#include "solver/mesh/io/raw_mesh.h"

namespace geotherm::io {
namespace {

constexpr const char* kStrips = "tristrips";

/// The property with the corners of a face or a strip; one more than there are where none has them.
std::size_t corner_count_of(const PlyElement& element) {
  int corners = element.find("vertex_indices", true);
  if (corners < 0) corners = element.find("vertex_index", true);
  return corners < 0 ? element.properties.size() : static_cast<std::size_t>(corners);
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
  read_rows(body, element, [&](std::int64_t row, std::size_t k) {
    const PlyProperty& property = element.properties[k];
    if (axis_of[k] < 0) return skip(body, property);
    mesh.positions[static_cast<std::size_t>(row)][axis_of[k]] = body.coordinate(property.type);
  });
}

template <class Body>
Index checked_corner(Body& body, std::int64_t corner, std::int64_t vertex_count) {
  if (corner < 0 || corner >= vertex_count) {
    body.fail("vertex " + std::to_string(corner) + " is used, but the file has " +
              std::to_string(vertex_count) + " vertices (0 to " + std::to_string(vertex_count - 1) +
              ")");
  }
  return static_cast<Index>(corner);
}

template <class Body>
void read_corners(Body& body, const PlyProperty& list, std::int64_t vertex_count, FanBuilder& fan) {
  const std::int64_t corner_count = list_length(body, list);
  for (std::int64_t k = 0; k < corner_count; ++k) {
    fan.add(checked_corner(body, body.integer(list.type), vertex_count));
  }
}

template <class Body>
void read_faces(Body& body, const PlyElement& element, std::size_t corners,
                std::int64_t vertex_count, RawMesh& mesh) {
  mesh.faces.reserve(static_cast<std::size_t>(element.count));
  FanBuilder fan(mesh.faces);
  for (std::int64_t row = 0; row < element.count; ++row) {
    body.now_reading(element, row);
    for (std::size_t k = 0; k < element.properties.size(); ++k) {
      if (k == corners) {
        read_corners(body, element.properties[k], vertex_count, fan);
      } else {
        skip(body, element.properties[k]);
      }
    }
    fan.end(mesh.polygons);
  }
  note_left_out(fan.left_out(), mesh.notes);
}

/// Strips of triangles, which -1 separates, in the lists of some rows: as VCG and Stanford's
/// programs write them.
template <class Body>
void read_strips(Body& body, const PlyElement& element, std::int64_t vertex_count, RawMesh& mesh) {
  constexpr std::int64_t kSeparator = -1;
  const std::size_t corners = corner_count_of(element);
  std::vector<Index> strip;
  read_rows(body, element, [&](std::int64_t, std::size_t k) {
    const PlyProperty& property = element.properties[k];
    if (k != corners) return skip(body, property);
    for (std::int64_t left = list_length(body, property); left > 0; --left) {
      const std::int64_t corner = body.integer(property.type);
      if (corner != kSeparator) {
        strip.push_back(checked_corner(body, corner, vertex_count));
        if (left > 1) continue;
      }
      add_strip(strip, mesh.faces);
      strip.clear();
    }
  });
}

/// Throws where the file cannot be a mesh.
void check_elements(std::string_view bytes, const PlyHeader& header) {
  const auto fail = [&](const std::string& cause) {
    fail_at_line(bytes, header.body - 1, cause);  // at the header's end
  };
  const PlyElement* const vertex = header.find("vertex");
  if (vertex == nullptr) fail("the header has no element \"vertex\"");
  for (const char* const axis : {"x", "y", "z"}) {
    if (vertex->find(axis, false) < 0) {
      fail(std::string("the element \"vertex\" has no property \"") + axis + "\"");
    }
  }
  if (header.find("face") == nullptr && header.find(kStrips) == nullptr) {
    fail("the file has no faces (no element \"face\"): a point cloud has no surface");
  }
  for (const char* const name : {"face", kStrips}) {
    const PlyElement* const element = header.find(name);
    if (element == nullptr || corner_count_of(*element) < element->properties.size()) continue;
    fail(std::string("the element \"") + name +
         "\" has no list \"vertex_indices\" or \"vertex_index\"");
  }
}

template <class Body>
RawMesh read_body(Body body, const PlyHeader& header) {
  RawMesh mesh;
  for (const PlyElement& element : header.elements) {
    if (element.name == "vertex") {
      read_vertices(body, element, mesh);
    } else if (element.name == "face") {
      read_faces(body, element, corner_count_of(element), header.find("vertex")->count, mesh);
    } else if (element.name == kStrips) {
      read_strips(body, element, header.find("vertex")->count, mesh);
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
  check_elements(bytes, header);
  return with_ply_body(bytes, header,
                       [&](auto body) { return read_body(std::move(body), header); });
}

}  // namespace geotherm::io
