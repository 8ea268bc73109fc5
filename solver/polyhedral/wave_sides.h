// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "solver/polyhedral/wave_tables.h"

// The sides of WaveTables, once its faces have corners and edges.
namespace geotherm {

/// Passes over the tables fetch the faces that they will read so many steps later: these lie apart
/// in memory, and waiting for them would be most of the time.
inline constexpr std::int64_t kFetchedAhead = 16;

/// The lengths of the sides of a block of faces, in units of the intrinsic mesh.
struct SideLengths {
  double sum = 0, longest = 0;
};

/// Sets the lengths of a face, and adds them.
void set_lengths(const std::array<double, 3>& lengths, WaveFace& face, SideLengths& block);

/// Sets what the tables say of the lengths of all sides.
void sum_up(std::span<const SideLengths> blocks, WaveTables& tables);

/// Lists the sides of each edge, that of the face whose other corner comes first (WaveOrder) before
/// the others, and marks in WaveFace::reversed those that run against the first. Precondition:
/// `reversed` says nothing of sides. Cost: a pass over the faces.
void join_sides(const IntrinsicSurface& base, int threads, WaveTables& tables);

/// The same where sides and `reversed` are those from before the surface moved, but in faces that
/// are `changed`, by their numbers in the tables. Cost: a quicker pass over the edges.
void rejoin_sides(const IntrinsicSurface& base, const std::vector<char>& changed, int threads,
                  WaveTables& tables);

}  // namespace geotherm
