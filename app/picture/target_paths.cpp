// SPDX-License-Identifier: MIT
#include "app/picture/target_paths.h"

#include <algorithm>
#include <cmath>
#include <ranges>
#include <utility>

namespace geotherm::app {
namespace {

/// The distance at a point of a face, from straight lines to its corners: too long rather than
/// too short, which is enough to tell sources apart.
double distance_at(const TriangleMesh& mesh, std::span<const double> distances,
                   const SurfacePoint& point) {
  if (point.is_vertex()) return distances[point.vertex];
  const Vec3 at = position_at(mesh, point);
  double least = kUnreached;
  for (const Index corner : mesh.faces()[point.face]) {
    least = std::min(least, distances[corner] + (mesh.positions()[corner] - at).norm());
  }
  return least;
}

/// The nearest point of an edge whose ends have these distances, as a share of its length, and its
/// distance: the source of a circular wave unfolded into a plane with the edge.
std::pair<double, double> nearest_on_edge(double at_low, double at_high, double length) {
  if (!(length > 0) || !std::isfinite(at_low + at_high)) {
    return {at_low <= at_high ? 0.0 : 1.0, std::min(at_low, at_high)};
  }
  const double along = (at_low * at_low - at_high * at_high + length * length) / (2 * length);
  const double foot = std::clamp(along, 0.0, length);
  const double height2 = std::max(0.0, at_low * at_low - along * along);
  return {foot / length, std::hypot(std::sqrt(height2), foot - along)};
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
                                  std::span<const double> distances) {
  double least = kUnreached;
  SurfacePoint nearest;
  for (std::size_t i = 0; i < sources.points.size(); ++i) {
    const double offset = sources.offsets.empty() ? 0 : sources.offsets[i];
    const double distance = distance_at(mesh, distances, sources.points[i]) + offset;
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
                                           const Progress& progress) const {
  SourceSet from_target;
  from_target.points = {target};
  const auto distances = near_exact_->solve(from_target, {.quality = false}, progress);
  if (!distances) return distances.error();
  const SurfacePoint source = nearest_source_point(*mesh_, sources, distances->distances);
  if (!source.is_vertex() && source.face == kNoIndex) {
    return Error{ErrorCode::kBadInput,
                 "no source can be reached from the target: they lie in different components"};
  }
  TargetPaths found;
  const SurfacePoint ends[] = {source, target};
  for (const PathField field : {PathField::kGeodesic, PathField::kDistance, PathField::kHeat}) {
    if (field == PathField::kHeat && !heat_) continue;
    const PathFinder& finder = field == PathField::kGeodesic ? geodesics_ : streamlines_;
    auto path = finder.find(ends, {.field = field}, progress);
    if (!path) return path.error();
    found.paths.push_back({field, std::move(path->path)});
    found.warnings.insert(found.warnings.end(), path->warnings.begin(), path->warnings.end());
  }
  return found;
}

void add_paths(PictureData& data, const TriangleMesh& mesh, std::span<const TargetPath> paths) {
  // What comes last lies on top, where paths run together: the geodesic, which is the first.
  for (const TargetPath& path : std::views::reverse(paths)) {
    add_line(data, positions_of(mesh, path.path), to_text(path.field));
  }
}

}  // namespace geotherm::app
