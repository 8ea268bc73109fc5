// SPDX-License-Identifier: MIT
#include "engine/scene/draw_mesh.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace geotherm::engine {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

/// Every face at a vertex is compared with every other there, up to this many; beyond, all are
/// taken for one fan.
constexpr std::uint32_t kMaxCompared = 64;

/// Area vectors of all faces: normals as long as twice the area.
std::vector<glm::vec3> area_vectors(const SurfaceGeometry& geometry) {
  std::vector<glm::vec3> vectors(geometry.faces.size());
  for (std::size_t f = 0; f < vectors.size(); ++f) {
    const Triangle& t = geometry.faces[f];
    const glm::dvec3 a = geometry.positions[t[0]];
    const glm::dvec3 b = geometry.positions[t[1]];
    const glm::dvec3 c = geometry.positions[t[2]];
    // Scaled up: the squares of small areas must not vanish in single precision.
    constexpr double kScale = 1e12;
    vectors[f] = glm::vec3(glm::cross(b - a, c - a) * kScale);
  }
  return vectors;
}

glm::vec3 unit(const glm::vec3& v) {
  const float size = glm::length(v);
  return size > 0 ? v / size : glm::vec3(0);
}

/// The corners (3 f + k) at each vertex.
struct Corners {
  std::vector<std::uint32_t> first, list;

  explicit Corners(const SurfaceGeometry& geometry)
      : first(geometry.positions.size() + 1), list(3 * geometry.faces.size()) {
    for (const Triangle& t : geometry.faces) {
      for (const std::uint32_t v : t) ++first[v + 1];
    }
    for (std::size_t v = 1; v < first.size(); ++v) first[v] += first[v - 1];
    std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
    for (std::uint32_t c = 0; c < list.size(); ++c) list[next[geometry.faces[c / 3][c % 3]]++] = c;
  }
};

/// One normal a vertex may have, and its copies: vertices of the DrawMesh by label.
struct Group {
  glm::vec3 normal;
  std::array<std::uint32_t, 3> copies;
  unsigned labels = 0;  ///< bit l: there is a copy with label l
};

std::array<std::int16_t, 4> packed(const glm::vec3& n, int label) {
  const auto part = [](float x) { return static_cast<std::int16_t>(std::lround(x * 32767.0F)); };
  return {part(n.x), part(n.y), part(n.z), static_cast<std::int16_t>((label - 1) * 32767)};
}

class Builder {
 public:
  explicit Builder(const SurfaceGeometry& geometry)
      : geometry_(geometry), corner_group_(3 * geometry.faces.size()) {}

  DrawMesh build() {
    group_corners();
    mesh_.faces.resize(geometry_.faces.size());
    mesh_.vertices.reserve(groups_.size() * 3 / 2);
    mesh_.origin.reserve(groups_.size() * 3 / 2);
    for (std::uint32_t f = 0; f < geometry_.faces.size(); ++f) place(f);
    return std::move(mesh_);
  }

 private:
  void group_corners() {
    const std::vector<glm::vec3> areas = area_vectors(geometry_);
    std::vector<glm::vec3> normals(areas.size());
    std::transform(areas.begin(), areas.end(), normals.begin(), unit);
    const Corners corners(geometry_);
    const float crease = std::cos(glm::radians(kCreaseAngle));
    for (std::size_t v = 0; v < geometry_.positions.size(); ++v) {
      const std::size_t first_group = groups_.size();
      if (corners.first[v + 1] - corners.first[v] > kMaxCompared) {
        group_as_one(corners, v, areas, normals);
        continue;
      }
      for (std::uint32_t i = corners.first[v]; i < corners.first[v + 1]; ++i) {
        const std::uint32_t corner = corners.list[i];
        const glm::vec3& own = normals[corner / 3];
        glm::vec3 sum(0);
        for (std::uint32_t j = corners.first[v]; j < corners.first[v + 1]; ++j) {
          const std::uint32_t other = corners.list[j] / 3;
          const float cosine = glm::dot(own, normals[other]);
          if (std::abs(cosine) >= crease) sum += cosine < 0 ? -areas[other] : areas[other];
        }
        corner_group_[corner] = group_of(first_group, unit(sum));
      }
    }
  }

