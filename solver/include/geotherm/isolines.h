// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "geotherm/path.h"

// Level sets of distances, or of any values at the vertices.
namespace geotherm {

/// A piece of a level set, as long as it can be followed: closed, or open from boundary to boundary
/// (or to an edge with three faces and more).
struct Isoline {
  double value = 0;
  SurfacePath path;
};

/// Level sets of the function that is linear on each face. `values`: V, file order; faces with a
/// value that is not finite have none. `levels`: ascending. Sorted by level, the longest first. The
/// lines of a value that vertices have pass through these; no piece has length 0.
/// Cost: O(F log levels + pieces). Throws std::bad_alloc; find_isolines() does not.
std::vector<Isoline> trace_isolines(const TriangleMesh& mesh, std::span<const double> values,
                                    std::span<const double> levels);

/// The same. Errors: kOutOfMemory.
Result<std::vector<Isoline>> find_isolines(const TriangleMesh& mesh, std::span<const double> values,
                                           std::span<const double> levels);

}  // namespace geotherm
