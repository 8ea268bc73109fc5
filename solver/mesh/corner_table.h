// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geotherm/types.h"
#include "solver/core/raw_vector.h"
#include "solver/mesh/side.h"

namespace geotherm {

/// The corners of a face list grouped by their vertex, ascending at each. Corner k of face f has
/// the number of the side that begins there, 3 f + k.
///
/// Cost: O(V + F), one counting sort, by all threads.
class CornerTable {
 public:
  CornerTable() = default;
  CornerTable(Index vertex_count, std::span<const Face> faces, int threads = 1);

  Index vertex_count() const { return static_cast<Index>(start_.size()) - 1; }
  std::span<const Side> at(Index vertex) const {
    const auto v = static_cast<std::size_t>(vertex);
    return {corner_.data() + start_[v], corner_.data() + start_[v + 1]};
  }

 private:
  std::vector<std::uint32_t> start_ = {0};
  RawVector<Side> corner_;
};

}  // namespace geotherm
