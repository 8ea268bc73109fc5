// SPDX-License-Identifier: MIT
#include "app/drawing/scene_mesh.h"

#include <algorithm>
#include <numeric>

#include "app/drawing/picture_scene.h"
#include "engine/scene/draw_mesh.h"

namespace geotherm::app {

SceneMesh scene_mesh(const PictureData& data) {
  const std::vector<glm::vec3> positions = scene_vectors(data.positions);
  const std::vector<engine::Openness> openness = scene_openness(data);
  const engine::DrawMesh drawn =
      engine::build_draw_mesh({positions, data.faces, data.solid, openness});
  // What is drawn differs in its labels as well, which are the renderer's alone.
  const auto key = [&drawn](std::uint32_t i) {
    const auto& n = drawn.vertices[i].normal_and_label;
    return std::array<std::int64_t, 4>{drawn.origin[i], n[0], n[1], n[2]};
  };
  std::vector<std::uint32_t> sorted(drawn.vertices.size());
  std::iota(sorted.begin(), sorted.end(), 0U);
  std::ranges::sort(sorted, [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });

  SceneMesh mesh;
  std::vector<std::uint32_t> number(sorted.size());
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    if (i == 0 || key(sorted[i]) != key(sorted[i - 1])) {
      const auto& vertex = drawn.vertices[sorted[i]];
      const auto& n = vertex.normal_and_label;
      const glm::vec3 normal(n[0], n[1], n[2]);
      const float size = glm::length(normal);
      mesh.positions.push_back(vertex.position);
      mesh.normals.push_back(size > 0 ? normal / size : glm::vec3(0, 0, 1));
      mesh.origin.push_back(drawn.origin[sorted[i]]);
      mesh.openness.insert(mesh.openness.end(), {vertex.openness[0], vertex.openness[1]});
    }
    number[sorted[i]] = static_cast<std::uint32_t>(mesh.origin.size() - 1);
  }
  mesh.faces = drawn.faces;
  for (auto& face : mesh.faces) {
    for (std::uint32_t& corner : face) corner = number[corner];
  }
  return mesh;
}

SceneMesh separate_corners(const SceneMesh& mesh) {
  SceneMesh out;
  for (const auto& face : mesh.faces) {
    const auto first = static_cast<std::uint32_t>(out.origin.size());
    out.faces.push_back({first, first + 1, first + 2});
    for (const std::uint32_t v : face) {
      out.positions.push_back(mesh.positions[v]);
      out.normals.push_back(mesh.normals[v]);
      out.origin.push_back(mesh.origin[v]);
    }
  }
  return out;
}

}  // namespace geotherm::app
