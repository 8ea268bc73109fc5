// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "geotherm/types.h"
#include "solver/geometry/intrinsic_mesh.h"

namespace geotherm {

/// One change of an intrinsic triangulation, kept so that what lies on a face of the mesh can be
/// found again in the changed triangulation. A change names faces by the numbers they have at its
/// time; new faces come last.
struct Edit {
  enum class Kind : std::int8_t {
    /// The edge between f = (a, b, c), from its corner `start_f` on, and g = (b, a, d), from
    /// `start_g` on, is flipped: f = (c, a, d), g = (d, b, c). `numbers`: lengths ab, bc, ca, ad,
    /// db.
    kFlip,
    /// A vertex p on the side from a to b of f = (a, b, c), from `start_f` on, cuts the face in
    /// two: f = (a, p, c), g = (p, b, c). `numbers`: the share |ap| / |ab|. `start_g`: 1 in the
    /// second face of an edge with two, else 0.
    kSideSplit,
    /// A vertex p in f = (a, b, c) cuts it in three: f = (a, b, p), g = (b, c, p),
    /// g + 1 = (c, a, p). `numbers`: the barycentric weights of p.
    kFaceSplit,
  };
  Index f, g;
  Kind kind;
  std::int8_t start_f, start_g;
  std::array<double, 5> numbers;
};

/// A point (`from` is `to`) or a straight piece in one face, by barycentric weights.
struct FacePiece {
  Index face = kNoIndex;
  std::array<double, 3> from{}, to{};
  std::size_t source = 0;  ///< what it came from, for the caller
};

/// Carries pieces from the faces before the edits to those after them; a piece that a new edge
/// crosses becomes two. `face_count`: of the faces after all edits. Weights within kAtCorner of 0
/// are 0 afterwards. Pieces are ordered by their faces. Cost: O(edits + face_count) with small
/// constants, and some ten nanoseconds for each edit of a face with pieces.
std::vector<FacePiece> carry_pieces(std::span<const Edit> edits, Index face_count,
                                    std::vector<FacePiece> pieces);

/// The quadrilateral of a flip in the plane: a at the origin, b on the positive x axis, c above,
/// d below. Names as in Edit.
struct FlipDiamond {
  Eigen::Vector2d a, b, c, d;
};

/// `l`: lengths ab, bc, ca, ad, db.
inline FlipDiamond unfold(const std::array<double, 5>& l) {
  const FaceLayout upper = lay_out({l[0], l[1], l[2]});
  const FaceLayout lower = lay_out({l[0], l[4], l[3]});
  return {Eigen::Vector2d(0, 0), Eigen::Vector2d(l[0], 0), Eigen::Vector2d(upper.x, upper.height),
          Eigen::Vector2d(lower.x, -lower.height)};
}

inline double cross(const Eigen::Vector2d& x, const Eigen::Vector2d& y) {
  return x.x() * y.y() - x.y() * y.x();
}

/// Barycentric weights of `p` in triangle (u, v, w), clipped to it.
inline std::array<double, 3> clipped_weights(const Eigen::Vector2d& u, const Eigen::Vector2d& v,
                                             const Eigen::Vector2d& w, const Eigen::Vector2d& p) {
  std::array<double, 3> weights = {std::max(cross(v - p, w - p), 0.0),
                                   std::max(cross(w - p, u - p), 0.0),
                                   std::max(cross(u - p, v - p), 0.0)};
  const double sum = weights[0] + weights[1] + weights[2];
  for (double& x : weights) x /= sum;
  return weights;
}

}  // namespace geotherm
