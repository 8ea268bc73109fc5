// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "geotherm/domains.h"
#include "solver/geometry/cell_mesh.h"

namespace geotherm {

/// Edges of a volume's border round which shortest ways bend: the volume fills more than half of
/// what is around them, by 20 degrees and more. Edges one after the other on a straight line are
/// one line.
struct ReentrantLines {
  struct Line {
    Vec3 place, direction;
    Vec3 inward;  ///< across the line, half-way between the two sides; both have length 1
  };
  struct End {
    Index vertex, line;
  };
  std::vector<Line> lines;
  std::vector<End> vertices;  ///< of the lines, ascending

  /// Those of a vertex.
  std::span<const End> at(Index vertex) const;
};

/// `around`: the tets around each vertex. Cost: one pass, a tenth of a microsecond a tet.
ReentrantLines reentrant_lines(std::span<const Vec3> positions, std::span<const Tet> tets,
                               const CellTable& around);

}  // namespace geotherm
