// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "geotherm/types.h"

namespace geotherm {

/// Which faces hang together through shared vertices: distances never pass between components.
struct FaceComponents {
  std::vector<Index> of;  ///< F: number of the face's component, by first appearance
  Index count = 0;
};

/// Precondition: corners are below `vertex_count`. Cost: O(V + F).
FaceComponents face_components(std::span<const Face> faces, Index vertex_count);

}  // namespace geotherm
