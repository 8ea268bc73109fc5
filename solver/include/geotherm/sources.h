// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "geotherm/mesh.h"

// Where distance is 0.
namespace geotherm {

/// A point of a cell of a CellComplex: a weight for each of its corners, in their order; they are
/// >= 0 and sum to 1.
struct CellPoint {
  Index cell = kNoIndex;        ///< that it is in
  std::vector<double> weights;  ///< of its corners

  bool operator==(const CellPoint&) const = default;
};

/// Where distance is 0: points, and mesh edges whose every point is a source (a curve).
/// The ends of each edge are sources as well, whether or not they stand among the points.
struct SourceSet {
  std::vector<SurfacePoint> points;         ///< on a triangle mesh
  std::vector<std::array<Index, 2>> edges;  ///< by their two vertices
  std::vector<double> offsets{};  ///< of the points: distance there, >= 0, model units; none: all 0
  std::vector<CellPoint> cell_points{};  ///< in spaces that are no triangle mesh

  /// These alone.
  static SourceSet of_vertices(const std::vector<Index>& vertices) {
    SourceSet set;
    for (const Index v : vertices) set.points.push_back(SurfacePoint::at_vertex(v));
    return set;
  }
  /// Whether there is none.
  bool empty() const { return points.empty() && edges.empty() && cell_points.empty(); }
  bool operator==(const SourceSet&) const = default;
};

/// Numbers the sources for labels: points first, then edges, then points of cells, each as in the
/// set. A point has a group of its own; edges that touch, and points that are their ends, are one
/// group. Groups are
/// numbered 0, 1, ... in the order in which they first stand.
struct SourceGroups {
  std::vector<Index> of_point, of_edge;  ///< the group of each
  Index count = 0;                       ///< of groups
};
/// Cost: O(points + edges).
SourceGroups source_groups(const SourceSet& sources);

}  // namespace geotherm
