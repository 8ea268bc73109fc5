// SPDX-License-Identifier: MIT
#include <algorithm>
#include <new>

#include "geotherm/domains.h"
#include "solver/volume/clean_tets.h"

namespace geotherm {

Result<CellComplex> cells_of(const TetMesh& mesh) try {
  CleanTets clean = clean_tets(mesh);
  CellComplex cells;
  for (std::string& note : clean.notes()) cells.notes.push_back({std::move(note)});
  if (clean.tets.empty()) {
    return Error{ErrorCode::kBadInput, "the mesh has no tetrahedron with a volume"};
  }
  cells.cell_name = "tet";
  cells.cells_name = "tets";
  cells.vertices = mesh.vertex_count();
  cells.dimension = 3;
  cells.positions.assign(mesh.positions().begin(), mesh.positions().end());
  cells.start.push_back(0);
  const auto positions = mesh.positions();
  for (const Tet& tet : clean.tets) {
    const TetGradient element =
        tet_gradient(positions[tet[0]], positions[tet[1]], positions[tet[2]], positions[tet[3]]);
    double longest = 0;
    for (int k = 0; k < 4; ++k) {
      const Vec3& g = element.gradients[static_cast<std::size_t>(k)];
      cells.gradients.insert(cells.gradients.end(), {g[0], g[1], g[2]});
      cells.corners.push_back(tet[k]);
      for (int j = 0; j < k; ++j) {
        longest = std::max(longest, (positions[tet[k]] - positions[tet[j]]).norm());
      }
    }
    cells.start.push_back(std::ssize(cells.corners));
    cells.measures.push_back(element.volume);
    cells.widths.push_back(longest);
  }
  cells.numbers = std::move(clean.original);
  cells.on_boundary.assign(static_cast<std::size_t>(mesh.vertex_count()), 0);
  const auto border = boundary(mesh);
  if (!border) return border.error();
  for (const Index v : border->vertices) cells.on_boundary[v] = 1;
  return cells;
} catch (const std::bad_alloc&) {
  return Error{ErrorCode::kOutOfMemory, "the memory ended while cells were made of " +
                                            std::to_string(mesh.tet_count()) + " tets"};
}

}  // namespace geotherm
