// SPDX-License-Identifier: MIT
#include "solver/path/find_path.h"

#include <algorithm>
#include <utility>

#include "solver/core/number_text.h"
#include "solver/path/geodesic_search.h"
#include "solver/path/shorten.h"
#include "solver/path/streamline.h"
#include "solver/path/within_memory.h"

namespace geotherm {
namespace {

/// An order of points that does not depend on which of them a path comes from.
bool stands_before(const Vec3& a, const Vec3& b) {
  return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

std::string place_text(const Vec3& p) {
  return "(" + rounded_text(p.x()) + ", " + rounded_text(p.y()) + ", " + rounded_text(p.z()) + ")";
}

}  // namespace

std::vector<std::string> path_field_names() { return {"geodesic", "distance", "heat"}; }

std::string to_text(PathField field) { return path_field_names()[static_cast<std::size_t>(field)]; }

Result<PathField> parse_path_field(std::string_view text) {
  for (const PathField field : {PathField::kGeodesic, PathField::kDistance, PathField::kHeat}) {
    if (to_text(field) == text) return field;
  }
  return Error{ErrorCode::kNotAvailable,
               "there is no field '" + std::string(text) + "' to follow",
               {"there are geodesic, distance, heat"}};
}

PathFinder::PathFinder(std::shared_ptr<const TriangleMesh> mesh,
                       std::shared_ptr<const DistanceMethod> method)
    : surface_(std::make_shared<const PathSurface>(std::move(mesh))), method_(std::move(method)) {}

Result<FoundPath> PathFinder::find(std::span<const SurfacePoint> points, const PathOptions& options,
                                   const Progress& progress) const {
  return within_memory("a path", *surface_->mesh(), progress,
                       [&](const Progress& watched) { return through(points, options, watched); });
}

Result<FoundPath> PathFinder::through(std::span<const SurfacePoint> points,
                                      const PathOptions& options, const Progress& progress) const {
  if (points.size() < 2) {
    return Error{ErrorCode::kBadInput,
                 "a path needs two points; " + std::to_string(points.size()) + " were given"};
  }
  std::vector<SurfacePoint> stops(points.begin(), points.end());
  if (options.closed) stops.push_back(stops.front());
  const bool loose =
      options.closed && options.field == PathField::kGeodesic && !options.hold_points;
  const double found = loose ? 0.9 : 1.0;  // of the work, when all pieces are
  const double share = found / static_cast<double>(stops.size() - 1);
  FoundPath out;
  for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
    const auto part = static_cast<double>(i);
    auto next = piece(stops[i], stops[i + 1], options.field,
                      part_of(progress, part * share, (part + 1) * share));
    if (!next) return next.error();
    append(out.path, next->path);
    out.warnings.insert(out.warnings.end(), next->warnings.begin(), next->warnings.end());
  }
  out.path.closed = options.closed;
  if (!loose) return out;
  auto loop = shorten(*surface_, out.path, false, part_of(progress, found, 1));
  if (!loop) return loop.error();
  out.path = *std::move(loop);
  if (out.path.points.size() == 1) {
    out.warnings.emplace_back(
        "the loop can be drawn together to a point, and was; lead it round a hole or a handle "
        "with way-points, or hold it at its points");
  }
  return out;
}

Result<FoundPath> PathFinder::piece(const SurfacePoint& from, const SurfacePoint& to,
                                    PathField field, const Progress& progress) const {
  if (field != PathField::kGeodesic) return streamline(from, to, field, progress);
  const auto a = surface_->into(from), b = surface_->into(to);
  if (!a) return a.error();
  if (!b) return b.error();
  if (!stands_before(surface_->position(*b), surface_->position(*a))) {
    return geodesic(from, to, progress);
  }
  auto found = geodesic(to, from, progress);
  if (found) found->path = reversed(std::move(found->path));
  return found;
}

Result<DistanceResult> PathFinder::distances(const SurfacePoint& source, bool heat,
                                             const Progress& progress) const {
  SourceSet set;
  set.points = {source};
  QueryOptions query;
  query.quality = false;
  query.fields = heat;
  return method_->solve(set, query, progress);
}

Result<FoundPath> PathFinder::streamline(const SurfacePoint& from, const SurfacePoint& to,
                                         PathField field, const Progress& progress) const {
  const bool heat = field == PathField::kHeat;
  if (heat && !method_->heat()) {
    return Error{ErrorCode::kBadInput,
                 "the field heat is one of the method heat, not of " + to_text(method_->kind()),
                 {"choose the method heat or the field distance"}};
  }
  if (auto way = edge_path(*surface_, from, to); !way) return way.error();
  const auto solved = distances(from, heat, progress);
  if (!solved) return solved.error();
  const DescentField down{heat ? solved->log_heat : solved->distances, heat};
  auto line = trace_streamline(*surface_, down, to, from);
  if (!line) return line.error();
  FoundPath out{reversed(std::move(line->path)), {}};
  if (line->stuck) {
    out.warnings.push_back("the streamline of " + to_text(field) + " from " +
                           place_text(position_at(*surface_->mesh(), to)) +
                           " stopped before its goal and went on along edges; the field geodesic "
                           "has no such stops");
  }
  return out;
}

Result<FoundPath> PathFinder::geodesic(const SurfacePoint& from, const SurfacePoint& to,
                                       const Progress& progress) const {
  if (auto way = edge_path(*surface_, from, to); !way) return way.error();
  const auto there = distances(from, false, part_of(progress, 0, 0.4));
  if (!there) return there.error();
  const auto back = distances(to, false, part_of(progress, 0.4, 0.8));
  if (!back) return back.error();
  auto path = search_geodesic(*surface_, {from, to, there->distances, back->distances},
                              part_of(progress, 0.8, 1));
  if (!path) return path.error();
  return FoundPath{*std::move(path), {}};
}

}  // namespace geotherm
