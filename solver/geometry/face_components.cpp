// SPDX-License-Identifier: MIT
#include "solver/geometry/face_components.h"

#include "solver/core/sorting.h"

namespace geotherm {

FaceComponents face_components(std::span<const Face> faces, Index vertex_count) {
  DisjointSets sets(static_cast<std::size_t>(vertex_count));
  for (const Face& face : faces) {
    sets.join(face[0], face[1]);
    sets.join(face[1], face[2]);
  }
  FaceComponents out;
  out.of.reserve(faces.size());
  std::vector<Index> number(static_cast<std::size_t>(vertex_count), kNoIndex);
  for (const Face& face : faces) {
    Index& component = number[sets.root(face[0])];
    if (component == kNoIndex) component = out.count++;
    out.of.push_back(component);
  }
  return out;
}

}  // namespace geotherm
