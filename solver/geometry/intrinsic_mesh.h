// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "geotherm/mesh_report.h"
#include "solver/geometry/clean_faces.h"
#include "solver/mesh/connectivity.h"

namespace geotherm {

/// A surface as faces and edge lengths, without positions. Everything numerical is computed from
/// this: the mesh of the file, its intrinsic Delaunay triangulation and any other triangulation of
/// the same surface are one code path.
///
/// Side k of a face joins its corners k and k + 1. Both sides of an inner edge have the same
/// length; every face satisfies the triangle inequality strictly.
struct IntrinsicMesh {
  std::vector<Face> faces;                     ///< F x 3 vertices
  std::vector<std::array<double, 3>> lengths;  ///< F x 3, in units of `unit`
  std::vector<Side> twin;                      ///< 3F: the other side of the edge, or kNoSide
  double unit = 1.0;                           ///< length of 1 in model units: the mean edge length
  Mollification mollified;                     ///< what was added to lengths, in units of `unit`
  /// On the tufted cover, and empty elsewhere: for every face of the surface (they come first) the
  /// number of its back before flips, kNoIndex where its component has none.
  std::vector<Index> back;

  Index face_count() const { return static_cast<Index>(faces.size()); }

  /// Sets the corners, lengths and twins of face f, and the entries of its twins. Precondition: f
  /// is below face_count().
  void set_face(Index f, const Face& corners, const std::array<double, 3>& sides,
                const std::array<Side, 3>& twins) {
    faces[f] = corners;
    lengths[f] = sides;
    for (int k = 0; k < 3; ++k) {
      twin[3 * f + k] = twins[k];
      if (twins[k] != kNoSide) twin[twins[k]] = 3 * f + k;
    }
  }
};

/// What every triangle must be.
enum class Strictness {
  /// 1e-5 of its longest side high: flips, which remove most flat triangles, and waves need no
  /// more.
  kHeights,
  /// Its triangle inequalities strict by 1e-5 of its longest side, as matrices need them: a needle
  /// is as wide as with kHeights, an obtuse triangle at least 1/450 of its longest side high.
  kInequalities
};

/// Lengthens edges until every triangle is as strict as that (Sharp, Crane 2020, section 4.5, where
/// one length is added to all edges). Here only edges of faces that fail are lengthened, the
/// shorter ones of the face, and those of neighbours that fail because of it: a degenerate face
/// leaves no trace a few faces away. Where this has no end within a hundred rounds, the smallest
/// common length that does it is added to all edges of the component. Adds to mesh.mollified, but
/// for the backs of a tufted cover, which repeat it, and returns how many faces failed.
///
/// Lengths are the same for all sides of an edge, before and after, in units of about their mean.
/// Cost: O(F), and a few visits of each failing face.
Index mollify(IntrinsicMesh& mesh, Strictness strictness, int threads = 1);

/// The lowest side of each side's edge (3F). Sides without other twins are of one edge where they
/// join the same vertices: at edges with three faces or more, and where two faces disagree in
/// orientation; flips leave these alone. Cost: O(F), and a sort of the sides without twins.
std::vector<Side> first_sides(const IntrinsicMesh& mesh);

/// Mean length over the edges (each counted once), model units; 0 where there are none. The same
/// bits with any number of threads.
double mean_edge_length(std::span<const Vec3> positions, const EdgeTable& edges, int threads = 1);

/// The vertices of a side, the lower one first.
inline std::pair<Index, Index> ends_of(const IntrinsicMesh& mesh, Side side) {
  const Face& face = mesh.faces[face_of(side)];
  return std::minmax({face[corner_of(side)], face[next_corner(corner_of(side))]});
}

/// |v|, also where its square is out of the doubles' range. A vector scaled by a power of two has
/// the norm scaled by that, to the last bit.
inline double safe_norm(const Vec3& v) {
  constexpr double kSafeLow = 1e-280, kSafeHigh = 1e280;
  const double square = v.squaredNorm();
  if (square > kSafeLow && square < kSafeHigh) return std::sqrt(square);
  const double largest = v.cwiseAbs().maxCoeff();
  if (!(largest > 0) || !std::isfinite(largest)) return largest;
  int exponent = 0;
  std::frexp(largest, &exponent);
  const auto scaled = [exponent](double x) { return std::ldexp(x, -exponent); };
  return std::ldexp(Vec3(scaled(v[0]), scaled(v[1]), scaled(v[2])).norm(), exponent);
}

/// Builds the intrinsic mesh of clean faces. Lengths are divided by `unit` (> 0), so that what
/// follows sees numbers of order 1 at any scale. Faces that are degenerate or nearly so are
/// mollified (mollify()). Edges with a
/// number of sides other than two, or whose faces disagree in orientation, get no twins. Cost:
/// O(F).
IntrinsicMesh build_intrinsic_mesh(std::span<const Vec3> positions, const CleanFaces& clean,
                                   double unit, int threads = 1,
                                   Strictness strictness = Strictness::kInequalities);

/// A triangle laid out in its own plane: corner 0 at the origin, corner 1 at (base, 0), corner 2
/// at (x, height), height > 0.
struct FaceLayout {
  double base, x, height;
};
FaceLayout lay_out(const std::array<double, 3>& lengths);

/// Twice the cotangent weight of a side's own face: the cotangent of the angle opposite to it.
double opposite_cotangent(const std::array<double, 3>& lengths, int side);

/// False only where the angle opposite to the side is at most a right one, and the cotangent
/// therefore not negative. A cheap test that takes no square root.
inline bool may_be_obtuse(const std::array<double, 3>& l, int side) {
  const double a = l[side], b = l[next_corner(side)], c = l[previous_corner(side)];
  return !(b * b + (c - a) * (c + a) >= 0);
}

}  // namespace geotherm
