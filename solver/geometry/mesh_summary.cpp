// SPDX-License-Identifier: MIT
#include "solver/geometry/mesh_summary.h"

#include <algorithm>
#include <array>

#include "solver/core/parallel.h"
#include "solver/core/sorting.h"
#include "solver/geometry/face_shape.h"
#include "solver/geometry/intrinsic_mesh.h"

namespace geotherm {
namespace {

void count_edges(const EdgeTable& edges, MeshSummary& summary) {
  for (Index e = 0; e < edges.edge_count(); ++e) {
    const std::size_t faces = edges.sides(e).size();
    summary.boundary_edges += faces == 1;
    summary.nonmanifold_edges += faces > 2;
  }
}

void count_vertices(const TriangleMesh& mesh, const CleanFaces& clean, MeshSummary& summary) {
  const EdgeTable& edges = clean.edges;
  DisjointSets pieces(static_cast<std::size_t>(mesh.vertex_count()));
  for (Index e = 0; e < edges.edge_count(); ++e) pieces.join(edges.low(e), edges.high(e));
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const bool used = !clean.corners.at(v).empty();
    summary.components += used && pieces.root(v) == v;
    summary.unreferenced_vertices += clean.corners.at(mesh.standing_for(v)).empty();
  }
}

struct AreaSum {
  double area = 0;
  Index flat = 0;
};

void add_face(const std::array<Vec3, 3>& corners, AreaSum& sum) {
  constexpr double kSafeLow = 1e-140, kSafeHigh = 1e140;  // whose squares are far from the ends
  const std::array<Vec3, 3> side = {corners[1] - corners[0], corners[2] - corners[1],
                                    corners[0] - corners[2]};
  const double square =
      std::max({side[0].squaredNorm(), side[1].squaredNorm(), side[2].squaredNorm()});
  if (square > kSafeLow && square < kSafeHigh) {
    const double doubled = side[0].cross(side[1]).norm();
    sum.area += 0.5 * doubled;
    sum.flat += doubled < kFlat * square;
    return;
  }
  const Shape shape(corners);
  sum.area += shape.area();
  sum.flat += shape.is_flat();
}

/// Area, and faces without one.
void measure_faces(const TriangleMesh& mesh, const CleanFaces& clean, int threads,
                   MeshSummary& summary) {
  const auto measure = [&](std::int64_t begin, std::int64_t end) {
    AreaSum sum;
    for (std::int64_t f = begin; f < end; ++f) {
      const Face& face = clean.faces[static_cast<std::size_t>(f)];
      const auto p = mesh.positions();
      add_face({p[face[0]], p[face[1]], p[face[2]]}, sum);
    }
    return sum;
  };
  const auto count = static_cast<std::int64_t>(clean.faces.size());
  summary.degenerate_faces = clean.repeated_corner;
  for (const AreaSum& sum : sums_of_blocks<AreaSum>(threads, count, measure)) {
    summary.area += sum.area;
    summary.degenerate_faces += sum.flat;
  }
}

}  // namespace

MeshSummary summarize_clean_faces(const TriangleMesh& mesh, const CleanFaces& clean, int threads) {
  MeshSummary summary;
  summary.vertices = mesh.vertex_count();
  summary.faces = mesh.face_count();
  run_both(
      threads,
      [&] {
        count_edges(clean.edges, summary);
        count_vertices(mesh, clean, summary);
      },
      [&] {
        measure_faces(mesh, clean, threads, summary);
        summary.mean_edge_length = mean_edge_length(mesh.positions(), clean.edges, threads);
      });
  return summary;
}

MeshSummary summarize_mesh(const TriangleMesh& mesh, int threads) {
  return summarize_clean_faces(mesh, clean_faces(mesh, threads), threads);
}

}  // namespace geotherm
