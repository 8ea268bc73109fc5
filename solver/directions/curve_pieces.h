// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>
#include <vector>

#include "geotherm/path.h"
#include "solver/directions/directions_state.h"

namespace geotherm {

/// A straight piece of a curve by weights in a clean face, from its begin to its end.
struct CurvePiece {
  Index face;
  std::array<double, 3> from, to;
  double share = 1;       ///< 1 over the number of faces in which it stands
  std::size_t curve = 0;  ///< its number
};

/// Pieces of directed curves.
struct CurvePieces {
  std::vector<CurvePiece> pieces;    ///< those along an edge stand in all of its faces
  std::vector<SurfacePoint> points;  ///< of the curves, on clean faces
  /// Per edge (PathSurface::edges()): how often a curve passes from one of its faces to another, or
  /// ends on it where it is of the border.
  std::vector<int> crossings;
  std::vector<char> touched;   ///< per edge: a curve has a point in its interior
  std::vector<char> on_curve;  ///< V: vertices that are points of a curve
};

/// Errors: kBadInput (no piece, one that lies in no face; with its number).
Result<CurvePieces> curve_pieces(const PathSurface& surface, std::span<const SurfacePath> curves);

/// Errors: kBadInput where the curves go there and back on a component of the surface, such that
/// nothing is to their left or right.
Result<void> refuse_there_and_back(const Directions::State& state, const CurvePieces& curves);

}  // namespace geotherm
