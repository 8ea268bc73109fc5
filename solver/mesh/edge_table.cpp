// SPDX-License-Identifier: MIT
#include "solver/mesh/edge_table.h"

#include <algorithm>

namespace geotherm {

EdgeTable::EdgeTable(Index vertex_count, std::span<const Face> faces) {
  // Bucket the sides by their lower vertex; a bucket holds about three, so an insertion sort by
  // the higher vertex finishes the job. This beats a comparison sort of all sides severalfold.
  struct Entry {
    Index high;
    Side side;
  };
  std::vector<std::size_t> start(static_cast<std::size_t>(vertex_count) + 1, 0);
  for (const Face& face : faces) {
    for (int k = 0; k < 3; ++k) ++start[std::min(face[k], face[next_corner(k)]) + 1];
  }
  for (std::size_t v = 0; v < static_cast<std::size_t>(vertex_count); ++v) start[v + 1] += start[v];
  std::vector<Entry> entries(3 * faces.size());
  {
    std::vector<std::size_t> cursor(start.begin(), start.end() - 1);
    for (std::size_t f = 0; f < faces.size(); ++f) {
      for (int k = 0; k < 3; ++k) {
        const Index a = faces[f][k];
        const Index b = faces[f][next_corner(k)];
        entries[cursor[std::min(a, b)]++] = {std::max(a, b), static_cast<Side>(3 * f + k)};
      }
    }
  }

  first_.clear();
  sides_.reserve(entries.size());
  low_.reserve(entries.size() / 2 + 1);
  high_.reserve(entries.size() / 2 + 1);
  first_.reserve(entries.size() / 2 + 2);
  for (Index v = 0; v < vertex_count; ++v) {
    const auto begin = entries.begin() + static_cast<std::ptrdiff_t>(start[v]);
    const auto end = entries.begin() + static_cast<std::ptrdiff_t>(start[v + 1]);
    if (end - begin > 1) {
      std::sort(begin, end, [](const Entry& a, const Entry& b) {
        return a.high != b.high ? a.high < b.high : a.side < b.side;
      });
    }
    for (auto it = begin; it != end; ++it) {
      if (it == begin || it->high != (it - 1)->high) {
        low_.push_back(v);
        high_.push_back(it->high);
        first_.push_back(sides_.size());
      }
      sides_.push_back(it->side);
    }
  }
  first_.push_back(sides_.size());
}

}  // namespace geotherm
