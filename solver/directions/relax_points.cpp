// SPDX-License-Identifier: MIT
// Lloyd's iteration on surfaces.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <new>
#include <optional>
#include <string>
#include <utility>

#include "solver/core/parallel.h"
#include "solver/core/text.h"
#include "solver/directions/directions_state.h"
#include "solver/mesh/connectivity.h"

namespace geotherm {
namespace {

constexpr int kMaxHalvings = 5;

/// How a point is to go: from its place in a direction.
struct SampleMove {
  double direction = 0, length = 0;
};

/// The faces of one cell and those beside it, as a mesh of their own.
struct CellMesh {
  std::vector<Index> vertices, faces;  ///< of the whole mesh
  std::shared_ptr<const TriangleMesh> mesh;

  std::optional<SurfacePoint> into(const SurfacePoint& point) const {
    const auto& list = point.is_vertex() ? vertices : faces;
    const Index number = point.is_vertex() ? point.vertex : point.face;
    const auto at = std::ranges::lower_bound(list, number);
    if (at == list.end() || *at != number) return {};
    const auto own = static_cast<Index>(at - list.begin());
    return point.is_vertex() ? SurfacePoint::at_vertex(own)
                             : SurfacePoint::in_face(own, point.weights);
  }
  SurfacePoint out_of(const SurfacePoint& point) const {
    return point.is_vertex() ? SurfacePoint::at_vertex(vertices[point.vertex])
                             : SurfacePoint::in_face(faces[point.face], point.weights);
  }
};

class Lloyd {
 public:
  Lloyd(const DistanceMethod& method, const TriangleMesh& mesh, int threads)
      : method_(method),
        mesh_(mesh),
        threads_(threads),
        corners_(mesh.vertex_count(), mesh.faces()),
        areas_(static_cast<std::size_t>(mesh.vertex_count()), 0.0) {
    const auto at = mesh.positions();
    for (const Face& f : mesh.faces()) {
      const double area = (at[f[1]] - at[f[0]]).cross(at[f[2]] - at[f[0]]).norm() / 2;
      for (const Index v : f) areas_[v] += area / 3;
    }
  }

  Result<RelaxedPoints> run(std::vector<SurfacePoint> points, int steps, const Progress& progress) {
    const double parts = steps + 1;
    RelaxedPoints now;
    if (auto done = assign(points, now, part_of(progress, 0, 1 / parts)); !done) {
      return done.error();
    }
    now.points = std::move(points);
    now.energies.push_back(energy_of(now));
    for (int i = 0; i < steps && !now.settled; ++i) {
      const Progress part = part_of(progress, (i + 1) / parts, (i + 1) / parts);
      if (auto done = step(now, part); !done) return done.error();
    }
    return now;
  }

 private:
  /// Which vertex is nearest to which point, and how near.
  Result<void> assign(const std::vector<SurfacePoint>& points, RelaxedPoints& out,
                      const Progress& progress) const {
    SourceSet set;
    set.points = points;
    const SourceGroups groups = source_groups(set);
    auto answer = method_.solve(set, {.quality = false, .nearest = true}, progress);
    if (!answer) return answer.error();
    out.distances = std::move(answer->distances);
    out.nearest = std::move(answer->nearest_source);
    // Where several points are in one place, the first has the cell.
    std::vector<Index> point_of(static_cast<std::size_t>(groups.count), kNoIndex);
    for (auto p = static_cast<Index>(points.size()); p-- > 0;) point_of[groups.of_point[p]] = p;
    for (Index& group : out.nearest) group = group == kNoIndex ? kNoIndex : point_of[group];
    return {};
  }

  double energy_of(const RelaxedPoints& state) const {
    return parallel_sum(threads_, mesh_.vertex_count(), [&](std::int64_t begin, std::int64_t end) {
      double sum = 0;
      for (std::int64_t v = begin; v < end; ++v) {
        const double d = state.distances[v];
        if (std::isfinite(d)) sum += areas_[v] * d * d;
      }
      return sum;
    });
  }

  /// Moves all points, by the whole of their ways or by halves of it, such that the energy falls.
  Result<void> step(RelaxedPoints& now, const Progress& progress) const {
    const std::vector<std::vector<Index>> cells = cells_of(now);
    double share = 1;
    for (int i = 0; i <= kMaxHalvings; ++i, share /= 2) {
      RelaxedPoints next;
      double farthest = 0;
      auto moved = moved_points(now, cells, share, farthest);
      if (!moved) return moved.error();
      next.points = *std::move(moved);
      if (auto done = assign(next.points, next, progress); !done) return done;
      const double energy = energy_of(next);
      if (!(energy < now.energies.back())) continue;
      next.energies = std::move(now.energies);
      next.moves = std::move(now.moves);
      next.energies.push_back(energy);
      next.moves.push_back(farthest);
      now = std::move(next);
      return {};
    }
    now.settled = true;
    return {};
  }

  std::vector<std::vector<Index>> cells_of(const RelaxedPoints& state) const {
    std::vector<std::vector<Index>> cells(state.points.size());
    for (Index v = 0; v < mesh_.vertex_count(); ++v) {
      if (state.nearest[v] != kNoIndex) cells[state.nearest[v]].push_back(v);
    }
    return cells;
  }

