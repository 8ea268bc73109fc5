// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include "solver/mesh/io/raw_mesh.h"

namespace geotherm::io {

/// Some whole lines of an OBJ file and what stands in them. Chunks are parsed at the same time, so
/// one does not know at first how many vertices stand before it.
struct ObjChunk {
  static constexpr std::int64_t kUnknown = -1;

  std::string_view text;                ///< its lines, which only parsing needs
  std::int64_t vertex_base = kUnknown;  ///< vertices before this chunk

  std::vector<Vec3> positions;
  std::vector<Face> faces;  ///< 0-based; checked against 0 only
  std::vector<Polygon> polygons;
  std::size_t left_out = 0;  ///< faces of fewer than three corners
  bool needs_base = false;   ///< holds relative indices: parse again with `vertex_base` known

  /// Fills the arrays. Throws ReadFailure at the first line that cannot be read, counted
  /// within the chunk.
  void parse() { parse_until(std::numeric_limits<std::size_t>::max()); }

  /// The line in which the triangle `face` stands.
  const char* line_of_face(std::size_t face) { return parse_until(face); }

 private:
  const char* end() const { return text.data() + text.size(); }
  const char* parse_until(std::size_t face);
  const char* parse_vertex(const char* p);
  const char* parse_face(const char* p);
  Index parse_corner(const char*& p);
  Index relative_corner(const char* where, std::int64_t written);
};

}  // namespace geotherm::io
