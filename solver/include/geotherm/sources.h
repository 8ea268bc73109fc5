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

/// A straight line in one face of a triangle mesh, all of which is a source: a piece of a curve
/// that runs across faces.
struct FaceSegment {
  Index face = kNoIndex;         ///< that it is in
  std::array<double, 3> from{};  ///< one end: weights of the corners, >= 0, that sum to 1
  std::array<double, 3> to{};    ///< the other end
  Index curve = 0;               ///< whose piece it is: those of one number are one group

  bool operator==(const FaceSegment&) const = default;
};

/// Where distance is 0: points, mesh edges whose every point is a source (a curve), and curves
/// across faces. The ends of each edge are sources as well, whether or not they stand among the
/// points.
struct SourceSet {
  std::vector<SurfacePoint> points;         ///< on a triangle mesh
  std::vector<std::array<Index, 2>> edges;  ///< by their two vertices
  std::vector<double> offsets{};  ///< of the points: distance there, >= 0, model units; none: all 0
  std::vector<CellPoint> cell_points{};  ///< in spaces that are no triangle mesh
  std::vector<FaceSegment> segments{};   ///< of curves across the faces of a triangle mesh

  /// These alone.
  static SourceSet of_vertices(const std::vector<Index>& vertices) {
    SourceSet set;
    for (const Index v : vertices) set.points.push_back(SurfacePoint::at_vertex(v));
    return set;
  }
  /// Whether there is none.
  bool empty() const {
    return points.empty() && edges.empty() && cell_points.empty() && segments.empty();
  }
  bool operator==(const SourceSet&) const = default;
};

/// Numbers the sources for labels. A point has a group of its own; edges that touch, and points
/// that are their ends, are one group, and so are the segments of one curve. Groups are numbered 0,
/// 1, ... by kind: points that end no edge, edges, segments, points of cells; and each kind in the
/// order in which it first stands in the set, edges by the points among them first.
struct SourceGroups {
  std::vector<Index> of_point, of_edge, of_segment;  ///< the group of each
  Index count = 0;                                   ///< of groups
};
/// Cost: O(points + edges + segments).
SourceGroups source_groups(const SourceSet& sources);

}  // namespace geotherm
