// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include "tests/support/shapes.h"

namespace geotherm::test {

/// A small mesh such as files hold and textbooks exclude.
struct BrokenMesh {
  Draft draft;         ///< 1 to some 300 faces
  std::string recipe;  ///< how it was made, for messages
};

/// How a mesh is spoilt, and where it is put.
struct Breakage {
  int defects = 4;     ///< kinds of defects, at most; 0: a good surface
  bool placed = true;  ///< scaled by 1e-9 to 1e9 and moved by up to 1e6 sizes
};

/// The mesh of a number. A shape (a triangle, fans, grids, spheres, tori, prisms, a Moebius strip,
/// a Klein bottle, a book, faces thrown over a few points) gets some of the defects of
/// mesh_defects.h. Now and then no face is left with
/// three corners apart.
BrokenMesh broken_mesh(std::uint64_t seed, const Breakage& how = {});

}  // namespace geotherm::test
