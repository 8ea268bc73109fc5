// SPDX-License-Identifier: MIT
#include "engine/scene/line_set.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace geotherm::engine {
namespace {

/// The shortest piece of a line, in a scene of radius 1: a few roundings of single precision. The
/// direction of a shorter one is only noise.
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
  float length = 0;
  for (std::size_t i = 0; i + 1 < count; ++i) {
    const glm::vec3& at_begin = closed ? chain[count - 2] : chain[0];
    const glm::vec3& at_end = closed ? chain[1] : chain[count - 1];
    pieces.push_back({i > 0 ? chain[i - 1] : at_begin, chain[i], chain[i + 1],
                      i + 2 < count ? chain[i + 2] : at_end, length});
    length += glm::length(chain[i + 1] - chain[i]);
  }
  return pieces;
}

namespace {

/// How far, in pixels, a line may leave its points: antialiasing hides it.
constexpr float kTolerance = 0.2F;
constexpr std::size_t kLongestRun = 256;

float distance_to_segment(const glm::vec3& p, const glm::vec3& a, const glm::vec3& b) {
  const glm::vec3 way = b - a;
  const float square = glm::dot(way, way);
  const float along = square > 0 ? std::clamp(glm::dot(p - a, way) / square, 0.0F, 1.0F) : 0.0F;
  return glm::length(p - a - along * way);
}

/// Marks what is needed between two points that are kept.
void mark_needed(std::span<const glm::vec3> points, std::size_t first, std::size_t last,
                 float tolerance, std::vector<char>& needed) {
  std::vector<std::pair<std::size_t, std::size_t>> open = {{first, last}};
  while (!open.empty()) {
    const auto [from, to] = open.back();
    open.pop_back();
    float farthest = tolerance;
    std::size_t at = from;
    for (std::size_t i = from + 1; i < to; ++i) {
      const float away = distance_to_segment(points[i], points[from], points[to]);
      if (away <= farthest) continue;
      farthest = away;
      at = i;
    }
    if (at == from) continue;
    needed[at] = 1;
    open.emplace_back(from, at);
    open.emplace_back(at, to);
  }
}

}  // namespace

std::vector<glm::vec3> simplified(std::span<const glm::vec3> points, float tolerance) {
  std::vector<char> needed(points.size(), 0);
  for (std::size_t from = 0; from < points.size(); from += kLongestRun) {
    const std::size_t to = std::min(from + kLongestRun, points.size() - 1);
    needed[from] = needed[to] = 1;
    mark_needed(points, from, to, tolerance, needed);
  }
  std::vector<glm::vec3> kept;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (needed[i] != 0) kept.push_back(points[i]);
  }
  return kept;
}

void LineSet::set(std::span<const Polyline> lines) {
  std::vector<Line> made;
  for (const Polyline& line : lines) made.push_back({finite_runs(line.points), line.colour});
  lines_ = std::move(made);
  level_.reset();
}

bool LineSet::fit(const Camera& camera) {
  const glm::mat4 clip = camera.projection * camera.view;
  constexpr float kAtTheEye = 1e-4F;  // what is nearer is not drawn
  float nearest = std::numeric_limits<float>::max();
  for (const Line& line : lines_) {
    for (const auto& run : line.runs) {
      for (const glm::vec3& p : run) {
        const float w = clip[0].w * p.x + clip[1].w * p.y + clip[2].w * p.z + clip[3].w;
        nearest = std::min(nearest, std::max(w, kAtTheEye));
      }
    }
  }
  if (lines_.empty()) nearest = 1;
  const float smallest_pixel = nearest / std::max(camera.pixels_per_unit, 1.0F);  // scene units
  const float tolerance = kTolerance * smallest_pixel;
  const int level = static_cast<int>(std::floor(std::log2(std::max(tolerance, 1e-12F))));
  if (level_ == level) return false;
  std::vector<LinePiece> pieces;
  std::vector<Range> ranges;
  for (const Line& line : lines_) {
    const auto first = static_cast<std::uint32_t>(pieces.size());
    for (const auto& run : line.runs) {
      const std::vector<LinePiece> own = line_pieces(simplified(run, std::ldexp(1.0F, level)));
      pieces.insert(pieces.end(), own.begin(), own.end());
    }
    const auto count = static_cast<std::uint32_t>(pieces.size()) - first;
    if (count > 0) ranges.push_back({first, count, line.colour});
  }
  pieces_ = std::move(pieces);
  ranges_ = std::move(ranges);
  level_ = level;
  return true;
}

}  // namespace geotherm::engine
