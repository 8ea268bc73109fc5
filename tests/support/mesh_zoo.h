// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

#include "tests/support/shapes.h"

namespace geotherm::test {

/// What is true of a mesh of the zoo.
enum ZooTag : unsigned {
  kPlanar = 1U << 0,     ///< a region of the plane z = 0, covered once
  kClosed = 1U << 1,     ///< every edge has two faces
  kBorder = 1U << 2,     ///< some edge has one face
  kManifold = 1U << 3,   ///< every edge has at most two faces, every vertex one fan
  kConnected = 1U << 4,  ///< one component, no vertex without a face
  kRegular = 1U << 5,    ///< no face is degenerate, repeated, or nearly degenerate
  kSmooth = 1U << 6,     ///< fine and well-shaped enough for distances accurate to a few per cent
};

/// A small generated mesh. Some are what files hold and textbooks exclude.
struct ZooMesh {
  const char* name;
  unsigned tags;
  Draft (*draft)();

  MeshPtr mesh() const { return finish(draft()); }
};

/// Those of all meshes that have every one of these tags.
std::vector<ZooMesh> zoo(unsigned tags = 0);

void PrintTo(const ZooMesh& mesh, std::ostream* out);

/// The name generator of tests with one mesh each.
std::string zoo_name(const testing::TestParamInfo<ZooMesh>& info);

}  // namespace geotherm::test
