// SPDX-License-Identifier: MIT
#include "solver/linear/symmetric_pattern.h"

#include <algorithm>

#include "solver/core/parallel.h"
#include "solver/core/sorting.h"

namespace geotherm {
namespace {

/// Minimum rows per thread.
constexpr std::int64_t kMinEntriesPerThread = 1 << 15;

void mix(std::uint64_t x, std::uint64_t& hash) {
  hash = (hash ^ x) * 0xff51afd7ed558ccdULL;
  hash ^= hash >> 32;
}

/// A hash over blocks of columns of a fixed length, so that any number of threads finds the same.
/// rows_below(j): the rows of column j below the diagonal, ascending.
template <class RowsBelow>
std::uint64_t hash_of_columns(Index size, int threads, const RowsBelow& rows_below) {
  constexpr std::int64_t kBlock = 8192;
  const std::int64_t blocks = (size + kBlock - 1) / kBlock;
  std::vector<std::uint64_t> parts(static_cast<std::size_t>(blocks), 0);
  parallel_each(threads, blocks, kMinEntriesPerThread / kBlock, [&](std::int64_t b) {
    std::uint64_t& hash = parts[static_cast<std::size_t>(b)];
    const auto end = static_cast<Index>(std::min<std::int64_t>(size, (b + 1) * kBlock));
    for (auto j = static_cast<Index>(b * kBlock); j < end; ++j) {
      const auto rows = rows_below(j);
      mix(rows.size(), hash);
      for (const Index i : rows) mix(static_cast<std::uint64_t>(i), hash);
    }
  });
  std::uint64_t hash = 0x9e3779b97f4a7c15ULL ^ static_cast<std::uint64_t>(size);
  for (const std::uint64_t part : parts) mix(part, hash);
  return hash;
}

}  // namespace

SymmetricPattern pattern_of_faces(Index size, std::span<const Face> faces) {
  // Every side enters both its ends' lists; the second face of an edge doubles the entry.
  std::vector<std::int64_t> start(static_cast<std::size_t>(size) + 1, 0);
  for (const Face& face : faces) {
    for (const Index corner : face) start[corner + 1] += 2;
  }
  for (Index i = 0; i < size; ++i) start[i + 1] += start[i];
  std::vector<Index> entry(static_cast<std::size_t>(start[size]));
  std::vector<std::int64_t> cursor(start.begin(), start.end() - 1);
  for (const Face& face : faces) {
    for (int k = 0; k < 3; ++k) {
      entry[cursor[face[k]]++] = face[(k + 1) % 3];
      entry[cursor[face[k]]++] = face[(k + 2) % 3];
    }
  }
  SymmetricPattern pattern;
  pattern.start.resize(static_cast<std::size_t>(size) + 1);
  pattern.neighbor.reserve(entry.size() / 2 + entry.size() / 16);
  for (Index i = 0; i < size; ++i) {
    const auto begin = entry.begin() + start[i];
    const auto end = entry.begin() + start[i + 1];
    std::sort(begin, end);
    for (auto it = begin; it != end; ++it) {
      if (*it != i && (it == begin || *it != *(it - 1))) pattern.neighbor.push_back(*it);
    }
    pattern.start[i + 1] = static_cast<std::int64_t>(pattern.neighbor.size());
  }
  return pattern;
}

SymmetricPattern permuted(const SymmetricPattern& pattern, std::span<const Index> order,
                          int threads) {
  const std::vector<Index> position = inverse_permutation(order, threads);
  const auto add_row = [&](Index k, std::vector<Index>& list) {
    const auto begin = static_cast<std::ptrdiff_t>(list.size());
    for (const Index j : pattern.neighbors(order[k])) list.push_back(position[j]);
    short_sort(list.data() + begin, list.data() + list.size());
  };
  SymmetricPattern out;
  list_rows(pattern.size(), threads, add_row, out.start, out.neighbor);
  return out;
}

LowerPattern permuted_lower(const SymmetricPattern& pattern, std::span<const Index> order,
                            int threads) {
  const std::vector<Index> position = inverse_permutation(order, threads);
  const auto add_column = [&](Index k, std::vector<Index>& list) {
    list.push_back(k);
    const auto begin = static_cast<std::ptrdiff_t>(list.size());
    for (const Index j : pattern.neighbors(order[k])) {
      if (position[j] > k) list.push_back(position[j]);
    }
    short_sort(list.data() + begin, list.data() + list.size());
  };
  LowerPattern out;
  list_rows(pattern.size(), threads, add_column, out.start, out.row);
  return out;
}

LowerPattern lower_of(const SymmetricPattern& pattern, int threads) {
  LowerPattern out;
  const auto add_column = [&pattern](Index k, std::vector<Index>& list) {
    const auto all = pattern.neighbors(k);
    list.push_back(k);
    list.insert(list.end(), std::ranges::upper_bound(all, k), all.end());
  };
  list_rows(pattern.size(), threads, add_column, out.start, out.row);
  return out;
}

std::vector<Index> inverse_permutation(std::span<const Index> order, int threads) {
  std::vector<Index> position(order.size());
  parallel_each<Index>(threads, std::ssize(order), kMinEntriesPerThread,
                       [&](Index k) { position[order[k]] = k; });
  return position;
}

std::uint64_t pattern_hash(const SymmetricPattern& pattern, int threads) {
  return hash_of_columns(pattern.size(), threads, [&pattern](Index i) {
    const auto all = pattern.neighbors(i);
    return std::span(std::ranges::upper_bound(all, i), all.end());
  });
}

std::uint64_t pattern_hash(const LowerPattern& lower, int threads) {
  const auto size = static_cast<Index>(lower.start.size()) - 1;
  return hash_of_columns(size, threads, [&lower](Index i) {
    return std::span(lower.row.data() + lower.start[i] + 1, lower.row.data() + lower.start[i + 1]);
  });
}

void name_components(const Components& parts, std::span<const Index> order, Components& out) {
  out.count = parts.count;
  out.of.assign(order.size(), 0);
  if (parts.count == 1) return;
  std::vector<Index> name(static_cast<std::size_t>(parts.count), kNoIndex);
  Index named = 0;
  for (std::size_t k = 0; k < order.size(); ++k) {
    Index& here = name[parts.of[order[k]]];
    if (here == kNoIndex) here = named++;
    out.of[k] = here;
  }
}

}  // namespace geotherm
