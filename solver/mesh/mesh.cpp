// SPDX-License-Identifier: MIT
#include "geotherm/mesh.h"

#include <algorithm>
#include <limits>
#include <unordered_map>

#include "geotherm/sources.h"
#include "solver/core/sorting.h"
#include "solver/core/text.h"

namespace geotherm {

namespace {

Result<void> check_finite(std::span<const Vec3> positions) {
  for (std::size_t v = 0; v < positions.size(); ++v) {
    if (!positions[v].allFinite()) {
      return Error{ErrorCode::kBadInput,
                   "vertex " + std::to_string(v) + " has a coordinate that is not finite"};
    }
  }
  return {};
}

}  // namespace

Result<TriangleMesh> TriangleMesh::build(std::vector<Vec3> positions, std::vector<Face> faces) {
  constexpr std::size_t kMax = static_cast<std::size_t>(std::numeric_limits<Index>::max()) / 3;
  if (faces.empty()) {
    return Error{
        ErrorCode::kBadInput,
        "the mesh has no faces (" + counted_text(positions.size(), "vertex", "vertices") + ")",
        {"distances need a surface of triangles"}};
  }
  if (positions.size() > kMax || faces.size() > kMax) {
    return Error{ErrorCode::kBadInput,
                 "the mesh has " + std::to_string(positions.size()) + " vertices and " +
                     std::to_string(faces.size()) + " faces",
                 {"at most " + std::to_string(kMax) + " of each are supported"}};
  }
  const auto vertex_count = static_cast<Index>(positions.size());
  if (auto finite = check_finite(positions); !finite) return finite.error();
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
  std::vector<Face> joined(mesh->faces().begin(), mesh->faces().end());
  for (Face& face : joined) {
    for (Index& corner : face) corner = same_as[corner];
  }
  mesh->faces_ = std::make_shared<const std::vector<Face>>(std::move(joined));
  mesh->same_as_ = std::move(same_as);
  return mesh;
}

Result<TriangleMesh> TriangleMesh::moved(std::vector<Vec3> positions) const {
  if (positions.size() != positions_.size()) {
    return Error{ErrorCode::kBadInput,
                 "there are " + std::to_string(positions.size()) + " positions for " +
                     std::to_string(positions_.size()) + " vertices",
                 {"a surface that moves keeps its vertices"}};
  }
  if (auto finite = check_finite(positions); !finite) return finite.error();
  TriangleMesh mesh({}, {});
  mesh.faces_ = faces_;
  mesh.same_as_ = same_as_;
  mesh.positions_ = std::move(positions);
  return mesh;
}

Result<TriangleMesh> masked(const TriangleMesh& mesh, const Mask& mask) {
  const auto check = [](const std::vector<char>& list, Index count,
                        const char* what) -> Result<void> {
    if (list.empty() || std::ssize(list) == count) return {};
    return Error{ErrorCode::kBadInput, "the mask has " + std::to_string(list.size()) +
                                           " numbers for " + std::to_string(count) + " " + what};
  };
  if (auto fits = check(mask.vertices, mesh.vertex_count(), "vertices"); !fits) return fits.error();
  if (auto fits = check(mask.faces, mesh.face_count(), "faces"); !fits) return fits.error();
  std::vector<Face> faces(mesh.faces().begin(), mesh.faces().end());
  Index left = 0;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const auto is_out = [&mask](Index v) {
      return !mask.vertices.empty() && mask.vertices[v] != 0;
    };
    if ((mask.faces.empty() || mask.faces[f] == 0) && std::ranges::none_of(faces[f], is_out)) {
      ++left;
    } else {
      faces[f].fill(faces[f].front());
    }
  }
  if (left == 0) {
    return Error{ErrorCode::kBadInput,
                 "the mask leaves none of " + std::to_string(mesh.face_count()) + " faces",
                 {"turn it round, or take another one"}};
  }
  const auto positions = mesh.positions();
  const auto same_as = mesh.same_as();
  return TriangleMesh::build({positions.begin(), positions.end()}, std::move(faces),
                             {same_as.begin(), same_as.end()});
}

Result<void> check_moved(const TriangleMesh& mesh, const TriangleMesh& other) {
  const auto counts = [](const TriangleMesh& m) {
    return std::to_string(m.vertex_count()) + " vertices and " + std::to_string(m.face_count()) +
           " faces";
  };
  const Hint hint = {"a surface that moves keeps its vertices and faces"};
  if (mesh.vertex_count() != other.vertex_count() || mesh.face_count() != other.face_count()) {
    return Error{ErrorCode::kBadInput, "the mesh has " + counts(other) + ", not " + counts(mesh),
                 hint};
  }
  if (!std::ranges::equal(mesh.same_as(), other.same_as())) {
    return Error{ErrorCode::kBadInput, "other vertices are one than before", hint};
  }
  if (mesh.faces().data() == other.faces().data()) return {};
  const auto [here, there] = std::ranges::mismatch(mesh.faces(), other.faces());
  if (here == mesh.faces().end()) return {};
  return Error{
      ErrorCode::kBadInput,
      "face " + std::to_string(here - mesh.faces().begin()) + " has other corners than before",
      hint};
}

SourceGroups source_groups(const SourceSet& sources) {
  const auto points = static_cast<Index>(sources.points.size());
  const auto edges = static_cast<Index>(sources.edges.size());
  DisjointSets sets(sources.points.size() + sources.edges.size());
  std::unordered_map<Index, Index> end_of;  // vertex to an edge that ends there
  for (Index e = 0; e < edges; ++e) {
    for (const Index v : sources.edges[e]) {
      const auto [at, fresh] = end_of.try_emplace(v, points + e);
      if (!fresh) sets.join(points + e, at->second);
    }
  }
  for (Index i = 0; i < points; ++i) {
    if (!sources.points[i].is_vertex()) continue;
    const auto at = end_of.find(sources.points[i].vertex);
    if (at != end_of.end()) sets.join(i, at->second);
  }
  SourceGroups groups;
  groups.of_point.resize(sources.points.size());
  std::unordered_map<Index, Index> number;
  const auto group_of = [&](Index i) {
    const auto [at, fresh] = number.try_emplace(sets.root(i), groups.count);
    groups.count += fresh;
    return at->second;
  };
  const auto is_of_edges = [&](const SurfacePoint& point) {
    return point.is_vertex() && end_of.contains(point.vertex);
  };
  for (const bool of_edges : {false, true}) {
    for (Index i = 0; i < points; ++i) {
      if (is_of_edges(sources.points[i]) == of_edges) groups.of_point[i] = group_of(i);
    }
  }
  for (Index e = 0; e < edges; ++e) {
    groups.of_edge.push_back(group_of(points + e));
  }
  std::unordered_map<Index, Index> of_curve;
  for (const FaceSegment& segment : sources.segments) {
    const auto [at, fresh] = of_curve.try_emplace(segment.curve, groups.count);
    groups.count += fresh;
    groups.of_segment.push_back(at->second);
  }
  groups.count += static_cast<Index>(sources.cell_points.size());
  return groups;
}

}  // namespace geotherm
