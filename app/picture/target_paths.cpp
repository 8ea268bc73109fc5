// SPDX-License-Identifier: MIT
#include "app/picture/target_paths.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace geotherm::app {
namespace {

/// Where a circular wave with these distances at the ends of an edge comes from: its place along
/// the edge and its height over it, unfolded into a plane with it.
std::pair<double, double> wave_centre(double at_low, double at_high, double length) {
  const double along = (at_low * at_low - at_high * at_high + length * length) / (2 * length);
  return {along, std::sqrt(std::max(0.0, at_low * at_low - along * along))};
}

/// The distance of a point of a face from the target: straight where the face holds both, else by
/// the best of the waves that come in through its sides.
double distance_at(const TriangleMesh& mesh, std::span<const double> distances,
                   const SurfacePoint& point, const SurfacePoint& target) {
  if (point.is_vertex()) return distances[point.vertex];
  const Face& face = mesh.faces()[point.face];
  const Vec3 at = position_at(mesh, point);
  double least = kUnreached;
  if (!target.is_vertex() && target.face == point.face) {
    least = (position_at(mesh, target) - at).norm();
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const Index low = face[k], high = face[(k + 1) % 3];
    const Vec3& origin = mesh.positions()[low];
    const Vec3 side = mesh.positions()[high] - origin;
    const double length = side.norm();
    least = std::min(least, distances[low] + (at - origin).norm());
    if (!(length > 0) || !std::isfinite(distances[low] + distances[high])) continue;
    // The wave's centre and the point, on either side of this one unfolded into a plane.
    const auto [along, height] = wave_centre(distances[low], distances[high], length);
    const double x = (at - origin).dot(side) / length;
    const double y = std::sqrt(std::max(0.0, (at - origin).squaredNorm() - x * x));
    const double crossing = y + height > 0 ? along + (x - along) * height / (y + height) : x;
    if (crossing >= 0 && crossing <= length) {
      least = std::min(least, std::hypot(x - along, y + height));
    }
  }
  return least;
}

/// The nearest point of an edge whose ends have these distances, as a share of its length, and its
/// distance.
std::pair<double, double> nearest_on_edge(double at_low, double at_high, double length) {
  if (!(length > 0) || !std::isfinite(at_low + at_high)) {
    return {at_low <= at_high ? 0.0 : 1.0, std::min(at_low, at_high)};
  }
  const auto [along, height] = wave_centre(at_low, at_high, length);
  const double foot = std::clamp(along, 0.0, length);
  return {foot / length, std::hypot(height, foot - along)};
}

/// The point of an edge as one of a face that has it.
SurfacePoint point_on_edge(const TriangleMesh& mesh, Index low, Index high, double share) {
  if (share <= 0) return SurfacePoint::at_vertex(low);
  if (share >= 1) return SurfacePoint::at_vertex(high);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const Face& face = mesh.faces()[f];
    const auto a = std::ranges::find(face, low);
    const auto b = std::ranges::find(face, high);
    if (a == face.end() || b == face.end()) continue;
    std::array<double, 3> weights{};
    weights[static_cast<std::size_t>(a - face.begin())] = 1 - share;
    weights[static_cast<std::size_t>(b - face.begin())] = share;
    return SurfacePoint::in_face(f, weights);
  }
  return SurfacePoint::at_vertex(share < 0.5 ? low : high);
}

}  // namespace

SurfacePoint nearest_source_point(const TriangleMesh& mesh, const SourceSet& sources,
                                  const SurfacePoint& target, std::span<const double> distances) {
  double least = kUnreached;
  SurfacePoint nearest;
  for (std::size_t i = 0; i < sources.points.size(); ++i) {
    const double offset = sources.offsets.empty() ? 0 : sources.offsets[i];
    const double distance = distance_at(mesh, distances, sources.points[i], target) + offset;
    if (distance < least) {
      least = distance;
      nearest = sources.points[i];
    }
  }
  const std::array<Index, 2>* edge = nullptr;
  double share = 0;
  for (const auto& each : sources.edges) {
    const auto& [low, high] = each;
    const double length = (mesh.positions()[low] - mesh.positions()[high]).norm();
    const auto [at, distance] = nearest_on_edge(distances[low], distances[high], length);
    if (distance >= least) continue;
    least = distance;
    share = at;
    edge = &each;
  }
  for (const FaceSegment& segment : sources.segments) {
    const SurfacePoint from = SurfacePoint::in_face(segment.face, segment.from);
    const SurfacePoint to = SurfacePoint::in_face(segment.face, segment.to);
    const double length = (position_at(mesh, from) - position_at(mesh, to)).norm();
    const auto [at, distance] = nearest_on_edge(distance_at(mesh, distances, from, target),
                                                distance_at(mesh, distances, to, target), length);
    if (distance >= least) continue;
    least = distance;
    edge = nullptr;
    nearest = from;
    for (std::size_t k = 0; k < 3; ++k) {
      nearest.weights[k] = (1 - at) * from.weights[k] + at * to.weights[k];
    }
  }
  return edge == nullptr ? nearest : point_on_edge(mesh, (*edge)[0], (*edge)[1], share);
}

TargetPathFinder::TargetPathFinder(const std::shared_ptr<const TriangleMesh>& mesh,
                                   std::shared_ptr<const DistanceMethod> near_exact,
                                   std::shared_ptr<const DistanceMethod> shown)
    : mesh_(mesh),
      near_exact_(near_exact),
      heat_(shown->heat() != nullptr),
      geodesics_(mesh, std::move(near_exact)),
      streamlines_(mesh, std::move(shown)) {}

Result<TargetPaths> TargetPathFinder::find(const SourceSet& sources, const SurfacePoint& target,
                                           PathKind kind, const Progress& progress) const {
  SourceSet from_target;
  from_target.points = {target};
  const auto distances =
      near_exact_->solve(from_target, {.quality = false}, part_of(progress, 0.0, 0.2));
  if (!distances) return distances.error();
  const SurfacePoint source = nearest_source_point(*mesh_, sources, target, distances->distances);
  if (!source.is_vertex() && source.face == kNoIndex) {
    return Error{ErrorCode::kBadInput,
                 "no source can be reached from the target: they lie in different components"};
  }
  TargetPaths found;
  const SurfacePoint ends[] = {source, target};
  for (const PathField field : {PathField::kGeodesic, PathField::kDistance, PathField::kHeat}) {
    const bool wanted = kind == PathKind::kAll || to_text(kind) == to_text(field);
    if (!wanted || (field == PathField::kHeat && !heat_)) continue;
    const PathFinder& finder = field == PathField::kGeodesic ? geodesics_ : streamlines_;
    const double begun = 0.2 + 0.25 * static_cast<double>(found.paths.size());
    auto path = finder.find(ends, {.field = field}, part_of(progress, begun, begun + 0.25));
    if (!path) return path.error();
    found.paths.push_back({field, std::move(path->path)});
    found.warnings.insert(found.warnings.end(), path->warnings.begin(), path->warnings.end());
  }
  return found;
}

void add_paths(PictureData& data, const TriangleMesh& mesh, std::span<const TargetPath> paths) {
  // What comes last lies on top, where paths run together: the geodesic, which is the first.
  for (auto path = paths.rbegin(); path != paths.rend(); ++path) {
    add_line(data, positions_of(mesh, path->path), to_text(path->field));
  }
}

}  // namespace geotherm::app
