// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "solver/geometry/delaunay.h"

namespace geotherm {

/// A point (`from` is `to`) or a straight piece in one face, by barycentric weights.
struct FacePiece {
  Index face = kNoIndex;
  std::array<double, 3> from{}, to{};
  std::size_t source = 0;  ///< what it came from, for the caller
};

/// Carries pieces of the unflipped faces to the flipped ones; a piece that a new edge crosses
/// becomes two. Weights within kAtCorner of 0 are 0 afterwards. Cost: O(flips + F) and a few
/// nanoseconds for each flip of a face with pieces.
std::vector<FacePiece> carry_pieces(const std::vector<Flip>& flips, Index face_count,
                                    std::vector<FacePiece> pieces);

}  // namespace geotherm
