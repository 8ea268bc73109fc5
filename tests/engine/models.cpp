// SPDX-License-Identifier: MIT
#include "tests/engine/models.h"

#include <algorithm>

namespace geotherm::test {

std::vector<float> Model::values(const std::function<float(const glm::vec3&)>& of) const {
  std::vector<float> all;
  std::transform(positions.begin(), positions.end(), std::back_inserter(all), of);
  return all;
}

Model model_of(const Draft& draft) {
  Model model;
  for (const Vec3& p : draft.positions) model.positions.emplace_back(p.x(), p.y(), p.z());
  for (const auto& [a, b, c] : draft.faces) {
    model.faces.push_back({static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b),
                           static_cast<std::uint32_t>(c)});
  }
  return model;
}

Model fitted_model(std::span<const Vec3> positions, std::span<const Face> faces) {
  Vec3 low = positions[0];
  Vec3 high = low;
  for (const Vec3& p : positions) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const Vec3 centre = 0.5 * (low + high);
  double radius = 0;
  for (const Vec3& p : positions) radius = std::max(radius, (p - centre).norm());
  Draft draft;
  for (const Vec3& p : positions) draft.add((p - centre) / radius);
  draft.faces.assign(faces.begin(), faces.end());
  return model_of(draft);
}

Model plane_model(Index nx, Index ny) {
  return model_of(transformed(plane_grid(nx, ny, 1.6, 1.2), 1, {-0.8, -0.6, 0}, false));
}

Model irregular_plane_model(Index n) {
  constexpr double kShake = 0.24;  // of a cell: triangles of all shapes, none turned over
  constexpr unsigned kSeed = 7;
  Draft draft = jittered_plane(n, kShake, kSeed);
  for (Vec3& p : draft.positions) p = {1.6 * p.x() - 0.8, 1.2 * p.y() - 0.6, 0};
  return model_of(draft);
}

Model cube_model(float h) {
  Model model;
  for (int i = 0; i < 8; ++i) {
    model.positions.emplace_back((i & 1) != 0 ? h : -h, (i & 2) != 0 ? h : -h,
                                 (i & 4) != 0 ? h : -h);
  }
  // Counter-clockwise seen from outside.
  model.faces = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                 {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return model;
}

Model square_model(float h, float z) {
  return {{{-h, -h, z}, {h, -h, z}, {h, h, z}, {-h, h, z}}, {{0, 1, 2}, {0, 2, 3}}};
}

void append(Model& model, const Model& other) {
  const auto first = static_cast<std::uint32_t>(model.positions.size());
  model.positions.insert(model.positions.end(), other.positions.begin(), other.positions.end());
  for (const auto& [a, b, c] : other.faces) {
    model.faces.push_back({a + first, b + first, c + first});
  }
}

}  // namespace geotherm::test
