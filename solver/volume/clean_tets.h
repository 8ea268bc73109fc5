// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "geotherm/domains.h"

namespace geotherm {

/// What linear functions on one tet need: the gradients of its four hat functions, each 1 at its
/// corner and 0 at the others, and its volume.
struct TetGradient {
  std::array<Vec3, 4> gradients;  ///< 1 / model units; they sum to 0 exactly up to round-off
  double volume = 0;              ///< > 0; 0 for a flat tet, whose gradients are 0
};

/// Gradient of a field u on the tet: sum of u_i gradients[i]; entry (i, j) of its stiffness: volume
/// gradients[i] . gradients[j]; of its lumped mass: volume / 4. The orientation does not matter.
///
/// A tet is flat where its least height is below kFlatHeight of its longest edge, or its volume is
/// beyond the range of doubles. Nothing is
/// divided by a height below that, so that slivers down to there give finite, right gradients.
/// Lengths are taken in units of the longest edge: no product over- or underflows.
TetGradient tet_gradient(const Vec3& p0, const Vec3& p1, const Vec3& p2, const Vec3& p3);

/// The share of the longest edge below which a height counts as none. The height, not the volume
/// over the cube of an edge: a rod or a plate that is a thousand times longer than thick consists
/// of good tets of little volume. A height of h gives entries of 1/h in the stiffness matrix where
/// good tets have 1, which a factor in single precision can bear up to about a million; and a
/// volume of this share is nothing, so that leaving the tet out changes the operators by less than
/// the error of linear functions does. (Lengths could be mollified in place of that, as on
/// surfaces. In space lengths that keep the triangle inequalities need not make a tet, and the
/// sliver, once thickened, would take room that its neighbours have.)
inline constexpr double kFlatHeight = 1e-6;

/// The least height of a tet with a volume, in its shortest edges.
double height_in_edges(const TetMesh& mesh, const Tet& tet, const TetGradient& element);

/// The height_in_edges() below which a tet is a sliver. Not in longest edges: the tets of thin
/// plates and rods are good. Chosen by measurement (docs/volumes.md).
inline constexpr double kSliverHeight = 0.2;

/// The tets that can carry an operator, and what was left out.
struct CleanTets {
  std::vector<Tet> tets;        ///< positive: (p1 - p0) . ((p2 - p0) x (p3 - p0)) > 0
  std::vector<Index> original;  ///< number of each in the mesh, ascending
  Index repeated_corner = 0;    ///< tets left out: two corners are one vertex
  Index duplicate = 0;          ///< tets left out: the same four vertices as an earlier one
  Index flat = 0;               ///< tets left out: no height (tet_gradient())
  Index turned = 0;             ///< tets that were negative
  Index lost_vertices = 0;      ///< vertices all of whose tets were left out
  Index unused_vertices = 0;    ///< vertices of no tet at all

  /// A sentence for each that is not 0, for people; none about orientation.
  std::vector<std::string> notes() const;
};

/// Throws std::bad_alloc. Cost: O(V + T).
CleanTets clean_tets(const TetMesh& mesh);

/// Which tets the border and the operators are made of before flat ones are left out: those without
/// a repeated corner that are the first of their four vertices. T: 0 where it counts, else why not.
enum class TetFault : std::uint8_t { kNone, kRepeatedCorner, kDuplicate };
std::vector<TetFault> find_tet_faults(const TetMesh& mesh);

/// The corners of the face opposite corner k, counter-clockwise from outside a positive tet.
inline Face face_opposite(const Tet& tet, int k) {
  static constexpr std::array<std::array<int, 3>, 4> kCorners = {
      {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
  const auto& c = kCorners[static_cast<std::size_t>(k)];
  return {tet[c[0]], tet[c[1]], tet[c[2]]};
}

/// Six times the signed volume, in cubes of the longest edge; to round-off.
double orientation_of(const Vec3& p0, const Vec3& p1, const Vec3& p2, const Vec3& p3);

}  // namespace geotherm
