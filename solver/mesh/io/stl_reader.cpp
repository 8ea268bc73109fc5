// SPDX-License-Identifier: MIT
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

#include "solver/core/text.h"
#include "solver/mesh/io/byte_order.h"
#include "solver/mesh/io/input_file.h"
#include "solver/mesh/io/raw_mesh.h"
#include "solver/mesh/io/text_scanner.h"
#include "solver/mesh/io/vertex_welder.h"

namespace geotherm::io {
namespace {

constexpr std::size_t kHeaderBytes = 84;
constexpr std::size_t kFaceBytes = 50;

bool equals(std::string_view word, std::string_view lower) {
  return std::ranges::equal(word, lower, [](char a, char b) {
    return (a >= 'A' && a <= 'Z' ? static_cast<char>(a - 'A' + 'a') : a) == b;
  });
}

void expect(TextScanner& scanner, std::string_view keyword) {
  const std::string_view word = scanner.peek();
  const bool found = equals(word, keyword);
  scanner.word();
  if (found) return;
  if (word.empty()) scanner.fail("the file ends where \"" + std::string(keyword) + "\" should be");
  scanner.fail(quoted(word, word.data()) + " stands where \"" + std::string(keyword) +
               "\" should be");
}

void finish(RawMesh& mesh, VertexWelder& welder) {
  mesh.positions = welder.take_positions();
  mesh.welded = 3 * mesh.faces.size() - mesh.positions.size();
}

RawMesh read_ascii(std::string_view text) {
  TextScanner scanner(text, '\0');
  VertexWelder welder(text.size() / 80);
  RawMesh mesh;
  while (!scanner.at_end()) {
    expect(scanner, "solid");
    scanner.skip_line();  // its name
    while (!equals(scanner.peek(), "endsolid")) {
      scanner.now_reading("facet", static_cast<std::int64_t>(mesh.faces.size()) + 1, 0);
      expect(scanner, "facet");
      scanner.skip_line();  // its normal follows from the corners
      expect(scanner, "outer");
      expect(scanner, "loop");
      Face face;
      for (Index& corner : face) {
        expect(scanner, "vertex");
        Vec3 position;
        for (int axis = 0; axis < 3; ++axis) position[axis] = scanner.coordinate();
        corner = welder.add(position);
      }
      expect(scanner, "endloop");
      expect(scanner, "endfacet");
      mesh.faces.push_back(face);
    }
    scanner.skip_line();
  }
  finish(mesh, welder);
  return mesh;
}

RawMesh read_binary(std::string_view bytes, std::size_t face_count) {
  RawMesh mesh;
  mesh.faces.resize(face_count);
  VertexWelder welder(3 * face_count);
  const char* p = bytes.data() + kHeaderBytes;
  for (Face& face : mesh.faces) {
    p += 12;  // the normal follows from the corners
    for (Index& corner : face) {
      Vec3 position;
      for (int axis = 0; axis < 3; ++axis, p += 4) {
        position[axis] = load<float>(p, std::endian::little);
        if (!std::isfinite(position[axis])) {
          fail_at_byte(bytes, p,
                       "a coordinate is not finite in triangle " +
                           std::to_string(&face - mesh.faces.data() + 1) + " of " +
                           std::to_string(face_count));
        }
      }
      corner = welder.add(position);
    }
    p += 2;  // attributes
  }
  finish(mesh, welder);
  const std::size_t used = kHeaderBytes + kFaceBytes * face_count;
  if (bytes.size() > used) {
    const std::size_t left = bytes.size() - used;
    mesh.notes.push_back(counted_text(left, "byte", "bytes") + " behind the last triangle " +
                         (left == 1 ? "was" : "were") + " ignored");
  }
  return mesh;
}

/// Some programs start the 80 bytes of a binary header with "solid": the size tells.
bool is_ascii(std::string_view bytes) {
  TextScanner scanner(bytes, '\0');
  if (!equals(scanner.word(), "solid")) return false;
  const std::string_view start = bytes.substr(0, 1024);
  return start.find('\0') == start.npos;
}

}  // namespace

RawMesh read_stl(std::string_view bytes) {
  std::uint64_t face_count = 0;
  std::uint64_t needed = kHeaderBytes;
  if (bytes.size() >= kHeaderBytes) {
    face_count = load<std::uint32_t>(bytes.data() + 80, std::endian::little);
    needed += kFaceBytes * face_count;
    if (bytes.size() == needed) return read_binary(bytes, face_count);
  }
  if (is_ascii(bytes)) return read_ascii(bytes);
  if (bytes.size() < kHeaderBytes) {
    fail_at_byte(bytes, bytes.data(),
                 "neither text (\"solid ...\") nor long enough for a binary STL: " +
                     std::to_string(bytes.size()) + " bytes, its header alone has 84");
  }
  if (bytes.size() < needed) {
    fail_at_byte(bytes, bytes.data() + 80,
                 "the header announces " + std::to_string(face_count) + " triangles, that is " +
                     std::to_string(needed) + " bytes, but the file has " +
                     std::to_string(bytes.size()));
  }
  return read_binary(bytes, face_count);
}

}  // namespace geotherm::io
