// SPDX-License-Identifier: MIT
#include "engine/scene/draw_mesh.h"

#include <algorithm>
#include <cmath>

namespace geotherm::engine {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

/// Every face at a vertex is compared with every other there, up to this many; beyond, all are
/// taken for one fan.
constexpr std::uint32_t kMaxCompared = 64;

/// A normal as long as twice the area.
glm::vec3 area_vector(std::span<const glm::vec3> positions, const Triangle& t) {
  const glm::dvec3 a = positions[t[0]];
  const glm::dvec3 b = positions[t[1]];
  const glm::dvec3 c = positions[t[2]];
  // Scaled up: the squares of small areas must not vanish in single precision.
  constexpr double kScale = 1e12;
  return glm::vec3(glm::cross(b - a, c - a) * kScale);
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

std::array<std::int16_t, 4> packed(const glm::vec3& n, int label) {
  const auto part = [](float x) { return static_cast<std::int16_t>(std::lround(x * 32767.0F)); };
  return {part(n.x), part(n.y), part(n.z), static_cast<std::int16_t>((label - 1) * 32767)};
}

/// The normals that a vertex may have, and which of them each of its corners takes.
struct Fan {
  std::vector<glm::vec3> normals;
  std::vector<std::uint32_t> of_corner;

  /// A corner without a normal takes the first.
  void add(const glm::vec3& normal) {
    const bool none = normal == glm::vec3(0);
    std::size_t g = 0;
    for (; g < normals.size(); ++g) {
      if (normals[g] == glm::vec3(0)) normals[g] = normal;
      if (none || normals[g] == normal) break;
    }
    if (g == normals.size()) normals.push_back(normal);
    of_corner.push_back(static_cast<std::uint32_t>(g));
  }
};

}  // namespace

struct MovingDrawMesh::State {
  /// One normal of a vertex, and its copies: vertices of the DrawMesh by label.
  struct Group {
    std::array<std::uint32_t, 3> copies{};
    unsigned labels = 0;  ///< bit l: there is a copy with label l
  };

  explicit State(const SurfaceGeometry& geometry)
      : positions(geometry.positions.begin(), geometry.positions.end()),
        faces(geometry.faces.begin(), geometry.faces.end()),
        areas(faces.size()),
        normals(faces.size()),
        corners(geometry),
        first_group(positions.size() + 1),
        corner_group(3 * faces.size()) {
    for (std::uint32_t f = 0; f < faces.size(); ++f) measure(f);
    std::vector<glm::vec3> group_normals;
    for (std::size_t v = 0; v < positions.size(); ++v) {
      const auto& [own_normals, of_corner] = look_at(v);
      for (std::size_t i = 0; i < of_corner.size(); ++i) {
        corner_group[corners.list[corners.first[v] + i]] = first_group[v] + of_corner[i];
      }
      group_normals.insert(group_normals.end(), own_normals.begin(), own_normals.end());
      first_group[v + 1] = static_cast<std::uint32_t>(group_normals.size());
    }
    groups.resize(group_normals.size());
    mesh.faces.resize(faces.size());
    mesh.vertices.reserve(groups.size() * 3 / 2);
    mesh.origin.reserve(groups.size() * 3 / 2);
    for (std::uint32_t f = 0; f < faces.size(); ++f) place(f, group_normals);
    set_openness(geometry.openness);
  }

  void measure(std::uint32_t f) {
    areas[f] = area_vector(positions, faces[f]);
    normals[f] = unit(areas[f]);
  }

  const Fan& look_at(std::size_t v) {
    fan.normals.clear();
    fan.of_corner.clear();
    const std::uint32_t begin = corners.first[v], end = corners.first[v + 1];
    if (end - begin > kMaxCompared) {
      look_at_many(begin, end);
      return fan;
    }
    for (std::uint32_t i = begin; i < end; ++i) {
      const glm::vec3& own = normals[corners.list[i] / 3];
      glm::vec3 sum(0);
      for (std::uint32_t j = begin; j < end; ++j) {
        const std::uint32_t other = corners.list[j] / 3;
        const float cosine = glm::dot(own, normals[other]);
        if (std::abs(cosine) >= crease) sum += cosine < 0 ? -areas[other] : areas[other];
      }
      fan.add(unit(sum));
    }
    return fan;
  }

  /// One normal for all corners, turned to each face's side.
  void look_at_many(std::uint32_t begin, std::uint32_t end) {
    glm::vec3 sum(0);
    for (std::uint32_t i = begin; i < end; ++i) {
      const glm::vec3& area = areas[corners.list[i] / 3];
      sum += glm::dot(sum, area) < 0 ? -area : area;
    }
    const glm::vec3 mean = unit(sum);
    for (std::uint32_t i = begin; i < end; ++i) {
      fan.add(glm::dot(mean, normals[corners.list[i] / 3]) < 0 ? -mean : mean);
    }
  }

