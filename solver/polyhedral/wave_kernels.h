// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "solver/core/processor.h"
#include "solver/polyhedral/wave_tables.h"

namespace geotherm {

/// An edge is visited again when one of its values fell by this share of the face's longest side.
inline constexpr double kNotice = 1e-4;

/// Edges that wait, first in, first out.
struct WaveBucket {
  Index* edges;
  Index size, capacity;
};

/// What a wave reads and writes: raw, because code for several instruction sets must share no
/// inline function of the library. Numbers are those of WaveTables.
struct WavePass {
  const WaveFace* faces;
  const std::array<SideCode, 2>* sides;
  const SideCode* more;
  const std::uint32_t* corner_start;  ///< n + 1
  const SideCode* corners;

  double* distance;      ///< n
  double* sample;        ///< E x samples: distance there, in the direction of the edge
  Index* label;          ///< n: of the source that gave the distance; null where nobody asks
  Index* sample_label;   ///< E x samples
  std::uint8_t* queued;  ///< E
  double* spread_below;  ///< n: a touching vertex spreads again when it falls below this
  double floor;          ///< no value is set below this: what lies there has its final value
  double longest;        ///< side of the faces that were crossed so far

  WaveBucket* buckets;  ///< a ring of bucket_mask + 1
  std::int64_t bucket_mask;
  std::int64_t current;  ///< number of the bucket that is being emptied, not wrapped
  std::int64_t waiting;  ///< edges in all buckets
  double per_length;     ///< buckets for a length of 1
  std::int64_t place;    ///< edges of the current bucket that have been visited
  void (*grow)(void* context, WaveBucket& bucket);
  void* context;
};

/// Visits edges of the current bucket until it is empty (and resets it) or `most` are visited:
/// samples 1 or 3 on each edge, labels carried along where pass.label is set. The answer is the
/// same to the last bit for every instruction set. Returns the number of visits; corners to which a
/// vertex spreads are visits, too, and may be more than `most`.
std::size_t visit_current_bucket(WavePass& pass, int samples, std::size_t most,
                                 InstructionSet set = best_instruction_set());

}  // namespace geotherm
