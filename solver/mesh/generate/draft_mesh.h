// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "solver/core/types.h"

namespace geotherm::generate {

/// A mesh in the making: what TriangleMesh takes, still free to change.
struct DraftMesh {
  std::vector<Vec3> positions;
  std::vector<Face> faces;
};

}  // namespace geotherm::generate
