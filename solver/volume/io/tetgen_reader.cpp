// SPDX-License-Identifier: MIT
// TetGen's .node and .ele (Si 2015): a line of counts, then a line for each vertex or tet. The
// first vertex has the number 0 or 1, and the corners count from there.
#include "solver/volume/io/tetgen_reader.h"

#include <string>
#include <utility>

#include "solver/mesh/io/text_scanner.h"

namespace geotherm::io {
namespace {

/// The first number of the file: how many lines follow the first one.
std::int64_t tetgen_count(TextScanner& scanner, const char* things) {
  scanner.now_reading("the first line");
  const std::int64_t count = scanner.integer();
  checked_count(scanner, count, things, (scanner.bytes_left() + 1) / 8);  // "0 1 2 3\n"
  return count;
}

}  // namespace

TetgenNodes read_node(std::string_view text) {
  TextScanner scanner(text, '#');
  const std::int64_t count = tetgen_count(scanner, "vertices");
  if (scanner.integer() != 3) scanner.fail("the vertices are not in 3 dimensions");
  scanner.skip_line();  // how many attributes and marks each has
  TetgenNodes nodes;
  nodes.positions.resize(static_cast<std::size_t>(count));
  for (std::int64_t v = 0; v < count; ++v) {
    scanner.now_reading("vertex", v + 1, count);
    const std::int64_t number = scanner.integer();
    if (v == 0) nodes.first = number;
    if (number != nodes.first + v || nodes.first < 0 || nodes.first > 1) {
      scanner.fail("the vertex has the number " + std::to_string(number) +
                   "; they count up from 0 or 1");
    }
    for (int axis = 0; axis < 3; ++axis) {
      nodes.positions[static_cast<std::size_t>(v)][axis] = scanner.coordinate();
    }
    scanner.skip_line();
  }
  return nodes;
}

RawElements read_ele(std::string_view text, TetgenNodes nodes) {
  TextScanner scanner(text, '#');
  const std::int64_t count = tetgen_count(scanner, "tetrahedra");
  const std::int64_t corners = scanner.integer();
  if (corners != 4) {
    scanner.fail("tetrahedra have " + std::to_string(corners) + " corners instead of 4",
                 {"let TetGen write linear elements"});
  }
  scanner.skip_line();
  RawElements raw;
  raw.positions = std::move(nodes.positions);
  raw.tets.reserve(static_cast<std::size_t>(count));
  const auto vertices = static_cast<std::int64_t>(raw.positions.size());
  for (std::int64_t t = 0; t < count; ++t) {
    scanner.now_reading("tetrahedron", t + 1, count);
    scanner.integer();  // its number
    std::array<Index, 4> tet;
    for (Index& corner : tet) {
      const std::int64_t number = scanner.integer();
      if (number < nodes.first || number >= nodes.first + vertices) {
        scanner.fail("vertex " + std::to_string(number) + " is used, but the .node file has " +
                     std::to_string(vertices) + " vertices (" + std::to_string(nodes.first) +
                     " to " + std::to_string(nodes.first + vertices - 1) + ")");
      }
      corner = static_cast<Index>(number - nodes.first);
    }
    scanner.skip_line();
    raw.tets.push_back(tet);
  }
  return raw;
}

}  // namespace geotherm::io
