// SPDX-License-Identifier: MIT
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "geotherm/mesh_report.h"
#include "solver/core/parallel.h"
#include "solver/core/sorting.h"
#include "solver/geometry/clean_faces.h"
#include "solver/geometry/delaunay.h"
#include "solver/geometry/intrinsic_mesh.h"
#include "solver/geometry/intrinsic_surface.h"
#include "solver/geometry/tufted_cover.h"

namespace geotherm {

/// summarize_mesh() where the mesh's clean faces are known.
MeshSummary summarize_clean_faces(const TriangleMesh& mesh, const CleanFaces& clean, int threads);

namespace {

/// Height over longest side below which a face has no usable area.
inline constexpr double kFlatFace = 1e-10;

/// A triangle by its sides over the longest of them, which is 0 where all corners are one point.
struct Shape {
  std::array<Vec3, 3> side;  ///< from corner k to the next
  double longest = 0;        ///< model units
  double squares = 0;        ///< sum of the squared sides
  double doubled = 0;        ///< area times two

  explicit Shape(const std::array<Vec3, 3>& corners) {
    for (int k = 0; k < 3; ++k) {
      side[k] = corners[next_corner(k)] - corners[k];
      longest = std::max(longest, safe_norm(side[k]));
    }
    if (!(longest > 0)) return;
    for (Vec3& s : side) squares += (s /= longest).squaredNorm();
    doubled = side[0].cross(side[1]).norm();
  }

  double area() const { return 0.5 * doubled * longest * longest; }  ///< model units squared
  bool is_flat() const { return doubled < kFlatFace; }
  double quality() const { return 2 * std::numbers::sqrt3 * doubled / squares; }
};

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
    sum.flat += doubled < kFlatFace * square;
    return;
  }
  const Shape shape(corners);
  sum.area += shape.area();
  sum.flat += shape.is_flat();
}

/// Sums the area and counts faces without one.
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

/// Counts the different roots of the vertices that `marked` holds.
Index count_sets(DisjointSets& sets, const std::vector<char>& marked) {
  Index count = 0;
  for (std::size_t v = 0; v < marked.size(); ++v) {
    count += marked[v] && sets.root(static_cast<Index>(v)) == static_cast<Index>(v);
  }
  return count;
}

/// Fills in what follows from the edges.
void inspect_connections(const TriangleMesh& mesh, const CleanFaces& clean, MeshReport& report) {
  const auto n = static_cast<std::size_t>(mesh.vertex_count());
  const std::vector<char> used = vertices_in_faces(mesh.vertex_count(), clean.faces);
  std::vector<char> on_boundary(n, 0);
  DisjointSets boundaries(n), patches(clean.faces.size());
  const EdgeTable& edges = clean.edges;
  for (Index e = 0; e < edges.edge_count(); ++e) {
    const auto sides = edges.sides(e);
    for (const Side side : sides) patches.join(face_of(sides[0]), face_of(side));
    if (sides.size() == 2) report.orientable &= sides_agree(clean.faces, sides[0], sides[1]);
    if (sides.size() != 1) continue;
    boundaries.join(edges.low(e), edges.high(e));
    on_boundary[edges.low(e)] = on_boundary[edges.high(e)] = 1;
  }
  const auto in_use = static_cast<Index>(std::count(used.begin(), used.end(), 1));
  report.edges = edges.edge_count();
  report.edge_components = count_sets(patches, std::vector<char>(clean.faces.size(), 1));
  report.boundary_loops = count_sets(boundaries, on_boundary);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    report.merged_vertices += mesh.standing_for(v) != v;
  }
  report.euler_characteristic =
      std::int64_t{in_use} - edges.edge_count() + static_cast<std::int64_t>(clean.faces.size());
}

/// Vertices at which the corners of the faces, joined across shared edges, are not one set.
Index count_split_vertices(const TriangleMesh& mesh, const CleanFaces& clean) {
  DisjointSets corners(3 * clean.faces.size());
  const auto corner_at = [&clean](Side side, Index vertex) {
    const bool first = clean.faces[face_of(side)][corner_of(side)] == vertex;
    return first ? side : 3 * face_of(side) + next_corner(corner_of(side));
  };
  for (Index e = 0; e < clean.edges.edge_count(); ++e) {
    const auto sides = clean.edges.sides(e);
    for (std::size_t i = 1; i < sides.size(); ++i) {
      for (const Index end : {clean.edges.low(e), clean.edges.high(e)}) {
        corners.join(corner_at(sides[0], end), corner_at(sides[i], end));
      }
    }
  }
  std::vector<Index> fans(static_cast<std::size_t>(mesh.vertex_count()), 0);
  for (Side c = 0; c < static_cast<Side>(3 * clean.faces.size()); ++c) {
    if (corners.root(c) == c) ++fans[clean.faces[face_of(c)][corner_of(c)]];
  }
  return static_cast<Index>(std::count_if(fans.begin(), fans.end(), [](Index n) { return n > 1; }));
}

