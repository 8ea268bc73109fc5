// SPDX-License-Identifier: MIT
#include "solver/mesh/corner_table.h"

#include "solver/core/counting_sort.h"

namespace geotherm {

CornerTable::CornerTable(Index vertex_count, std::span<const Face> faces, int threads) {
  const auto emit = [&faces](std::size_t f, const auto& put) {
    for (int k = 0; k < 3; ++k) put(faces[f][k], static_cast<Side>(3 * f + k));
  };
  corner_ = counting_sort<Side>(faces.size(), static_cast<std::size_t>(vertex_count), threads, emit,
                                start_);
}

}  // namespace geotherm
