// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "geotherm/types.h"

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
    /// two: f = (a, p, c), g = (p, b, c). `numbers`: the share |ap| / |ab|.
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

}  // namespace geotherm
