// SPDX-License-Identifier: MIT
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "geotherm/domains.h"

namespace geotherm::test {

/// A box of 8 vertices and 6 tets, 2 x 1.5 x 1, whose numbers are short in any format.
const TetMesh& small_box();

/// The same in a file of some format, with two triangles and some data that are to be left out.
struct TetSample {
  std::string name;  ///< of the test
  std::string file;  ///< with its extension
  std::string bytes;
};
inline std::ostream& operator<<(std::ostream& out, const TetSample& s) { return out << s.name; }
std::vector<TetSample> tet_samples();

/// The pair of files of TetGen, with vertices that count from `first`.
std::string node_text(int first);
std::string ele_text(int first);

std::string base64(const std::string& bytes);

}  // namespace geotherm::test
