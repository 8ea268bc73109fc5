// SPDX-License-Identifier: MIT
#pragma once

#include "solver/polyhedral/wave_tables.h"

// The corners of WaveTables, once its faces and edges are there.
namespace geotherm {

/// Groups the corners by their vertex.
void list_corners(WaveTables& tables, int threads);

/// Marks in WaveFace::reversed the corners at vertices where several fans of faces touch. Cost: a
/// pass over the edges and one over the corners.
void mark_fans(WaveTables& tables, int threads);

/// Where in WaveFace::reversed the corners stand at which fans touch; sides are below.
inline constexpr unsigned kFanBits = 4;

/// Whether several fans of faces touch at a vertex.
inline bool fans_touch(const WaveTables& tables, Index rank) {
  const SideCode corner = tables.corners_at(rank).front();
  const unsigned fans = tables.faces[face_of_code(corner)].reversed >> kFanBits;
  return (fans >> corner_of_code(corner) & 1U) != 0;
}

/// Marks in WaveFace::touching the corners at which a vertex hands its distance on by itself: those
/// where fans touch, and those with sides of very different lengths. There a wave asks for corners
/// in order, by the places of their faces. Those of the surface `base` are put in it.
void mark_touching(WaveTables& tables, int threads, const IntrinsicSurface& base);

}  // namespace geotherm
