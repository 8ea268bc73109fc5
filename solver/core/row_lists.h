// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "geotherm/types.h"
#include "solver/core/parallel.h"

namespace geotherm {

/// Fills the compressed rows of a table whose lengths are not known before: add_row(i, list)
/// appends row i to `list`; start gets rows + 1 entries, and list those of all rows. Each thread
/// lists rows of its own, and what they found is put together. Exceptions are those of add_row and
/// std::bad_alloc.
template <class AddRow>
void list_rows(Index rows, int threads, const AddRow& add_row, std::vector<std::int64_t>& start,
               std::vector<Index>& list) {
  constexpr std::int64_t kGrain = 1 << 13;  // rows a thread must have to be worth starting
  const int pieces = piece_count(threads, rows, kGrain);
  start.assign(static_cast<std::size_t>(rows) + 1, 0);
  std::vector<std::vector<Index>> parts(static_cast<std::size_t>(pieces));
  for_pieces(pieces, rows, [&](int piece, std::int64_t begin, std::int64_t end) {
    std::vector<Index>& part = parts[static_cast<std::size_t>(piece)];
    constexpr std::int64_t kLikely = 7;  // entries a row, so that the list is seldom moved
    part.reserve(static_cast<std::size_t>(kLikely * (end - begin)));
    for (std::int64_t i = begin; i < end; ++i) {
      add_row(static_cast<Index>(i), part);
      start[static_cast<std::size_t>(i) + 1] = static_cast<std::int64_t>(part.size());
    }
  });
  if (pieces == 1) {
    list = std::move(parts.front());
    return;
  }
  std::vector<std::int64_t> before(parts.size() + 1, 0);
  for (std::size_t p = 0; p < parts.size(); ++p) {
    before[p + 1] = before[p] + static_cast<std::int64_t>(parts[p].size());
  }
  list.resize(static_cast<std::size_t>(before.back()));
  for_pieces(pieces, rows, [&](int piece, std::int64_t begin, std::int64_t end) {
    const auto p = static_cast<std::size_t>(piece);
    std::copy(parts[p].begin(), parts[p].end(), list.begin() + before[p]);
    for (std::int64_t i = begin; i < end; ++i) start[static_cast<std::size_t>(i) + 1] += before[p];
  });
}

}  // namespace geotherm
