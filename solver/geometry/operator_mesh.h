// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "geotherm/backend.h"
#include "solver/core/memory.h"
#include "solver/geometry/intrinsic_mesh.h"
#include "solver/geometry/row_ranges.h"
#include "solver/linear/symmetric_pattern.h"
#include "solver/mesh/connectivity.h"

namespace geotherm {

/// The pattern of any operator on a surface, which is pattern_of_faces() of its faces: from each
/// vertex the sides that begin there lead to its neighbours, and those that end there and have no
/// twin. `corners`: of mesh.faces. `used`: the vertices that faces use, ascending; `local`: for
/// every vertex its number among them. Cost: O(F), by all threads.
SymmetricPattern surface_pattern(const IntrinsicMesh& mesh, const CornerTable& corners,
                                 std::span<const Index> used, std::span<const Index> local,
                                 int threads);

/// The surface as the solvers walk it: vertices in elimination order, faces sorted to follow them,
/// each face laid out in its own plane. Lengths are in units of IntrinsicMesh::unit.
struct OperatorMesh {
  RawVector<Face> faces;                 ///< F x 3, elimination numbers
  RawVector<FaceLayout> layout;          ///< F
  RawVector<Index> intrinsic_face;       ///< F: number of the face in the IntrinsicMesh
  std::vector<RowRange> ranges;          ///< all rows, in order; the same for every thread count
  Index crossing = 0;                    ///< faces from here on have corners in several ranges
  RawVector<double> mass;                ///< n: a third of the incident areas, > 0
  RawVector<double> stiffness_diagonal;  ///< n: diagonal of L
  Components components;                 ///< of the vertices
  std::vector<double> area;   ///< per component, of the surface: a cover has twice as much
  std::vector<char> doubled;  ///< per component: it is a tufted cover, each face of it stands twice
  std::uint64_t pattern = 0;  ///< pattern_hash of the elimination-ordered graph

  LowerPattern lower;  ///< the lower triangle of that graph

  CornerTable corners;  ///< of `faces`

  bool is_doubled(Index component) const { return doubled[static_cast<std::size_t>(component)]; }
  Index size() const { return static_cast<Index>(mass.size()); }
  Index face_count() const { return static_cast<Index>(faces.size()); }
};

/// `local`: number of each vertex of the mesh in `pattern`, kNoIndex where it has none. `order`:
/// the elimination order of `pattern`; `parts`: its connected components. The same bits with any
/// number of threads. Cost: O(F).
std::shared_ptr<const OperatorMesh> build_operator_mesh(const IntrinsicMesh& mesh,
                                                        const SymmetricPattern& pattern,
                                                        std::span<const Index> local,
                                                        std::span<const Index> order,
                                                        const Components& parts, int threads = 1);

/// Operators in an order that is given by vertices of the mesh. `parts`: of the vertices.
/// `analyze` is called, beside the rest, with the pattern in that order.
std::shared_ptr<const OperatorMesh> follow_order(
    const IntrinsicMesh& mesh, std::span<const Index> vertex_of_row,
    std::span<const Index> row_of_vertex, const Components& parts, int threads,
    const std::function<void(const SymmetricPattern&, int threads)>& analyze);

/// How a mesh differs from the one before it moved, where it does in few places. Empty where it
/// does in many, or where that is not known.
struct OperatorChanges {
  std::vector<char> faces;         ///< F of the mesh: other corners or lengths, or one that rose
  std::vector<char> rows;          ///< n: EarlierFactor::changed; corners of those, now or before
  std::vector<char> rose;          ///< n: the vertex is in another node of the elimination tree
  std::vector<Index> earlier_row;  ///< n: EarlierRows::number

  bool empty() const { return rows.empty(); }
};

/// The operators of a mesh that has the faces and twins of an earlier one, and other lengths: only
/// where `changes` says so, or everywhere where it is empty.
std::shared_ptr<const OperatorMesh> moved_operator_mesh(const OperatorMesh& earlier,
                                                        const IntrinsicMesh& mesh,
                                                        const OperatorChanges& changes,
                                                        int threads);

/// As follow_order(), for a mesh that differs from an earlier one in few places; `changes` is not
/// empty. `analyze` gets the lower triangle of the pattern. Cost: that of the changes, and of
/// copying the rest.
std::shared_ptr<const OperatorMesh> update_operators(
    const OperatorMesh& earlier, const IntrinsicMesh& mesh, const OperatorChanges& changes,
    std::span<const Index> vertex_of_row, std::span<const Index> row_of_vertex,
    const Components& parts, int threads,
    const std::function<void(const LowerPattern&, int threads)>& analyze);

/// Off-diagonal entries of a face's stiffness matrix for its pairs of corners (0,1), (1,2), (2,0):
/// minus half the cotangent of the angle opposite (Pinkall, Polthier 1993).
inline std::array<double, 3> stiffness(const FaceLayout& p) {
  const double half_over_height = 0.5 / p.height;
  const double w12 = -p.x * half_over_height;
  const double w20 = (p.x - p.base) * half_over_height;
  const double w01 = (2 * p.x * (p.base - p.x) * half_over_height - p.height) / (2 * p.base);
  return {w01, w12, w20};
}

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
