// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "geotherm/path.h"
#include "geotherm/sources.h"
#include "solver/path/path_surface.h"

namespace geotherm {

/// Two points, and the distances of all vertices from each (V, file order, model units).
struct GeodesicEnds {
  SurfacePoint from, to;
  std::span<const double> from_distances, to_distances;
};

/// Paths over the surface that bend at a few points of each edge and at vertices: the shortest of
/// them comes near the shortest of all whether that passes vertices or not, and says which faces
/// it runs through. Only edges take part through which, by the distances from both ends, a path not
/// much longer than another may lead: a circular wave through the values at its two vertices gives
/// those between. Cost: O(E), and O(n log n) for the n points that take part, which are some ten
/// thousand at most.
/// Source: Lanthier, Maheshwari, Sack (1997), "Approximating weighted shortest paths on polyhedral
/// surfaces" (points on edges).
class CrossingGraph {
 public:
  /// `length`: of a path between the ends, model units. Both ends lie on the surface.
  CrossingGraph(const PathSurface& surface, const GeodesicEnds& ends, double length);

  /// The shortest path through each of its points, where that is not longer than `longest` (model
  /// units): the shortest ones, ascending, no two through the same faces, `most` at most.
  std::vector<SurfacePath> routes(double longest, std::size_t most) const;

 private:
  struct Node {
    SurfacePoint point;  ///< of the surface
    Vec3 position;
    std::vector<Index> faces;  ///< that hold it
  };
  struct Tree {  ///< the shortest paths to one end
    std::vector<double> length;
    std::vector<int> next;
    std::vector<Index> face;  ///< that holds the piece to the next node
  };

  void choose_edges(const GeodesicEnds& ends);
  int add_node(const SurfacePoint& point);
  int add_end(const SurfacePoint& point);
  Tree tree_to(int end) const;
  SurfacePath route_through(int node, std::vector<char>& used) const;

  const PathSurface& surface_;
  double longest_ = 0;  ///< paths beyond need not be known; in units of the surface
  std::vector<Node> nodes_;
  std::vector<std::vector<int>> nodes_in_;  ///< of each face that takes part
  std::vector<Index> row_of_face_;          ///< in nodes_in_, kNoIndex: no part
  std::vector<int> node_of_vertex_;         ///< kNone: no part
  int from_ = 0, to_ = 0;
  Tree to_from_, to_to_;
};

}  // namespace geotherm