  Result<std::vector<SurfacePoint>> moved_points(const RelaxedPoints& now,
                                                 const std::vector<std::vector<Index>>& cells,
                                                 double share, double& farthest) const {
    std::vector<SurfacePoint> points = now.points;
    std::vector<double> lengths(points.size(), 0.0);
    std::vector<std::optional<Error>> errors(points.size());
    parallel_each(threads_, std::ssize(points), 1, [&](std::int64_t i) {
      auto moved = moved_point(points[i], cells[i], share, lengths[i]);
      if (moved) {
        points[i] = *moved;
      } else if (moved.error().code != ErrorCode::kBadInput) {
        errors[i] = moved.error();
      }
    });
    for (auto& error : errors) {
      if (error) return *std::move(error);
    }
    farthest = *std::ranges::max_element(lengths);
    return points;
  }

  /// Towards the mean of its cell. Errors: kBadInput where directions have no order.
  Result<SurfacePoint> moved_point(const SurfacePoint& point, const std::vector<Index>& cell,
                                   double share, double& length) const {
    if (cell.size() < 2) return point;
    const auto around = faces_round(point, cell);
    if (!around) return around.error();
    const auto own = around->into(point);
    if (!own) return point;
    const auto directions = Directions::build(around->mesh);
    if (!directions) return directions.error();
    const auto map = (*directions)->log_map(*own);
    if (!map) return map.error();
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    double area = 0;
    for (const Index v : cell) {
      const Index w = around->into(SurfacePoint::at_vertex(v))->vertex;
      const double d = map->distances[w], angle = map->directions[w];
      if (!std::isfinite(d)) continue;
      area += areas_[v];
      if (d > 0) sum += areas_[v] * d * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    }
    if (!(area > 0) || sum.isZero(0)) return point;
    double angle = angle_of(sum);
    if (map->frame.on_boundary && angle < 0) angle += 2 * std::numbers::pi;
    const auto line = (*directions)->trace(*own, angle, share * sum.norm() / area);
    if (!line) return line.error();
    length = line->path.length;
    return around->out_of(line->path.points.back());
  }

  /// Two rings of faces: those at vertices of the cell and of its point, and those beside them.
  Result<CellMesh> faces_round(const SurfacePoint& point, const std::vector<Index>& cell) const {
    CellMesh out;
    out.vertices = cell;
    if (point.is_vertex()) {
      out.vertices.push_back(point.vertex);
    } else {
      const Face& face = mesh_.faces()[point.face];
      out.vertices.insert(out.vertices.end(), face.begin(), face.end());
    }
    for (int ring = 0; ring < 2; ++ring) {
      out.faces.clear();
      for (const Index v : out.vertices) {
        for (const Side corner : corners_.at(v)) out.faces.push_back(face_of(corner));
      }
      sort_once(out.faces);
      for (const Index f : out.faces) {
        const Face& face = mesh_.faces()[f];
        out.vertices.insert(out.vertices.end(), face.begin(), face.end());
      }
      sort_once(out.vertices);
    }
    std::vector<Vec3> positions;
    std::vector<Face> faces;
    for (const Index v : out.vertices) positions.push_back(mesh_.positions()[v]);
    for (const Index f : out.faces) {
      Face own = mesh_.faces()[f];
      for (Index& v : own) {
        v = static_cast<Index>(std::ranges::lower_bound(out.vertices, v) - out.vertices.begin());
      }
      faces.push_back(own);
    }
    auto mesh = TriangleMesh::build(std::move(positions), std::move(faces));
    if (!mesh) return mesh.error();
    out.mesh = std::make_shared<const TriangleMesh>(*std::move(mesh));
    return out;
  }

  static void sort_once(std::vector<Index>& list) {
    std::ranges::sort(list);
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }

  const DistanceMethod& method_;
  const TriangleMesh& mesh_;
  int threads_;
  CornerTable corners_;
  std::vector<double> areas_;  ///< V: a third of that of the faces of each
};

}  // namespace

Result<RelaxedPoints> relax_points(const DistanceMethod& method,
                                   const std::shared_ptr<const TriangleMesh>& mesh,
                                   std::span<const SurfacePoint> points, int steps,
                                   const Progress& progress, int threads) try {
  if (method.heat() != nullptr) {
    return Error{ErrorCode::kNotAvailable,
                 "the heat method does not say which point is nearest",
                 {"use ", SettingHint{"method", {"wavefront", "exact"}}}};
  }
  if (points.empty() || steps < 0) {
    return Error{ErrorCode::kBadInput,
                 std::to_string(steps) + " steps of " +
                     counted_text(points.size(), "point", "points") + " were asked for",
                 {"give a point at least, and 0 steps or more"}};
  }
  std::vector<SurfacePoint> own(points.begin(), points.end());
  for (SurfacePoint& point : own) {
    const bool known = point.vertex >= 0 && point.vertex < mesh->vertex_count();
    if (known) point.vertex = mesh->standing_for(point.vertex);
  }
  return Lloyd(method, *mesh, thread_count(threads)).run(std::move(own), steps, progress);
} catch (const std::bad_alloc&) {
  return directions_out_of_memory(mesh->face_count());
}

}  // namespace geotherm