  /// One normal for all corners at a vertex, turned to each face's side.
  void group_as_one(const Corners& corners, std::size_t v, const std::vector<glm::vec3>& areas,
                    const std::vector<glm::vec3>& normals) {
    const std::size_t first_group = groups_.size();
    glm::vec3 sum(0);
    for (std::uint32_t i = corners.first[v]; i < corners.first[v + 1]; ++i) {
      const glm::vec3& area = areas[corners.list[i] / 3];
      sum += glm::dot(sum, area) < 0 ? -area : area;
    }
    const glm::vec3 mean = unit(sum);
    for (std::uint32_t i = corners.first[v]; i < corners.first[v + 1]; ++i) {
      const bool away = glm::dot(mean, normals[corners.list[i] / 3]) < 0;
      corner_group_[corners.list[i]] = group_of(first_group, away ? -mean : mean);
    }
  }

  /// The group of the present vertex with this normal (a corner without one takes the first).
  std::uint32_t group_of(std::size_t first, const glm::vec3& normal) {
    const bool none = normal == glm::vec3(0);
    for (std::size_t g = first; g < groups_.size(); ++g) {
      if (groups_[g].normal == glm::vec3(0)) groups_[g].normal = normal;
      if (none || groups_[g].normal == normal) return static_cast<std::uint32_t>(g);
    }
    groups_.push_back({normal, {}, 0});
    return static_cast<std::uint32_t>(groups_.size() - 1);
  }

  /// Labels the corners of a face in the way that needs the fewest new copies.
  void place(std::uint32_t f) {
    constexpr std::array<Triangle, 6> kOrders = {
        {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
    std::array<Group*, 3> group{};
    for (std::size_t k = 0; k < 3; ++k) group[k] = &groups_[corner_group_[3 * f + k]];
    const auto reused = [&group](const Triangle& order) {
      int count = 0;
      for (std::size_t k = 0; k < 3; ++k) count += group[k]->labels >> order[k] & 1U;
      return count;
    };
    const Triangle& order = *std::max_element(
        kOrders.begin(), kOrders.end(),
        [&](const Triangle& a, const Triangle& b) { return reused(a) < reused(b); });
    for (std::size_t k = 0; k < 3; ++k) {
      mesh_.faces[f][k] = copy(*group[k], geometry_.faces[f][k], order[k]);
    }
  }

  std::uint32_t copy(Group& group, std::uint32_t vertex, std::uint32_t label) {
    if ((group.labels >> label & 1U) == 0) {
      group.labels |= 1U << label;
      group.copies[label] = static_cast<std::uint32_t>(mesh_.vertices.size());
      mesh_.vertices.push_back(
          {geometry_.positions[vertex], packed(group.normal, static_cast<int>(label))});
      mesh_.origin.push_back(vertex);
    }
    return group.copies[label];
  }

  const SurfaceGeometry& geometry_;
  std::vector<std::uint32_t> corner_group_;
  std::vector<Group> groups_;
  DrawMesh mesh_;
};

}  // namespace

DrawMesh build_draw_mesh(const SurfaceGeometry& geometry) { return Builder(geometry).build(); }

std::vector<DrawMesh::Vertex> separate_faces(const DrawMesh& mesh) {
  std::vector<DrawMesh::Vertex> vertices;
  vertices.reserve(3 * mesh.faces.size());
  for (const Triangle& face : mesh.faces) {
    for (const std::uint32_t v : face) vertices.push_back(mesh.vertices[v]);
  }
  return vertices;
}

}  // namespace geotherm::engine
