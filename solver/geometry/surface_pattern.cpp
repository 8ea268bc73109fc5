// SPDX-License-Identifier: MIT
#include "solver/geometry/surface_pattern.h"

#include <algorithm>
#include <vector>

#include "solver/core/parallel.h"
#include "solver/core/sorting.h"

namespace geotherm {

SymmetricPattern surface_pattern(const IntrinsicMesh& mesh, const CornerTable& corners,
                                 std::span<const Index> used, std::span<const Index> local,
                                 int threads) {
  const auto add_neighbors = [&](Index i, std::vector<Index>& row) {
    const Index vertex = used[i];
    const auto begin = static_cast<std::ptrdiff_t>(row.size());
    for (const Side corner : corners.at(vertex)) {
      const Face& face = mesh.faces[face_of(corner)];
      const int k = corner_of(corner);
      row.push_back(local[face[next_corner(k)]]);
      const Side ending = corner - k + previous_corner(k);
      if (mesh.twin[ending] == kNoSide) row.push_back(local[face[previous_corner(k)]]);
    }
    short_sort(row.data() + begin, row.data() + row.size());
    // Two edges may join the same vertices, and one a vertex with itself.
    const auto end = std::unique(row.begin() + begin, row.end());
    row.erase(std::remove(row.begin() + begin, end, i), row.end());
  };
  SymmetricPattern pattern;
  list_rows(static_cast<Index>(used.size()), threads, add_neighbors, pattern.start,
            pattern.neighbor);
  return pattern;
}

}  // namespace geotherm
