// SPDX-License-Identifier: MIT
// docs/adding_a_domain.md: a space of one's own, here streets with lengths.
#include <geotherm/geotherm.h>

#include <iostream>

#include "require.h"

using namespace geotherm;

namespace {

struct Street {
  Index from, to;
  double metres;
};

/// Each street is a cell of one dimension: two corners, and the gradient of a function on it is the
/// difference of its values over the length.
CellComplex cells_of_streets(Index crossings, const std::vector<Street>& streets) {
  CellComplex cells;
  cells.cell_name = "street";
  cells.cells_name = "streets";
  cells.vertices = crossings;
  cells.dimension = 1;
  cells.start = {0};
  for (const auto& [from, to, metres] : streets) {
    cells.corners.insert(cells.corners.end(), {from, to});
    cells.start.push_back(static_cast<std::int64_t>(cells.corners.size()));
    cells.gradients.insert(cells.gradients.end(), {-1 / metres, 1 / metres});
    cells.measures.push_back(metres);
    cells.widths.push_back(metres);
  }
  return cells;
}

}  // namespace

int main() {
  const std::vector<Street> streets = {{0, 1, 120}, {1, 2, 80}, {2, 3, 60}, {1, 4, 200}};
  auto cells = std::make_shared<const CellComplex>(cells_of_streets(5, streets));
  const HeatMethod method = require(HeatMethod::build(cells));
  const DistanceResult result = require(method.solve(SourceSet::of_vertices({0})));
  for (const double metres : result.distances) std::cout << metres << " m\n";
}
