// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "solver/path/funnel.h"
#include "solver/path/path_surface.h"

namespace geotherm {

/// A row of faces, each sharing an edge with the next, laid out in one plane. All lengths are those
/// on the surface, in units of PathSurface::unit().
struct UnfoldedStrip {
  struct Corner {
    Index vertex;
    int first_gate, last_gate;  ///< the gates that it is a post of
  };
  struct Gate {
    int left, right;  ///< corners
  };
  std::vector<Vec2> points;               ///< of the corners; then the start, then the end
  std::vector<Corner> corners;            ///< faces + 2
  std::vector<std::array<int, 3>> faces;  ///< corners of each, in the order of the face
  std::vector<Gate> gates;                ///< gate k lies between faces k and k + 1

  int start() const { return static_cast<int>(corners.size()); }
  int end() const { return start() + 1; }
};

/// Precondition: the first face holds `from`, the last one `to`; neighbours share an edge, and no
/// edge follows itself. Cost: O(faces).
UnfoldedStrip unfold(const PathSurface& surface, const SurfacePoint& from, const SurfacePoint& to,
                     const std::vector<Index>& faces);

}  // namespace geotherm
