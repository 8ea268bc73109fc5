// SPDX-License-Identifier: MIT
// One reader per format. Each takes the bytes of FileBytes (with its padding) and throws
// ReadFailure or std::bad_alloc.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "geotherm/domains.h"

namespace geotherm::io {

/// What a reader hands over; every corner is in range, every coordinate finite.
struct RawTets {
  std::vector<Vec3> positions;
  std::vector<Tet> tets;
  std::map<std::string, std::int64_t> others;  ///< elements that are no tets, by kind (plural)
  std::vector<std::string> notes;
};

/// "triangles (12), edges (3)".
std::string text_of_others(const RawTets& raw);

RawTets read_medit(std::string_view text);
RawTets read_meshb(std::string_view bytes);
RawTets read_gmsh(std::string_view bytes);
RawTets read_vtk(std::string_view bytes);
RawTets read_vtu(std::string_view bytes);

/// The vertices of a .node file, and the number that its first one has: 0 or 1.
struct TetgenNodes {
  std::vector<Vec3> positions;
  std::int64_t first = 0;
};
TetgenNodes read_node(std::string_view text);
RawTets read_ele(std::string_view text, TetgenNodes nodes);

}  // namespace geotherm::io
