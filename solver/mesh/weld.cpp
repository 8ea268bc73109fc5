// SPDX-License-Identifier: MIT
#include "geotherm/mesh.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <string>
#include <utility>

#include "solver/core/number_text.h"
#include "solver/mesh/merge_close.h"
#include "solver/mesh/repeats_corner.h"

namespace geotherm {
namespace {

/// Ascending.
std::vector<Index> vertices_in_use(const TriangleMesh& mesh) {
  std::vector<char> used(static_cast<std::size_t>(mesh.vertex_count()), 0);
  for (const Face& face : mesh.faces()) {
    if (repeats_corner(face)) continue;
    for (const Index corner : face) used[corner] = 1;
  }
  std::vector<Index> vertices;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (used[v]) vertices.push_back(v);
  }
  return vertices;
}

}  // namespace

Result<WeldedMesh> weld(const TriangleMesh& mesh, double distance) try {
  if (!(distance >= 0) || !std::isfinite(distance)) {
    return Error{ErrorCode::kBadInput,
                 "vertices cannot be merged over a distance of " + number_text(distance),
                 {"give a length in model units, or 0 for those that are equal"}};
  }
  const std::vector<Index> used = vertices_in_use(mesh);
  std::vector<Vec3> points;
  points.reserve(used.size());
  for (const Index v : used) points.push_back(mesh.positions()[v]);
  const std::vector<Index> lowest = merge_close(points, distance);

  std::vector<Index> same_as(static_cast<std::size_t>(mesh.vertex_count()));
  for (Index v = 0; v < mesh.vertex_count(); ++v) same_as[v] = mesh.standing_for(v);
  Index merged = 0;
  for (std::size_t i = 0; i < used.size(); ++i) {
    same_as[used[i]] = used[lowest[i]];
    merged += used[lowest[i]] != used[i];
  }
  // What stood for others before may have become one with a lower vertex.
  for (Index& low : same_as) low = same_as[low];
  auto welded = TriangleMesh::build({mesh.positions().begin(), mesh.positions().end()},
                                    {mesh.faces().begin(), mesh.faces().end()}, std::move(same_as));
  if (!welded) return welded.error();
  if (!used.empty() && std::ranges::all_of(welded->faces(), repeats_corner)) {
    return Error{ErrorCode::kBadInput,
                 "every face collapses when vertices within " + number_text(distance) +
                     " of each other are merged (" + std::to_string(used.size()) +
                     " vertices become " +
                     std::to_string(used.size() - static_cast<std::size_t>(merged)) + ")",
                 {"give less than the length of an edge"}};
  }
  return WeldedMesh{*std::move(welded), merged};
} catch (const std::bad_alloc&) {
  return Error{
      ErrorCode::kOutOfMemory,
      "the memory ended while the " + std::to_string(mesh.vertex_count()) + " vertices were merged",
      {"take a mesh with fewer faces"}};
}

}  // namespace geotherm
