// SPDX-License-Identifier: MIT
#include "solver/linear/symmetric_pattern.h"

#include <algorithm>

namespace geotherm {

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

SymmetricPattern permuted(const SymmetricPattern& pattern, std::span<const Index> order) {
  const std::vector<Index> position = inverse_permutation(order);
  SymmetricPattern out;
  out.start.resize(pattern.start.size());
  out.neighbor.resize(pattern.neighbor.size());
  std::int64_t filled = 0;
  for (Index k = 0; k < pattern.size(); ++k) {
    const std::int64_t begin = filled;
    for (const Index j : pattern.neighbors(order[k])) out.neighbor[filled++] = position[j];
    std::sort(out.neighbor.begin() + begin, out.neighbor.begin() + filled);
    out.start[k + 1] = filled;
  }
  return out;
}

std::vector<Index> inverse_permutation(std::span<const Index> order) {
  std::vector<Index> position(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) position[order[k]] = static_cast<Index>(k);
  return position;
}

std::uint64_t pattern_hash(const SymmetricPattern& pattern) {
  std::uint64_t hash = 0x9e3779b97f4a7c15ULL ^ static_cast<std::uint64_t>(pattern.size());
  const auto mix = [&hash](std::uint64_t x) {
    hash = (hash ^ x) * 0xff51afd7ed558ccdULL;
    hash ^= hash >> 32;
  };
  for (Index i = 0; i < pattern.size(); ++i) {
    mix(static_cast<std::uint64_t>(pattern.start[i + 1]));
    for (const Index j : pattern.neighbors(i)) mix(static_cast<std::uint64_t>(j));
  }
  return hash;
}

Components connected_components(const SymmetricPattern& pattern) {
  Components out;
  out.of.assign(static_cast<std::size_t>(pattern.size()), kNoIndex);
  std::vector<Index> stack;
  for (Index seed = 0; seed < pattern.size(); ++seed) {
    if (out.of[seed] != kNoIndex) continue;
    out.of[seed] = out.count;
    stack.push_back(seed);
    while (!stack.empty()) {
      const Index i = stack.back();
      stack.pop_back();
      for (const Index j : pattern.neighbors(i)) {
        if (out.of[j] != kNoIndex) continue;
        out.of[j] = out.count;
        stack.push_back(j);
      }
    }
    ++out.count;
  }
  return out;
}

}  // namespace geotherm
