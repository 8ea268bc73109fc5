// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "solver/geometry/intrinsic_mesh.h"
#include "solver/linear/symmetric_operator.h"
#include "solver/linear/symmetric_pattern.h"

namespace geotherm {

/// Faces whose corners all lie in one range of rows: what they add to their corners meets nothing
/// that another range's faces add, so that ranges can be walked side by side.
struct FaceRange {
  Index first_row, end_row;
  Index first_face, end_face;
};

/// The surface as the solvers walk it: vertices in elimination order, faces sorted to follow them,
/// each face laid out in its own plane. Lengths are in units of IntrinsicMesh::unit.
struct OperatorMesh {
  std::vector<Face> faces;                 ///< F x 3, elimination numbers
  std::vector<FaceLayout> layout;          ///< F
  std::vector<Index> intrinsic_face;       ///< F: number of the face in the IntrinsicMesh
  std::vector<FaceRange> ranges;           ///< all rows, in order; the same for every thread count
  Index crossing = 0;                      ///< faces from here on have corners in several ranges
  std::vector<double> mass;                ///< n: a third of the incident areas, > 0
  std::vector<double> stiffness_diagonal;  ///< n: diagonal of L
  Components components;                   ///< of the vertices
  std::vector<char> doubled;  ///< per component: it is a tufted cover, each face of it stands twice
  std::uint64_t pattern = 0;  ///< pattern_hash of the elimination-ordered graph

  /// Pattern of the lower triangle (values empty), and for face f the entries of its pairs of
  /// corners (0,1), (1,2), (2,0); -1 for a pair that is one vertex.
  LowerMatrix lower;
  std::vector<std::array<std::int64_t, 3>> entry;

  /// Faces at each vertex: incident[incident_start[i] .. incident_start[i + 1]).
  std::vector<Index> incident_start, incident;

  std::span<const Index> faces_at(Index i) const {
    return {incident.data() + incident_start[i], incident.data() + incident_start[i + 1]};
  }
  bool is_doubled(Index component) const { return doubled[static_cast<std::size_t>(component)]; }
  Index size() const { return static_cast<Index>(mass.size()); }
  Index face_count() const { return static_cast<Index>(faces.size()); }
};

/// `local`: number of each mesh vertex in `pattern`, kNoIndex where it has none. `order`: the
/// elimination order of `pattern`. Cost: O(F).
std::shared_ptr<const OperatorMesh> build_operator_mesh(const IntrinsicMesh& mesh,
                                                        const SymmetricPattern& pattern,
                                                        std::span<const Index> local,
                                                        std::span<const Index> order);

/// Off-diagonal entries of a face's stiffness matrix for its pairs of corners (0,1), (1,2), (2,0):
/// minus half the cotangent of the angle opposite (Pinkall, Polthier 1993).
std::array<double, 3> stiffness(const FaceLayout& layout);

/// Gradient of the linear function with values u at the corners, in the face's own plane.
inline std::array<double, 2> gradient(const FaceLayout& p, double u0, double u1, double u2) {
  const double x = (u1 - u0) / p.base;
  return {x, ((u2 - u0) - p.x * x) / p.height};
}

/// Area times the inner product of a vector of the face's plane with the gradients of the three
/// hat functions: the face's part of the integrated divergence, with the sign of L phi = b.
inline std::array<double, 3> divergence(const FaceLayout& p, double x, double y) {
  const double d1 = 0.5 * (p.height * x - p.x * y);
  const double d2 = 0.5 * p.base * y;
  return {-d1 - d2, d1, d2};
}

}  // namespace geotherm
