// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "geotherm/sources.h"
#include "tests/support/broken_mesh.h"
#include "tests/support/dice.h"

namespace geotherm::test {

/// A broken mesh with sources on it, and what holds of every distance from them.
struct BrokenCase {
  std::string recipe;
  MeshPtr mesh;
  std::vector<Face> faces;       ///< those with three corners apart
  std::vector<Index> component;  ///< V: the least vertex that faces join it to, kNoIndex in no face
  SourceSet sources;             ///< points; none where `faces` is empty
  std::vector<char> reached;     ///< V: joined by faces to a source
  Dice dice;                     ///< for what else is to be chosen
};

/// Sources: a vertex, several, or points inside faces, on sides and at corners; all of them chosen
/// by the number.
BrokenCase broken_case(std::uint64_t seed, const Breakage& how = {});

/// The vertex that each is joined to by faces, the least one; kNoIndex in no face.
std::vector<Index> components_of(Index vertices, const std::vector<Face>& faces);

/// How many meshes are tried: the value of GEOTHERM_BROKEN_MESHES, else `many`, or `few` in a
/// build with a sanitizer.
int broken_mesh_count(int many, int few);

}  // namespace geotherm::test