  /// Labels the corners of a face in the way that needs the fewest new copies.
  void place(std::uint32_t f, const std::vector<glm::vec3>& group_normals) {
    constexpr std::array<Triangle, 6> kOrders = {
        {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
    const auto reused = [&](const Triangle& order) {
      int count = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        count += groups[corner_group[3 * f + k]].labels >> order[k] & 1U;
      }
      return count;
    };
    const Triangle& order = *std::max_element(
        kOrders.begin(), kOrders.end(),
        [&](const Triangle& a, const Triangle& b) { return reused(a) < reused(b); });
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t group = corner_group[3 * f + k];
      mesh.faces[f][k] = copy(groups[group], group_normals[group], faces[f][k], order[k]);
    }
  }

  std::uint32_t copy(Group& group, const glm::vec3& normal, std::uint32_t vertex,
                     std::uint32_t label) {
    if ((group.labels >> label & 1U) == 0) {
      group.labels |= 1U << label;
      group.copies[label] = static_cast<std::uint32_t>(mesh.vertices.size());
      mesh.vertices.push_back({positions[vertex], packed(normal, static_cast<int>(label))});
      mesh.origin.push_back(vertex);
    }
    return group.copies[label];
  }

  /// Gives every copy what its vertex has, the sides by its own normal.
  void set_openness(std::span<const Openness> openness) {
    if (openness.empty()) return;
    const auto byte = [](float x) {
      return static_cast<std::uint8_t>(std::lround(255 * std::clamp(x, 0.0F, 1.0F)));
    };
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
      DrawMesh::Vertex& drawn = mesh.vertices[i];
      const Openness& own = openness[mesh.origin[i]];
      const auto& [x, y, z, label] = drawn.normal_and_label;
      const bool same = glm::dot(own.normal, glm::vec3(x, y, z)) >= 0;
      drawn.openness[0] = byte(same ? own.front : own.back);
      drawn.openness[1] = byte(same ? own.back : own.front);
    }
  }

  /// Normals and places of the copies of a vertex. False: its corners share other normals now.
  bool renew(std::size_t v) {
    const Fan& now = look_at(v);
    if (now.normals.size() != first_group[v + 1] - first_group[v]) return false;
    for (std::size_t i = 0; i < now.of_corner.size(); ++i) {
      const std::uint32_t corner = corners.list[corners.first[v] + i];
      if (corner_group[corner] != first_group[v] + now.of_corner[i]) return false;
    }
    for (std::size_t g = 0; g < now.normals.size(); ++g) {
      const Group& group = groups[first_group[v] + g];
      for (std::uint32_t label = 0; label < 3; ++label) {
        if ((group.labels >> label & 1U) == 0) continue;
        mesh.vertices[group.copies[label]] = {positions[v],
                                              packed(now.normals[g], static_cast<int>(label)),
                                              mesh.vertices[group.copies[label]].openness};
      }
    }
    return true;
  }

  std::vector<glm::vec3> positions;
  std::vector<Triangle> faces;
  std::vector<glm::vec3> areas, normals;  ///< of faces
  Corners corners;
  std::vector<std::uint32_t> first_group;   ///< of each vertex
  std::vector<std::uint32_t> corner_group;  ///< by 3 f + k
  std::vector<Group> groups;
  DrawMesh mesh;
  Fan fan;  ///< of the vertex that is looked at
  float crease = std::cos(glm::radians(kCreaseAngle));
};

MovingDrawMesh::MovingDrawMesh(const SurfaceGeometry& geometry)
    : state_(std::make_unique<State>(geometry)) {}
MovingDrawMesh::MovingDrawMesh(MovingDrawMesh&&) noexcept = default;
MovingDrawMesh& MovingDrawMesh::operator=(MovingDrawMesh&&) noexcept = default;
MovingDrawMesh::~MovingDrawMesh() = default;

const DrawMesh& MovingDrawMesh::mesh() const { return state_->mesh; }

bool MovingDrawMesh::move(std::span<const glm::vec3> positions,
                          std::span<const Openness> openness) {
  State& s = *state_;
  std::vector<char> turned(s.faces.size()), near(s.positions.size());
  for (std::size_t v = 0; v < positions.size(); ++v) {
    if (s.positions[v] == positions[v]) continue;
    s.positions[v] = positions[v];
    for (std::uint32_t i = s.corners.first[v]; i < s.corners.first[v + 1]; ++i) {
      turned[s.corners.list[i] / 3] = 1;
    }
  }
  for (std::uint32_t f = 0; f < turned.size(); ++f) {
    if (turned[f] == 0) continue;
    s.measure(f);
    for (const std::uint32_t v : s.faces[f]) near[v] = 1;
  }
  for (std::size_t v = 0; v < near.size(); ++v) {
    if (near[v] != 0 && !s.renew(v)) {
      *this = MovingDrawMesh({s.positions, s.faces, false, openness});
      return false;
    }
  }
  s.set_openness(openness);
  return true;
}

DrawMesh build_draw_mesh(const SurfaceGeometry& geometry) {
  return std::move(MovingDrawMesh::State(geometry).mesh);
}

std::vector<DrawMesh::Vertex> separate_faces(const DrawMesh& mesh) {
  std::vector<DrawMesh::Vertex> vertices;
  vertices.reserve(3 * mesh.faces.size());
  for (const Triangle& face : mesh.faces) {
    for (const std::uint32_t v : face) vertices.push_back(mesh.vertices[v]);
  }
  return vertices;
}

}  // namespace geotherm::engine
