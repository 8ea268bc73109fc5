// SPDX-License-Identifier: MIT
#include "geotherm/mesh.h"

#include <cmath>

namespace geotherm {

Result<TriangleMesh> TriangleMesh::build(std::vector<Vec3> positions, std::vector<Face> faces) {
  constexpr std::size_t kMax = static_cast<std::size_t>(std::numeric_limits<Index>::max()) / 3;
  if (faces.empty()) {
    return Error{ErrorCode::kBadInput,
                 "the mesh has no faces (" + std::to_string(positions.size()) + " vertices)",
                 {"distances need a surface of triangles"}};
  }
  if (positions.size() > kMax || faces.size() > kMax) {
    return Error{ErrorCode::kBadInput,
                 "the mesh has " + std::to_string(positions.size()) + " vertices and " +
                     std::to_string(faces.size()) + " faces",
                 {"at most " + std::to_string(kMax) + " of each are supported"}};
  }
  const auto vertex_count = static_cast<Index>(positions.size());
  for (std::size_t v = 0; v < positions.size(); ++v) {
    if (!positions[v].allFinite()) {
      return Error{ErrorCode::kBadInput,
                   "vertex " + std::to_string(v) + " has a coordinate that is not finite"};
    }
  }
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (const Index corner : faces[f]) {
      if (corner < 0 || corner >= vertex_count) {
        return Error{ErrorCode::kBadInput, "face " + std::to_string(f) + " uses vertex " +
                                               std::to_string(corner) + ", but there are " +
                                               std::to_string(vertex_count) + " vertices"};
      }
    }
  }
  return TriangleMesh(std::move(positions), std::move(faces));
}

Result<TriangleMesh> TriangleMesh::build(std::vector<Vec3> positions, std::vector<Face> faces,
                                         std::vector<Index> same_as) {
  auto mesh = build(std::move(positions), std::move(faces));
  if (!mesh) return mesh;
  const std::size_t count = same_as.size();
  for (std::size_t v = 0; v < count; ++v) {
    const Index low = same_as[v];
    const bool valid = low >= 0 && static_cast<std::size_t>(low) <= v && same_as[low] == low;
    if (valid && count == mesh->positions_.size()) continue;
    return Error{ErrorCode::kBadInput,
                 "vertex " + std::to_string(v) + " of " + std::to_string(mesh->vertex_count()) +
                     " cannot be the same as " + std::to_string(low) + " in a table of " +
                     std::to_string(count),
                 {"name the lowest vertex that each is one with"}};
  }
  if (same_as.empty()) return mesh;
  for (Face& face : mesh->faces_) {
    for (Index& corner : face) corner = same_as[corner];
  }
  mesh->same_as_ = std::move(same_as);
  return mesh;
}

}  // namespace geotherm
