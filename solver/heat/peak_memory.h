// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>

#include "geotherm/error.h"
#include "geotherm/types.h"

namespace geotherm {

/// How many faces there are when each has been cut into four so often. More than 16 times count as
/// 16, which makes more faces than can be numbered already.
inline std::int64_t refined_faces(Index faces, int times) {
  return std::int64_t{faces} << (2 * std::clamp(times, 0, 16));
}

/// Memory at the peak of reading a closed surface of so many vertices, setting the heat method up
/// and one query: the power law through what was measured.
double heat_peak_bytes(double vertices);

/// The memory at the peak of the same for a mesh that was refined to so many faces.
double refined_bytes(std::int64_t faces);

/// Whether a mesh whose faces are each cut into four `refine` times fits into the memory that is
/// free. More faces than can be numbered are left to subdivide(), which refuses them. Errors:
/// kOutOfMemory, with the largest `refine` that fits.
Result<void> check_refined_memory(Index faces, int refine);

}  // namespace geotherm
