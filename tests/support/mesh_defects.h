// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "tests/support/dice.h"
#include "tests/support/shapes.h"

namespace geotherm::test {

/// One way of spoiling a mesh that has a face.
struct MeshDefect {
  const char* name;
  void (*apply)(Draft& draft, Dice& dice);
};

/// Edges with three faces and more, vertices with several fans, faces turned round, given twice,
/// with repeated corners, without area, needles and caps, points at one place, cracks, holes,
/// sheets that cross, vertices without a face, other components of any scale.
std::span<const MeshDefect> mesh_defects();

/// Faces over random triples of the draft's points.
void add_soup(Draft& draft, Dice& dice, Index count);

/// Largest distance of two corners of the draft's box.
double size_of(const Draft& draft);

}  // namespace geotherm::test
