// SPDX-License-Identifier: MIT
#include "engine/scene/coarse_surface.h"

#include <algorithm>
#include <cmath>

namespace geotherm::engine {
namespace {

/// A plane passes through 1.5 cells for each of its squares of their side, on average over all
/// directions; each becomes a vertex, of two faces.
constexpr double kFacesPerCell = 3;
constexpr float kMaxCells = 2000;  ///< along an axis, so that three numbers fit one key

/// The side of cells of which a surface of this area passes through as many as faces need.
float cell_side(const SurfaceGeometry& geometry, std::size_t wanted) {
  double area = 0;
  for (const auto& [a, b, c] : geometry.faces) {
    const auto& p = geometry.positions;
    area += 0.5 * glm::length(glm::cross(p[b] - p[a], p[c] - p[a]));
  }
  const double side = std::sqrt(kFacesPerCell * area / static_cast<double>(wanted));
  return std::max(static_cast<float>(side), 2 / kMaxCells);
}

std::uint64_t cell_of(const glm::vec3& p, float side) {
  std::uint64_t key = 0;
  for (int k = 0; k < 3; ++k) {
    const float x = std::clamp((p[k] + 1) / side, 0.0F, kMaxCells);
    key = (key << 21U) | static_cast<std::uint64_t>(x);
  }
  return key;
}

/// Joins the vertices of each cell.
void join_vertices(const SurfaceGeometry& geometry, float side, CoarseSurface& coarse) {
  const std::size_t count = geometry.positions.size();
  std::vector<std::pair<std::uint64_t, std::uint32_t>> cells(count);
  for (std::uint32_t v = 0; v < count; ++v) cells[v] = {cell_of(geometry.positions[v], side), v};
  std::sort(cells.begin(), cells.end());
  coarse.of_vertex.resize(count);
  for (std::size_t begin = 0, end = 0; begin < count; begin = end) {
    glm::vec3 sum(0);
    for (end = begin; end < count && cells[end].first == cells[begin].first; ++end) {
      sum += geometry.positions[cells[end].second];
      coarse.of_vertex[cells[end].second] = static_cast<std::uint32_t>(coarse.positions.size());
    }
    const std::uint32_t example = cells[begin + (end - begin) / 2].second;
    coarse.positions.push_back(sum / static_cast<float>(end - begin));
    coarse.example.push_back(example);
    if (!geometry.openness.empty()) coarse.openness.push_back(geometry.openness[example]);
  }
}

/// Keeps the faces whose corners stay apart, each of them once.
void keep_faces(const SurfaceGeometry& geometry, CoarseSurface& coarse) {
  struct Kept {
    std::array<std::uint32_t, 3> sorted;
    std::uint32_t face;
  };
  std::vector<Kept> kept;
  for (std::uint32_t f = 0; f < geometry.faces.size(); ++f) {
    std::array<std::uint32_t, 3> corners = geometry.faces[f];
    for (std::uint32_t& v : corners) v = coarse.of_vertex[v];
    std::sort(corners.begin(), corners.end());
    if (corners[0] != corners[1] && corners[1] != corners[2]) kept.push_back({corners, f});
  }
  std::stable_sort(kept.begin(), kept.end(),
                   [](const Kept& a, const Kept& b) { return a.sorted < b.sorted; });
  const auto last = std::unique(kept.begin(), kept.end(),
                                [](const Kept& a, const Kept& b) { return a.sorted == b.sorted; });
  for (auto k = kept.begin(); k != last; ++k) {
    std::array<std::uint32_t, 3> corners = geometry.faces[k->face];
    for (std::uint32_t& v : corners) v = coarse.of_vertex[v];
    coarse.faces.push_back(corners);
    coarse.origin.push_back(k->face);
  }
}

}  // namespace

std::vector<float> CoarseSurface::means(std::span<const float> values) const {
  std::vector<float> out(positions.size(), 0);
  std::vector<std::uint32_t> counts(positions.size(), 0);
  for (std::size_t v = 0; v < values.size(); ++v) {
    if (values[v] == kNoValue) continue;
    out[of_vertex[v]] += values[v];
    ++counts[of_vertex[v]];
  }
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i] = counts[i] == 0 ? kNoValue : out[i] / static_cast<float>(counts[i]);
  }
  return out;
}

CoarseSurface coarse_surface(const SurfaceGeometry& geometry, std::size_t wanted) {
  CoarseSurface coarse;
  join_vertices(geometry, cell_side(geometry, wanted), coarse);
  keep_faces(geometry, coarse);
  return coarse;
}

}  // namespace geotherm::engine
