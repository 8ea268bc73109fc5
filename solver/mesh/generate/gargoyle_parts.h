// SPDX-License-Identifier: MIT
#pragma once

#include "solver/mesh/generate/sculpture.h"

namespace geotherm::generate {

// The gargoyle, part by part, in the order in which they are added: about 2 high, the plinth's top
// at y = 0, facing +Z.
void add_plinth(Sculpture& s);
void add_torso(Sculpture& s);
void add_limbs(Sculpture& s);
void add_tail(Sculpture& s);
void add_wings(Sculpture& s);
void add_head(Sculpture& s);

}  // namespace geotherm::generate