Index count_duplicate_positions(const TriangleMesh& mesh) {
  const std::span<const Vec3> positions = mesh.positions();
  std::vector<Index> order;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.standing_for(v) == v) order.push_back(v);
  }
  const auto coordinates = [&](Index v) {
    return std::array{positions[v][0], positions[v][1], positions[v][2]};
  };
  std::sort(order.begin(), order.end(),
            [&](Index a, Index b) { return coordinates(a) < coordinates(b); });
  Index count = 0;
  for (std::size_t i = 1; i < order.size(); ++i) {
    count += positions[order[i]] == positions[order[i - 1]];
  }
  return count;
}

/// Extent, qualities and angles.
void inspect_shapes(const TriangleMesh& mesh, const CleanFaces& clean, MeshReport& report) {
  double quality = 0, least_tangent = std::numeric_limits<double>::infinity();
  report.box_min.setConstant(std::numeric_limits<double>::infinity());
  report.box_max = -report.box_min;
  for (const Face& face : clean.faces) {
    const std::array<Vec3, 3> corners = {mesh.positions()[face[0]], mesh.positions()[face[1]],
                                         mesh.positions()[face[2]]};
    for (const Vec3& corner : corners) {
      report.box_min = report.box_min.cwiseMin(corner);
      report.box_max = report.box_max.cwiseMax(corner);
    }
    const Shape shape(corners);
    if (!(shape.longest > 0)) {
      least_tangent = 0;
      continue;
    }
    quality += shape.quality();
    const auto dot = [&shape](int k) { return -shape.side[k].dot(shape.side[previous_corner(k)]); };
    // The tangent of a corner's angle is `doubled` over its dot product: the smallest angle, which
    // is acute, has the largest.
    least_tangent = std::min(least_tangent, shape.doubled / std::max({dot(0), dot(1), dot(2)}));
  }
  report.smallest_angle = std::atan(least_tangent) * 180 / std::numbers::pi;
  report.mean_quality = quality / static_cast<double>(clean.faces.size());
}

/// Components that hold a face with a flag; `flags` is empty or one per face.
Index count_flagged(const CleanFaces& clean, Index vertex_count, const std::vector<char>& flags) {
  if (flags.empty()) return 0;
  const FaceComponents components = face_components(clean.faces, vertex_count);
  std::vector<char> flagged(static_cast<std::size_t>(components.count), 0);
  for (std::size_t f = 0; f < flags.size(); ++f) flagged[components.of[f]] |= flags[f];
  return static_cast<Index>(std::count(flagged.begin(), flagged.end(), 1));
}

void inspect_edges(std::span<const Vec3> positions, const CleanFaces& clean, MeshReport& report) {
  report.shortest_edge = std::numeric_limits<double>::infinity();
  for (Index e = 0; e < clean.edges.edge_count(); ++e) {
    const double length = safe_norm(positions[clean.edges.low(e)] - positions[clean.edges.high(e)]);
    report.shortest_edge = std::min(report.shortest_edge, length);
    report.longest_edge = std::max(report.longest_edge, length);
  }
  if (!(report.mean_edge_length > 0)) return;
  const IntrinsicMesh intrinsic =
      build_intrinsic_mesh(positions, clean, report.mean_edge_length, 1, Strictness::kHeights);
  report.non_delaunay_edges = count_non_delaunay(intrinsic);
  report.mollified = intrinsic.mollified;
  report.mollified.most *= intrinsic.unit;
  const auto vertices = static_cast<Index>(positions.size());
  report.tufted_components = count_flagged(clean, vertices, faces_that_need_cover(clean, vertices));
}

/// As LaplacianKind::kAuto has it. The clean faces, which are those of `mesh`, are used up.
RefinementCounts count_refinement(const TriangleMesh& mesh, CleanFaces& clean) {
  const std::shared_ptr<const TriangleMesh> view(std::shared_ptr<void>(), &mesh);  // no owner
  IntrinsicSurface known;
  known.kept = keep_faces(clean, mesh, true);
  const auto surface = build_intrinsic_surface(
      view, {FlipRule::kWhereNeeded, CoverRule::kWhereNeeded, RefineRule::kWhereNeeded}, {}, 1,
      &known);
  if (!surface) return {};
  return surface->refinement;
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

double triangle_quality(const std::array<Vec3, 3>& corners) {
  const Shape shape(corners);
  return shape.longest > 0 ? shape.quality() : 0.0;
}

MeshReport inspect_mesh(const TriangleMesh& mesh) {
  CleanFaces clean = clean_faces(mesh);
  MeshReport report;
  static_cast<MeshSummary&>(report) = summarize_clean_faces(mesh, clean, 1);
  report.repeated_corner_faces = clean.repeated_corner;
  report.one_vertex_faces = clean.one_vertex;
  report.duplicate_faces = clean.duplicate;
  report.inconsistent_faces = clean.reoriented;
  report.duplicate_positions = count_duplicate_positions(mesh);
  inspect_connections(mesh, clean, report);
  if (clean.faces.empty()) return report;
  report.nonmanifold_vertices = count_split_vertices(mesh, clean);
  inspect_shapes(mesh, clean, report);
  inspect_edges(mesh.positions(), clean, report);
  report.refinement = count_refinement(mesh, clean);
  return report;
}

}  // namespace geotherm
