// SPDX-License-Identifier: MIT
#include <Eigen/LU>
#include <algorithm>
#include <new>

#include "geotherm/domains.h"
#include "solver/core/sorting.h"
#include "solver/core/text.h"
#include "solver/volume/clean_tets.h"

namespace geotherm {
namespace {

/// The stiffness that is left of a sliver, in that of a good tet: too little for an answer to show.
constexpr double kSliverStiffness = 1e-6;

/// What u is linear over, in radii of a tet's circumsphere, which are larger where tets are less
/// regular. Chosen between convex bodies, where more is better, and bent tubes, where less is
/// (docs/domains.md).
constexpr double kWidth = 1.25;

/// Takes the weight from slivers: their large gradients would rule those of the good tets around
/// them, and little room goes with them. They stay cells, so that sources may lie in them, and one
/// that alone connects its vertices with others keeps its weight. `heights`: height_in_edges() of
/// each.
void weaken_slivers(const std::vector<Tet>& tets, std::span<const double> heights,
                    CellComplex& cells) {
  DisjointSets sets(static_cast<std::size_t>(cells.vertices));
  const auto join = [&sets](const Tet& tet) {
    bool joined = false;
    for (std::size_t k = 1; k < 4; ++k) {
      joined |= sets.root(tet[0]) != sets.root(tet[k]);
      sets.join(tet[0], tet[k]);
    }
    return joined;
  };
  std::vector<std::size_t> slivers;
  for (std::size_t t = 0; t < tets.size(); ++t) {
    if (heights[t] < kSliverHeight) {
      slivers.push_back(t);
    } else {
      join(tets[t]);
    }
  }
  std::ranges::stable_sort(slivers, std::ranges::greater{},
                           [&heights](std::size_t t) { return heights[t]; });
  std::size_t weakened = 0;
  for (const std::size_t t : slivers) {
    if (join(tets[t])) continue;
    cells.measures[t] *= kSliverStiffness * heights[t] * heights[t];
    ++weakened;
  }
  if (weakened == 0) return;
  cells.notes.push_back(
      {counted_text(weakened, "sliver", "slivers") + " among " +
       counted_text(tets.size(), "tetrahedron", "tetrahedra") +
       ", with a height below a fifth of the shortest edge, left without weight"});
}

/// The radius of the sphere through the corners.
double circumradius(std::span<const Vec3> positions, const Tet& tet) {
  Eigen::Matrix3d edges;
  for (int k = 0; k < 3; ++k) {
    edges.row(k) =
        (positions[tet[static_cast<std::size_t>(k) + 1]] - positions[tet[0]]).transpose();
  }
  return (edges.inverse() * (0.5 * edges.rowwise().squaredNorm())).norm();
}

}  // namespace

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
  cells.lengths_are_straight = true;
  cells.start.push_back(0);
  const auto positions = mesh.positions();
  std::vector<double> heights;
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
    cells.widths.push_back(kWidth * std::min(longest, circumradius(positions, tet)));
    heights.push_back(height_in_edges(mesh, tet, element));
  }
  weaken_slivers(clean.tets, heights, cells);
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
