// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "geotherm/error.h"
#include "geotherm/mesh_report.h"
#include "geotherm/progress.h"
#include "solver/geometry/edit.h"
#include "solver/geometry/intrinsic_mesh.h"
#include "solver/linear/symmetric_pattern.h"

namespace geotherm {

/// What refine_triangulation() did.
struct Refinement : RefinementCounts {
  std::vector<double>
      grading;  ///< per part: that t over its squared mean edge; 1 without large faces
  std::vector<Vec3> positions;    ///< points x 3: near where they lie, for elimination orders
  std::vector<char> on_boundary;  ///< points: the vertex lies on the boundary
};

/// The faces and boundary edges for which refine_triangulation() would insert a vertex or raise t.
struct RefinementNeeds {
  std::vector<Index> large;  ///< faces
  std::vector<Side> obtuse;  ///< boundary sides
  /// The lower and higher ends of edges whose sides are nobody's twins and yet several, ascending.
  std::vector<std::pair<Index, Index>> joined;

  bool is_joined(const std::pair<Index, Index>& ends) const {
    return std::ranges::binary_search(joined, ends);
  }
};

/// Its preconditions and arguments. Cost: one pass over the faces, by all threads.
RefinementNeeds find_refinement_needs(const IntrinsicMesh& mesh, const Components& parts,
                                      std::span<const double> part_edge, int threads);

/// Inserts vertices into a Delaunay triangulation, never into the mesh, until it can carry the heat
/// method with one diffusion time per part: no face has an edge above 2.6 sqrt(t), on which heat
/// would underflow to no direction, and no boundary edge lies opposite an obtuse angle (above 96
/// degrees), where its weight would be negative. Large faces get their circumcentre (Chew 1993; on
/// intrinsic triangulations Sharp, Soliman, Crane 2019, section 4.2); where the way to it leaves
/// over the boundary, and where a boundary edge is obtuse, the edge is split; edges with three
/// faces or more, and those between faces that disagree in orientation, are left as they are.
///
/// t is h^2, h the mean length of the part's edges but for those above 2.6 times their mean (so
/// that `grading` may be below 1), or as much more as keeps the number of vertices to be expected
/// for large faces below a quarter of the part's, or below its share of 500 where that is more.
///
/// `mesh` must be Delaunay, its faces of vertices below parts.of.size(); `parts` names the
/// connected part of each vertex and is continued for inserted ones; `part_edge`: the mean edge
/// length of each part in units of `mesh`; `most`: vertices to insert at most. Edits are appended.
/// Where there is nothing to insert, nothing changes. The same bits with any number of threads.
/// Error: kCancelled. Cost: one pass over the faces, by all threads, and about two microseconds an
/// inserted vertex.
Result<Refinement> refine_triangulation(IntrinsicMesh& mesh, std::vector<Edit>& edits,
                                        Components& parts, std::span<const double> part_edge,
                                        std::span<const Vec3> positions, Index most, int threads,
                                        const Progress& progress = {});

}  // namespace geotherm
