// SPDX-License-Identifier: MIT
#pragma once

#include "solver/polyhedral/wave_tables.h"

// The corners of WaveTables, once its faces and edges are there.
namespace geotherm {

/// Groups the corners by their vertex.
void list_corners(WaveTables& tables);

/// Marks in WaveFace::reversed the corners at vertices where several fans of faces touch. Cost: a
/// pass over the edges and one over the corners.
void mark_fans(WaveTables& tables, int threads);

/// Marks in WaveFace::touching the corners at which a vertex hands its distance on by itself: those
/// where fans touch, and those with sides of very different lengths.
void mark_touching(WaveTables& tables, int threads);

}  // namespace geotherm
