// SPDX-License-Identifier: MIT
#include "engine/scene/line_pieces.h"

#include <cmath>

namespace geotherm::engine {
namespace {

/// Of scene space, which has radius 1: a few roundings of single precision. The direction of a
/// shorter piece is only noise.
constexpr float kShortestPiece = 1e-6F;

bool is_finite(const glm::vec3& p) { return std::isfinite(p.x + p.y + p.z); }

bool is_repeated(const glm::vec3& a, const glm::vec3& b) {
  return glm::length(a - b) <= kShortestPiece;
}

}  // namespace

std::vector<std::vector<glm::vec3>> finite_runs(std::span<const glm::vec3> points) {
  std::vector<std::vector<glm::vec3>> runs(1);
  for (const glm::vec3& point : points) {
    if (is_finite(point)) {
      runs.back().push_back(point);
    } else if (!runs.back().empty()) {
      runs.emplace_back();
    }
  }
  if (runs.back().empty()) runs.pop_back();
  return runs;
}

std::vector<LinePiece> line_pieces(std::span<const glm::vec3> points) {
  std::vector<glm::vec3> chain;
  for (const glm::vec3& point : points) {
    if (chain.empty() || !is_repeated(chain.back(), point)) chain.push_back(point);
  }
  const std::size_t count = chain.size();
  const bool closed = count > 3 && is_repeated(chain.front(), chain.back());
  std::vector<LinePiece> pieces;
  for (std::size_t i = 0; i + 1 < count; ++i) {
    const glm::vec3& at_begin = closed ? chain[count - 2] : chain[0];
    const glm::vec3& at_end = closed ? chain[1] : chain[count - 1];
    pieces.push_back({i > 0 ? chain[i - 1] : at_begin, chain[i], chain[i + 1],
                      i + 2 < count ? chain[i + 2] : at_end});
  }
  return pieces;
}

}  // namespace geotherm::engine
